// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/merge_policy_laws.hpp"
#include <gnomon/occlusion/merge_policy.hpp>

namespace {

using gnomon::observation;

static_assert(gnomon::merge_policy<gnomon::conservative>);
static_assert(gnomon::merge_policy<gnomon::liberal>);
static_assert(gnomon::merge_policy<bool (*)(observation)>);
static_assert(!gnomon::merge_policy<bool (*)(int*)>);
static_assert(!gnomon::merge_policy<void (*)(observation)>);  // decides nothing
static_assert(!gnomon::merge_policy<observation>);

TEST(merge_policies, obey_the_laws) {
    laws::merge_policy_laws(gnomon::conservative{});
    laws::merge_policy_laws(gnomon::liberal{});
    bool (*const always)(observation) = [](observation) { return true; };
    laws::merge_policy_laws(always);
    laws::merge_policy_laws([](observation seen) {
        return seen == observation::occluded || seen == observation::on_surface;
    });
}

/// Fig. 4.4
TEST(merge_policies, accept_the_observations_of_the_thesis) {
    EXPECT_TRUE(gnomon::conservative{}(observation::occluded));
    EXPECT_FALSE(gnomon::conservative{}(observation::free_space));
    EXPECT_FALSE(gnomon::conservative{}(observation::unobserved));
    EXPECT_FALSE(gnomon::conservative{}(observation::on_surface));
    EXPECT_TRUE(gnomon::liberal{}(observation::occluded));
    EXPECT_FALSE(gnomon::liberal{}(observation::free_space));
    EXPECT_TRUE(gnomon::liberal{}(observation::unobserved));
    EXPECT_TRUE(gnomon::liberal{}(observation::on_surface));
}

}  // namespace

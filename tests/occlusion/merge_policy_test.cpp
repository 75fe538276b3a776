// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/occlusion/merge_policy.hpp>

namespace {

using gnomon::sighting;

static_assert(gnomon::merge_policy<gnomon::conservative>);
static_assert(gnomon::merge_policy<gnomon::liberal>);
static_assert(gnomon::merge_policy<bool (*)(sighting)>);
static_assert(!gnomon::merge_policy<bool (*)(int*)>);

/// Fig. 4.4
TEST(merge_policies, say_what_the_thesis_says) {
    EXPECT_TRUE(gnomon::conservative{}(sighting::closer));
    EXPECT_FALSE(gnomon::conservative{}(sighting::farther));
    EXPECT_FALSE(gnomon::conservative{}(sighting::unseen));
    EXPECT_FALSE(gnomon::conservative{}(sighting::level));
    EXPECT_TRUE(gnomon::liberal{}(sighting::closer));
    EXPECT_FALSE(gnomon::liberal{}(sighting::farther));
    EXPECT_TRUE(gnomon::liberal{}(sighting::unseen));
    EXPECT_TRUE(gnomon::liberal{}(sighting::level));
}

}  // namespace

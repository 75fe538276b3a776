// SPDX-License-Identifier: BSL-1.0
#include <cstddef>

#include <gtest/gtest.h>

#include "laws/merge_policy_laws.hpp"
#include <gnomon/occlusion/merge_policy.hpp>

namespace {

using gnomon::conservative, gnomon::liberal, gnomon::observation, gnomon::observation_count,
    gnomon::detail::keeps_open, gnomon::detail::verdict;

static_assert(gnomon::merge_policy<gnomon::conservative>);
static_assert(gnomon::merge_policy<gnomon::liberal>);
static_assert(gnomon::merge_policy<bool (*)(observation)>);
static_assert(!gnomon::merge_policy<bool (*)(int*)>);
static_assert(!gnomon::merge_policy<void (*)(observation)>);  // decides nothing
static_assert(!gnomon::merge_policy<observation>);

TEST(observation_count, counts_each_kind) {
    observation_count count;
    EXPECT_EQ(count.total(), 0u);
    count.add(observation::occluded);
    count.add(observation::occluded);
    count.add(observation::unobserved);
    EXPECT_EQ(count[observation::occluded], 2u);
    EXPECT_EQ(count[observation::unobserved], 1u);
    EXPECT_EQ(count[observation::free_space], 0u);
    EXPECT_EQ(count.total(), 3u);
}

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

/// Positions where the surface itself is seen are evidence neither for nor against a merge.
TEST(merge_policies, weigh_the_places_of_a_line) {
    const auto of = [](const auto& policy, std::size_t unseen, std::size_t closer,
                       std::size_t level, std::size_t farther) {
        return gnomon::detail::verdict_of(policy, {{unseen, closer, level, farther}});
    };
    EXPECT_EQ(of(conservative{}, 0, 1, 8, 0), verdict::in_favor);
    EXPECT_EQ(of(conservative{}, 3, 4, 0, 0), verdict::in_favor);
    EXPECT_EQ(of(conservative{}, 4, 4, 0, 0), verdict::against) << "more than half, not half";
    EXPECT_EQ(of(conservative{}, 0, 0, 5, 0), verdict::none);
    EXPECT_EQ(of(conservative{}, 4, 0, 5, 0), verdict::none);
    EXPECT_EQ(of(conservative{}, 5, 0, 5, 0), verdict::against);
    EXPECT_EQ(of(liberal{}, 4, 0, 0, 0), verdict::in_favor);
    EXPECT_EQ(of(liberal{}, 0, 0, 9, 0), verdict::in_favor);
    EXPECT_EQ(of(conservative{}, 0, 0, 0, 0), verdict::against);
    EXPECT_EQ(of(liberal{}, 0, 0, 0, 0), verdict::in_favor);
}

/// One position in free space keeps a gap open if the policy does not merge across free space,
/// unless it is one of fifty or more, or of a surface that is grazed.
TEST(merge_policies, keep_a_gap_open_that_is_seen_through_at_one_place) {
    // Unobserved, occluded, on surface, free space.
    for (const observation_count& seen :
         {observation_count{{0, 9, 0, 1}}, observation_count{{0, 8, 1, 1}},
          observation_count{{0, 90, 3, 2}}}) {
        EXPECT_TRUE(keeps_open(conservative{}, seen));
        EXPECT_TRUE(keeps_open(liberal{}, seen));
    }
    for (const observation_count& seen :
         {observation_count{{0, 9, 0, 0}}, observation_count{{9, 0, 9, 0}},
          observation_count{{47, 0, 26, 1}}, observation_count{{9, 9, 4, 2}},
          observation_count{{0, 98, 3, 2}}, observation_count{{2, 332, 3, 3}}}) {
        EXPECT_FALSE(keeps_open(conservative{}, seen));
        EXPECT_FALSE(keeps_open(liberal{}, seen));
    }
    const auto always = [](gnomon::observation) { return true; };
    EXPECT_FALSE(keeps_open(always, {{0, 0, 0, 9}}));
}

}  // namespace

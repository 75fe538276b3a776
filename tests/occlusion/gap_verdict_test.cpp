// SPDX-License-Identifier: BSL-1.0
#include <cstddef>

#include <gtest/gtest.h>

#include <gnomon/occlusion/detail/gap_verdict.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>

namespace {

using gnomon::conservative, gnomon::liberal, gnomon::observation_count, gnomon::detail::keeps_open;

/// Positions where the surface itself is seen are evidence neither for nor against a merge.
TEST(gap_verdict, weighs_the_places_of_a_line) {
    const auto accepted = [](const auto& policy, std::size_t unseen, std::size_t closer,
                             std::size_t level, std::size_t farther) {
        return gnomon::detail::accepts(policy, {{unseen, closer, level, farther}});
    };
    EXPECT_TRUE(accepted(conservative{}, 0, 1, 8, 0));
    EXPECT_TRUE(accepted(conservative{}, 3, 4, 0, 0));
    EXPECT_FALSE(accepted(conservative{}, 4, 4, 0, 0)) << "more than half, not half";
    EXPECT_FALSE(accepted(conservative{}, 0, 0, 5, 0));
    EXPECT_TRUE(accepted(liberal{}, 4, 0, 0, 0));
    EXPECT_FALSE(accepted(conservative{}, 0, 0, 0, 0));
    EXPECT_TRUE(accepted(liberal{}, 0, 0, 0, 0));
}

/// One position in free space keeps a gap open if the policy does not merge across free space.
TEST(gap_verdict, is_open_if_seen_through_at_one_place) {
    // Unseen, closer, level, farther.
    for (const observation_count& seen :
         {observation_count{{0, 9, 0, 1}}, observation_count{{0, 8, 0, 1}},
          observation_count{{0, 98, 0, 2}}}) {
        EXPECT_TRUE(keeps_open(conservative{}, seen));
        EXPECT_TRUE(keeps_open(liberal{}, seen));
    }
    for (const observation_count& seen :
         {observation_count{{0, 9, 0, 0}}, observation_count{{9, 0, 9, 0}}}) {
        EXPECT_FALSE(keeps_open(conservative{}, seen));
        EXPECT_FALSE(keeps_open(liberal{}, seen));
    }
    const auto always = [](gnomon::observation) { return true; };
    EXPECT_FALSE(keeps_open(always, {{0, 0, 0, 9}}));
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cstddef>

#include <gtest/gtest.h>

#include <gnomon/occlusion/detail/gap_verdict.hpp>
#include <gnomon/occlusion/lines_of_sight.hpp>
#include <gnomon/occlusion/merge_policy.hpp>

namespace {

using gnomon::conservative, gnomon::liberal, gnomon::sighting_count, gnomon::detail::keeps_open;

/// Places where the surface is seen count for nobody.
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

/// One place that is seen through outweighs all others, for those who do not merge across a hole.
TEST(gap_verdict, is_open_if_seen_through_at_one_place) {
    // Unseen, closer, level, farther.
    for (const sighting_count& seen : {sighting_count{{0, 9, 0, 1}}, sighting_count{{0, 8, 0, 1}},
                                       sighting_count{{0, 98, 0, 2}}}) {
        EXPECT_TRUE(keeps_open(conservative{}, seen));
        EXPECT_TRUE(keeps_open(liberal{}, seen));
    }
    for (const sighting_count& seen :
         {sighting_count{{0, 9, 0, 0}}, sighting_count{{9, 0, 9, 0}}}) {
        EXPECT_FALSE(keeps_open(conservative{}, seen));
        EXPECT_FALSE(keeps_open(liberal{}, seen));
    }
    const auto always = [](gnomon::sighting) { return true; };
    EXPECT_FALSE(keeps_open(always, {{0, 0, 0, 9}}));
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <type_traits>

#include <gtest/gtest.h>

#include "recognition/some_views.hpp"
#include <gnomon/recognition/view.hpp>

namespace rec = gnomon::recognition;

namespace {

static_assert(std::is_aggregate_v<rec::part> && std::is_aggregate_v<rec::view>);
static_assert(std::is_nothrow_move_constructible_v<rec::view>);

TEST(view, is_empty_at_first) {
    const rec::view v;
    EXPECT_TRUE(v.parts.empty());
    EXPECT_FALSE(v.ground.has_value());
    EXPECT_EQ(v.rest.band(0, rec::height_profile::count).points, 0.0);
    const rec::part p;
    EXPECT_EQ(p.segment, gnomon::unlabeled);
    EXPECT_FALSE(p.shape.is_surface());
}

TEST(view, has_surfaces_largest_first_with_their_profiles) {
    for (const auto& v : some_views::training().views) {
        for (std::size_t i = 0; i < v.parts.size(); ++i) {
            const auto& p = v.parts[i];
            EXPECT_TRUE(p.shape.is_surface());
            EXPECT_LE(p.lowest, p.highest);
            EXPECT_GT(p.profile.band(0, rec::height_profile::count).points, 0.0);
            if (i > 0) {
                EXPECT_GE(v.parts[i - 1].shape.points, p.shape.points);
            }
        }
    }
}

TEST(view, is_a_value) {
    auto v = some_views::training().views.front();
    const auto copy = v;
    v.parts.clear();
    EXPECT_FALSE(copy.parts.empty());
}

}  // namespace

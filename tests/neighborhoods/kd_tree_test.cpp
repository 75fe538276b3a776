// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/kd_tree.hpp>

namespace {

/// Oracle: all finite points in canonical order about p.
std::vector<gnomon::neighbor> by_brute_force(const clouds::cloud& points,
                                             const Eigen::Vector3d& p) {
    std::vector<gnomon::neighbor> all;
    for (std::size_t j = 0; j < points.size(); ++j) {
        if (!gnomon::is_finite(points[j])) continue;
        all.push_back(
            {gnomon::squared_distance(p, points[j]), static_cast<gnomon::point_index>(j)});
    }
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<clouds::named_cloud> searched_clouds() {
    auto all = clouds::degenerate();
    all.push_back({"cube", clouds::in_cube(1500, 1)});
    all.push_back({"sheet", clouds::sheet(1500, 2)});
    all.push_back({"ties everywhere, more", clouds::on_grid(1500, 3)});
    all.push_back({"ties on an uneven grid", clouds::on_grid(1500, 3, 0.1)});
    all.push_back(
        {"at UTM coordinates", clouds::moved(clouds::on_grid(800, 9, 0.1),
                                             Eigen::Matrix3d::Identity(), {6e5, 4.8e6, 100})});
    return all;
}

TEST(kd_tree, nearest_equals_brute_force_ties_included) {
    for (const auto& [name, points] : searched_clouds()) {
        SCOPED_TRACE(name);
        const gnomon::kd_tree tree(points);
        std::vector<gnomon::neighbor> found;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!gnomon::is_finite(points[i])) continue;
            auto expected = by_brute_force(points, points[i]);
            std::erase_if(expected, [i](const auto& q) { return q.index == i; });
            for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{7},
                                        std::size_t{50}, points.size() + 3}) {
                tree.nearest(points[i], k, i, found);
                ASSERT_TRUE(
                    std::equal(found.begin(), found.end(), expected.begin(),
                               expected.begin() + std::ptrdiff_t(std::min(k, expected.size()))));
            }
        }
    }
}

/// The k nearest and all that are as near as the k-th, but no more than 2 k.
TEST(kd_tree, nearest_with_all_ties_equals_brute_force) {
    for (const auto& [name, points] : searched_clouds()) {
        SCOPED_TRACE(name);
        const gnomon::kd_tree tree(points);
        std::vector<gnomon::neighbor> found;
        for (std::size_t i = 0; i < points.size(); i += 2) {
            if (!gnomon::is_finite(points[i])) continue;
            auto expected = by_brute_force(points, points[i]);
            std::erase_if(expected, [i](const auto& q) { return q.index == i; });
            for (const std::size_t k : {1u, 7u, 30u}) {
                std::size_t n = std::min<std::size_t>(k, expected.size());
                while (n > 0 && n < std::min<std::size_t>(2 * k, expected.size()) &&
                       expected[n].squared_distance <=
                           expected[k - 1].squared_distance * (1 + 1e-9)) {
                    ++n;
                }
                tree.nearest(points[i], k, i, found, gnomon::tie_rule::all);
                ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(),
                                       expected.begin() + std::ptrdiff_t(n)));
            }
        }
    }
}

TEST(kd_tree, ball_equals_brute_force_rim_included) {
    for (const auto& [name, points] : searched_clouds()) {
        SCOPED_TRACE(name);
        const gnomon::kd_tree tree(points);
        for (std::size_t i = 0; i < points.size(); i += 3) {
            if (!gnomon::is_finite(points[i])) continue;
            const auto all = by_brute_force(points, points[i]);
            for (const double r : {0.0, 0.1, 0.25, 0.5}) {
                std::vector<gnomon::neighbor> found;
                tree.for_each_within(points[i], r, [&](const auto& q) { found.push_back(q); });
                std::sort(found.begin(), found.end());
                const auto end = std::partition_point(all.begin(), all.end(), [r](const auto& q) {
                    return q.squared_distance <= r * r;
                });
                ASSERT_TRUE(std::equal(found.begin(), found.end(), all.begin(), end));
            }
        }
    }
}

/// Many neighbors are gathered in another way than few.
TEST(kd_tree, nearest_of_many_equals_brute_force) {
    for (const auto& points : {clouds::in_cube(3000, 7), clouds::on_grid(3000, 8)}) {
        const gnomon::kd_tree tree(points);
        std::vector<gnomon::neighbor> found;
        for (std::size_t i = 0; i < points.size(); i += 500) {
            auto expected = by_brute_force(points, points[i]);
            std::erase_if(expected, [i](const auto& q) { return q.index == i; });
            for (const std::size_t k : {127u, 129u, 300u, 1000u, 2999u}) {
                tree.nearest(points[i], k, i, found);
                ASSERT_EQ(found.size(), k);
                EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin()));
                tree.nearest(points[i], k, i, found, gnomon::tie_rule::all);
                auto with_ties = expected;
                gnomon::detail::keep_nearest(with_ties, k, gnomon::tie_rule::all);
                EXPECT_EQ(found, with_ties);
            }
        }
    }
}

/// Asking for all ties, for nobody in particular, or for more than there are.
TEST(kd_tree, gives_no_more_than_asked_for) {
    const auto points = clouds::in_cube(500, 4);
    const gnomon::kd_tree tree(points);
    std::vector<gnomon::neighbor> found;
    for (const auto rule : {gnomon::tie_rule::by_index, gnomon::tie_rule::all}) {
        tree.nearest({0.5, 0.5, 0.5}, 9, gnomon::kd_tree::no_point, found, rule);
        EXPECT_EQ(found.size(), 9u);
        for (const std::size_t k : {std::size_t{500}, std::size_t{1} << 63, ~std::size_t{0}}) {
            tree.nearest(points[3], k, 3, found, rule);
            EXPECT_EQ(found.size(), 499u);
        }
    }
}

/// As drivers write them that report what they did not see as (0, 0, 0). Visiting each of these
/// points from each would take hours.
TEST(kd_tree, looks_at_coincident_points_once) {
    auto points = clouds::in_cube(150'000, 6);
    for (std::size_t i = 0; i < points.size(); i += 3) points[i] = {i % 2 ? 0.0 : -0.0, 0, 0};
    const gnomon::kd_tree tree(points);
    EXPECT_EQ(tree.size(), points.size());
    std::vector<gnomon::neighbor> found;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        tree.nearest(points[i], 8, i, found);
        ASSERT_EQ(found.size(), 8u);
        ASSERT_EQ(found.back(),
                  (gnomon::neighbor{0.0, static_cast<gnomon::point_index>(i < 24 ? 24 : 21)}));
    }
    std::size_t visits = 0;
    tree.for_each_within(points[3], 0.0, [&](const gnomon::neighbor& q) {
        EXPECT_EQ(q.squared_distance, 0.0);
        EXPECT_EQ(q.index, 3 * visits++);
    });
    EXPECT_EQ(visits, 50'000u);
}

TEST(kd_tree, answers_for_places_that_are_no_points) {
    const auto points = clouds::in_cube(500, 4);
    const gnomon::kd_tree tree(points);
    std::vector<gnomon::neighbor> found;
    for (const auto& p : clouds::in_cube(100, 5)) {
        const Eigen::Vector3d place = 3.0 * p - Eigen::Vector3d::Ones();
        tree.nearest(place, 9, points.size(), found);
        const auto expected = by_brute_force(points, place);
        ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.begin() + 9));
    }
}

}  // namespace

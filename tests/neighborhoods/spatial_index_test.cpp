// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/point_range_laws.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/size_with_ties.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::metric, gnomon::neighbor, gnomon::spatial_index, gnomon::tie_rule;

/// Oracle: all finite points in canonical order of their distance from p.
std::vector<neighbor> by_brute_force(const clouds::cloud& points, const Eigen::Vector3d& p,
                                     const metric& m = {}) {
    std::vector<neighbor> all;
    for (std::size_t j = 0; j < points.size(); ++j) {
        if (!gnomon::is_finite(points[j])) continue;
        const Eigen::Vector3d d = p - points[j];
        all.push_back({m.squared(d.x(), d.y(), d.z()), static_cast<gnomon::point_index>(j)});
    }
    std::sort(all.begin(), all.end());
    return all;
}

/// Its first k, and with all ties up to 2 k.
std::vector<neighbor> first_of(std::vector<neighbor> all, std::size_t k, tie_rule ties) {
    if (all.size() > k) {
        all.resize(ties == tie_rule::all && k <= all.size()
                       ? gnomon::detail::size_with_ties(all, k, 2 * k)
                       : k);
    }
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

/// Positions of some finite points, and others between and beyond them.
std::vector<Eigen::Vector3d> positions_about(const clouds::cloud& points) {
    std::vector<Eigen::Vector3d> all{{0.5, 0.5, 0.5}, {-3.0, 2.0, 10.0}};
    for (std::size_t i = 0; i < points.size(); i += 7) {
        if (!gnomon::is_finite(points[i])) continue;
        all.push_back(points[i]);
        if (i % 5 == 0) all.push_back(0.5 * points[i] + Eigen::Vector3d(0.1, 0.2, 0.0));
    }
    return all;
}

TEST(spatial_index, nearest_equals_brute_force_ties_included) {
    for (const auto& [name, points] : searched_clouds()) {
        SCOPED_TRACE(name);
        const spatial_index index(points);
        for (const Eigen::Vector3d& p : positions_about(points)) {
            const auto all = by_brute_force(points, p);
            for (const std::size_t k :
                 {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{8}, std::size_t{9},
                  std::size_t{16}, std::size_t{17}, std::size_t{50}, points.size() + 3,
                  ~std::size_t{0} / 2 + 1, ~std::size_t{0}}) {
                for (const tie_rule ties : {tie_rule::by_index, tie_rule::all}) {
                    ASSERT_EQ(index.nearest(p, k, {.ties = ties}), first_of(all, k, ties));
                }
            }
        }
    }
}

TEST(spatial_index, within_equals_brute_force_rim_included) {
    for (const auto& [name, points] : searched_clouds()) {
        SCOPED_TRACE(name);
        const spatial_index index(points);
        for (const Eigen::Vector3d& p : positions_about(points)) {
            const auto all = by_brute_force(points, p);
            for (const double r : {0.0, 0.1, 0.25, 0.5, clouds::infinity}) {
                auto inside = all;
                std::erase_if(inside, [r](const auto& q) { return q.squared_distance > r * r; });
                ASSERT_EQ(index.within(p, r), inside);
                ASSERT_EQ(index.nearest_within(p, 4, r), first_of(inside, 4, tie_rule::by_index));
            }
        }
    }
}

TEST(spatial_index, measures_by_any_metric) {
    for (const auto& points : {clouds::in_cube(700, 4), clouds::on_grid(700, 5, 0.1)}) {
        const spatial_index index(points);
        for (const metric& m : {metric::manhattan(), metric{3.0}, metric::maximum()}) {
            for (const Eigen::Vector3d& p : positions_about(points)) {
                const auto all = by_brute_force(points, p, m);
                ASSERT_EQ(index.nearest(p, 9, {.metric = m}), first_of(all, 9, tie_rule::by_index));
                auto inside = all;
                std::erase_if(inside, [](const auto& q) { return q.squared_distance > 0.2 * 0.2; });
                ASSERT_EQ(index.within(p, 0.2, {.metric = m}), inside);
            }
        }
    }
}

/// Rank by rank no farther than (1 + epsilon) times the true distance; radii stay exact.
TEST(spatial_index, keeps_the_bound_of_an_approximate_search) {
    const auto points = clouds::sheet(20'000, 6);
    const spatial_index index(points);
    std::size_t different = 0;
    for (const double epsilon : {0.1, 1.0, 5.0}) {
        for (std::size_t i = 0; i < points.size(); i += 97) {
            const auto exact = index.nearest(points[i], 20);
            const auto found = index.nearest(points[i], 20, {.epsilon = epsilon});
            ASSERT_EQ(found.size(), exact.size());
            for (std::size_t j = 0; j < exact.size(); ++j) {
                ASSERT_LE(std::sqrt(found[j].squared_distance),
                          (1.0 + epsilon) * std::sqrt(exact[j].squared_distance) + 1e-12);
            }
            different += found == exact ? 0 : 1;
            ASSERT_EQ(index.within(points[i], 0.05, {.epsilon = epsilon}),
                      index.within(points[i], 0.05));
        }
    }
    EXPECT_GT(different, 0u);  // else it read as much as an exact search
}

TEST(spatial_index, finds_only_points_of_a_subset) {
    for (const auto& [name, points] : searched_clouds()) {
        SCOPED_TRACE(name);
        const spatial_index index(points);
        std::vector<gnomon::point_index> chosen;
        for (std::size_t i = 0; i < points.size(); i += 3)
            chosen.push_back(static_cast<gnomon::point_index>(i));
        const auto part = index.subset(chosen);
        for (const Eigen::Vector3d& p : positions_about(points)) {
            auto all = by_brute_force(points, p);
            std::erase_if(all, [](const auto& q) { return q.index % 3 != 0; });
            ASSERT_EQ(part.size(), all.size());
            ASSERT_EQ(part.nearest(p, 7), first_of(all, 7, tie_rule::by_index));
            std::erase_if(all, [](const auto& q) { return q.squared_distance > 0.0625; });
            ASSERT_EQ(part.within(p, 0.25), all);
            ASSERT_EQ(part.nearest_within(p, 2, 0.25), first_of(all, 2, tie_rule::by_index));
        }
    }
    const spatial_index index(clouds::in_cube(10, 1));
    EXPECT_EQ(index.subset({}).nearest({0, 0, 0}, 3).size(), 0u);
    const std::vector<gnomon::point_index> no_point{10};
    EXPECT_THROW((void)index.subset(no_point), std::invalid_argument);
}

/// Some drivers report invalid returns as (0, 0, 0). A search that reads all coincident points for
/// each of them would take hours.
TEST(spatial_index, reads_few_of_many_coincident_points) {
    auto points = clouds::in_cube(150'000, 6);
    for (std::size_t i = 0; i < points.size(); i += 3) points[i] = {i % 2 ? 0.0 : -0.0, 0, 0};
    const spatial_index index(points);
    std::vector<neighbor> found;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        index.nearest_into(found, points[i], 8);
        ASSERT_EQ(found.size(), 8u);
        ASSERT_EQ(found.back(), (neighbor{0.0, 21}));
    }
    const auto all = index.within(points[3], 0.0);
    ASSERT_EQ(all.size(), 50'000u);
    for (std::size_t j = 0; j < all.size(); ++j) ASSERT_EQ(all[j].index, 3 * j);
}

TEST(spatial_index, is_a_range_of_its_points) {
    gnomon::scan scan{clouds::sheet(500, 1), gnomon::viewpoint_table(Eigen::Vector3d(1, 2, 3)), {}};
    scan.points[7].x() = std::numeric_limits<double>::quiet_NaN();
    scan.points[9].y() = 1e200;
    const spatial_index index(scan);
    laws::point_range_laws(index);
    laws::each_point_has_a_viewpoint(index);
    ASSERT_EQ(index.size(), scan.size());
    EXPECT_EQ(index.finite(), scan.size() - 2);
    for (std::size_t i = 0; i < index.size(); ++i) {
        EXPECT_EQ(index.is_finite(i), i != 7 && i != 9);
        if (index.is_finite(i))
            EXPECT_EQ(index[i], scan.points[i]);
        else
            EXPECT_FALSE(gnomon::is_finite(index[i]));
        EXPECT_EQ(index.viewpoints[i], Eigen::Vector3d(1, 2, 3));
    }
    EXPECT_EQ(index.epsilon(), std::numeric_limits<double>::epsilon());
    const std::vector<Eigen::Vector3f> floats(3, Eigen::Vector3f(1, 2, 3));
    EXPECT_EQ(spatial_index(floats).epsilon(), double{std::numeric_limits<float>::epsilon()});
}

TEST(spatial_index, is_a_value_and_is_rebuilt) {
    const auto first = clouds::in_cube(3000, 1), second = clouds::sheet(2000, 2);
    spatial_index index(first, gnomon::threads{2});
    const spatial_index copy = index;
    const auto expected = index.nearest({0.5, 0.5, 0.5}, 20);
    index.rebuild(second);
    EXPECT_EQ(index.size(), second.size());
    EXPECT_EQ(index.nearest({0.5, 0.5, 0.5}, 20),
              first_of(by_brute_force(second, {0.5, 0.5, 0.5}), 20, tie_rule::by_index));
    EXPECT_EQ(copy.nearest({0.5, 0.5, 0.5}, 20), expected);
    index = copy;
    EXPECT_EQ(index.nearest({0.5, 0.5, 0.5}, 20), expected);
    const spatial_index moved = std::move(index);
    EXPECT_EQ(moved.nearest({0.5, 0.5, 0.5}, 20), expected);
    index = spatial_index();
    EXPECT_EQ(index.size(), 0u);
    EXPECT_TRUE(index.nearest({0, 0, 0}, 3).empty());
}

TEST(spatial_index, is_empty_after_a_rebuilding_that_throws) {
    spatial_index index(clouds::in_cube(100, 1));
    const auto fails = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        if (p.x() > 0.9) throw std::runtime_error("no memory");
        return p;
    };
    EXPECT_THROW(index.rebuild(clouds::in_cube(3000, 2), gnomon::sequential{}, fails),
                 std::runtime_error);
    EXPECT_EQ(index.size(), 0u);
    EXPECT_TRUE(index.within({0, 0, 0}, 10.0).empty());
}

/// What was moved from is a value.
TEST(spatial_index, is_of_no_points_when_moved_from) {
    const clouds::cloud few = clouds::in_cube(40, 1), many = clouds::in_cube(100, 2);
    spatial_index a(many), b(few);
    spatial_index c = std::move(a);
    EXPECT_EQ(c.size(), 100u);
    for (spatial_index* const moved : {&a, &b}) {
        if (moved == &b) c = std::move(b);
        EXPECT_EQ(moved->size(), 0u);
        EXPECT_EQ(moved->finite(), 0u);
        EXPECT_TRUE(moved->nearest({0, 0, 0}, 3).empty());
        EXPECT_EQ(gnomon::knn{.k = 3}(*moved).size(), 0u);
        moved->rebuild(many);
        EXPECT_EQ(moved->within({0, 0, 0}, 10.0).size(), 100u);
    }
    EXPECT_EQ(c.size(), 40u);
    EXPECT_EQ(c.finite(), 40u);
    EXPECT_EQ(c.within({0, 0, 0}, 10.0).size(), 40u);
    c = a;
    EXPECT_EQ(c.within({0, 0, 0}, 10.0).size(), 100u);
}

/// View points that were set for another scan are refused.
TEST(spatial_index, covers_its_points_with_view_points) {
    spatial_index index(clouds::in_cube(100, 1));
    index.viewpoints = gnomon::viewpoint_table(std::vector<Eigen::Vector3d>(10));
    EXPECT_THROW((void)gnomon::knn{.k = 3}(index), std::invalid_argument);
}

/// A part of a cloud of floats, and an index of it, are of floats.
TEST(spatial_index, has_the_epsilon_of_the_points_behind_a_view) {
    const std::vector<Eigen::Vector3f> points(10, Eigen::Vector3f(1, 2, 3));
    const std::vector<gnomon::point_index> some{1, 2};
    const double expected = std::numeric_limits<float>::epsilon();
    EXPECT_EQ(spatial_index(gnomon::subset_view(points, some)).epsilon(), expected);
    EXPECT_EQ(spatial_index(gnomon::with_viewpoint(points, {1, 2, 3})).epsilon(), expected);
    const spatial_index index(points);
    EXPECT_EQ(spatial_index(gnomon::subset_view(index, some)).epsilon(), expected);
}

TEST(spatial_index, refuses_questions_without_an_answer) {
    const spatial_index index(clouds::in_cube(100, 1));
    const Eigen::Vector3d p(0, 0, 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)index.nearest({0, nan, 0}, 3), std::invalid_argument);
    EXPECT_THROW((void)index.within(p, -1.0), std::invalid_argument);
    EXPECT_THROW((void)index.within(p, nan), std::invalid_argument);
    EXPECT_THROW((void)index.nearest_within(p, 3, nan), std::invalid_argument);
    EXPECT_THROW((void)index.nearest(p, 3, {.epsilon = -0.1}), std::invalid_argument);
    EXPECT_THROW((void)index.nearest(p, 3, {.metric = {0.5}}), std::invalid_argument);
    gnomon::scan scan{clouds::sheet(10, 1), gnomon::viewpoint_table(clouds::sheet(9, 1)), {}};
    EXPECT_THROW(spatial_index{scan}, std::invalid_argument);
}

}  // namespace

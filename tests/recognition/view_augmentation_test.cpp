// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/recognition/view_augmentation.hpp>

namespace rec = gnomon::recognition;

namespace {

const Eigen::Vector3d hiding_eye(0.0, 0.0, 1.2);

/// Points in front of the eye, up to `wide` to the sides.
std::vector<Eigen::Vector3d> points_to_hide(std::size_t n, double wide, std::uint64_t seed,
                                            const Eigen::Vector3d& by = {0.0, 0.0, 0.0}) {
    gnomon::random_stream random(seed);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < n; ++i)
        points.emplace_back(by + Eigen::Vector3d(random.uniform(1.5, 3.0),
                                                 random.uniform(-wide, wide),
                                                 1.2 + random.uniform(-wide, wide)));
    return points;
}

TEST(hide_part, hides_a_share_within_the_bounds) {
    const auto points = points_to_hide(500, 0.5, 1);
    double least = 1.0, most = 0.0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        gnomon::random_stream random(seed);
        const auto visible = rec::hide_part(points, hiding_eye, random);
        const double hidden = 1.0 - static_cast<double>(visible.size()) / 500.0;
        EXPECT_GE(hidden, 0.1 - 1.0 / 500.0);
        EXPECT_LE(hidden, 0.7);
        least = std::min(least, hidden);
        most = std::max(most, hidden);
        EXPECT_TRUE(std::is_sorted(visible.begin(), visible.end()));
        EXPECT_EQ(std::set(visible.begin(), visible.end()).size(), visible.size());
    }
    EXPECT_LT(least, 0.15);
    EXPECT_GT(most, 0.65);
}

TEST(hide_part, hides_an_exact_share_all_or_nothing) {
    const auto points = points_to_hide(100, 0.5, 2);
    gnomon::random_stream random(1);
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        const auto visible =
            rec::hide_part(points, hiding_eye, random, {.least = share, .most = share});
        EXPECT_EQ(visible.size(), static_cast<std::size_t>(100.0 * (1.0 - share)));
    }
}

/// All directions of the edge: each side of the object is hidden at times.
TEST(hide_part, hides_every_side) {
    const auto points = points_to_hide(400, 0.5, 3);
    std::vector<int> hidden(4, 0);
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        gnomon::random_stream random(seed);
        double y = 0.0, z = 0.0;
        const auto visible =
            rec::hide_part(points, hiding_eye, random, {.least = 0.4, .most = 0.4});
        for (const auto i : visible) {
            y += points[i].y();
            z += points[i].z() - 1.2;
        }
        const double n = 0.02 * static_cast<double>(visible.size());
        hidden[0] += y > n;
        hidden[1] += y < -n;
        hidden[2] += z > n;
        hidden[3] += z < -n;
    }
    for (const int count : hidden) EXPECT_GT(count, 25);
}

/// Whether a straight line separates two sets of points of a plane. If any does, then one through a
/// point of each does.
bool line_separates(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
    constexpr double rounding = 1e-12;
    for (const auto& p : a) {
        for (const auto& q : b) {
            const Eigen::Vector2d normal(q.y() - p.y(), p.x() - q.x());
            const auto side = [&](const auto& set, double sign) {
                return std::all_of(set.begin(), set.end(), [&](const Eigen::Vector2d& x) {
                    return sign * normal.dot(x - p) >= -rounding;
                });
            };
            if ((side(a, 1.0) && side(b, -1.0)) || (side(a, -1.0) && side(b, 1.0))) return true;
        }
    }
    return false;
}

/// A straight edge in front of the object: in the image of a pinhole camera, a line separates the
/// hidden points from the visible ones. Near, for an object that is small to the eye, and far.
void expect_straight_edges(double wide) {
    const auto points = points_to_hide(60, wide, 4);
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        gnomon::random_stream random(seed);
        const auto visible =
            rec::hide_part(points, hiding_eye, random, {.least = 0.3, .most = 0.6});
        std::vector<Eigen::Vector2d> seen, hidden;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d d = points[i] - hiding_eye;
            const Eigen::Vector2d image(d.y() / d.x(), d.z() / d.x());
            const bool is_visible = std::binary_search(visible.begin(), visible.end(), i);
            (is_visible ? seen : hidden).push_back(image);
        }
        EXPECT_TRUE(line_separates(seen, hidden)) << seed;
    }
}
TEST(hide_part, has_a_straight_edge) { expect_straight_edges(0.05); }
TEST(hide_part, has_a_straight_edge_before_a_wide_object) { expect_straight_edges(1.5); }

TEST(hide_part, does_not_depend_on_the_place) {
    const Eigen::Vector3d far(4e5, 5e6, 0.0);
    const auto near = points_to_hide(200, 0.5, 5), there = points_to_hide(200, 0.5, 5, far);
    gnomon::random_stream a(7), b(7);
    EXPECT_EQ(rec::hide_part(near, hiding_eye, a), rec::hide_part(there, hiding_eye + far, b));
}

TEST(hide_part, takes_the_same_points_for_the_same_random_numbers) {
    const auto points = points_to_hide(100, 0.5, 6);
    gnomon::random_stream a(7), b(7);
    EXPECT_EQ(rec::hide_part(points, hiding_eye, a), rec::hide_part(points, hiding_eye, b));
    EXPECT_NE(rec::hide_part(points, hiding_eye, a), rec::hide_part(points, hiding_eye, a));
}

TEST(hide_part, works_on_bad_points) {
    gnomon::random_stream random(1);
    EXPECT_TRUE(rec::hide_part(std::vector<Eigen::Vector3d>{}, hiding_eye, random).empty());
    auto points = points_to_hide(50, 0.5, 7);
    points[3].x() = std::numeric_limits<double>::quiet_NaN();
    points[4].z() = std::numeric_limits<double>::infinity();
    points[5] = hiding_eye;
    const auto visible = rec::hide_part(points, hiding_eye, random, {.least = 0.0, .most = 0.0});
    EXPECT_EQ(visible.size(), 47u);
    for (const auto i : visible) EXPECT_TRUE(i < 3 || i > 5);
    // The eye in the middle of two points, and an eye that is nowhere.
    const std::vector<Eigen::Vector3d> around{{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}};
    EXPECT_LE(rec::hide_part(around, Eigen::Vector3d(0.0, 0.0, 0.0), random).size(), 2u);
    EXPECT_TRUE(rec::hide_part(points, Eigen::Vector3d(std::nan(""), 0.0, 0.0), random).empty());
}

TEST(hide_part, refuses_shares_out_of_range) {
    const auto points = points_to_hide(10, 0.5, 8);
    gnomon::random_stream random(1);
    const double nan = std::nan("");
    for (const rec::hide_part_options& bad :
         {rec::hide_part_options{-0.1, 0.5}, rec::hide_part_options{0.5, 0.4},
          rec::hide_part_options{0.5, 1.1}, rec::hide_part_options{nan, 0.5},
          rec::hide_part_options{0.1, nan}})
        EXPECT_THROW((void)rec::hide_part(points, hiding_eye, random, bad), std::invalid_argument);
}

}  // namespace

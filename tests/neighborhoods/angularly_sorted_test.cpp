// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/neighborhoods/angularly_sorted.hpp>
#include <gnomon/neighborhoods/delaunay.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace {

/// The polar angles of the neighbors about the point in the xy-plane; the sheet is nearly
/// horizontal.
std::vector<double> angles(const clouds::cloud& points, std::size_t i, const auto& neighbors) {
    std::vector<double> result;
    for (const auto j : neighbors) {
        const Eigen::Vector3d d = points[j] - points[i];
        result.push_back(std::atan2(d.y(), d.x()));
    }
    return result;
}

/// The winding number of a closed sequence of angles.
double turns(const std::vector<double>& a) {
    double sum = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j)
        sum += std::remainder(a[(j + 1) % a.size()] - a[j], 2.0 * std::numbers::pi);
    return sum / (2.0 * std::numbers::pi);
}

TEST(angularly_sorted, winds_once_around_the_point_with_the_same_neighbors) {
    gnomon::random_stream random(1);
    clouds::cloud points;  // level, so that the tangent plane is known
    for (int i = 0; i < 2000; ++i) points.push_back({random.uniform(), random.uniform(), 0.0});
    const auto nearest = gnomon::knn{.k = 12}(points);
    const auto sorted = gnomon::angularly_sorted{gnomon::knn{.k = 12}}(points);
    int closed = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector before(nearest[i].begin(), nearest[i].end());
        std::vector after(sorted[i].begin(), sorted[i].end());
        const auto a = angles(points, i, after);
        std::sort(before.begin(), before.end());
        std::sort(after.begin(), after.end());
        ASSERT_EQ(before, after);
        double widest = 0.0;
        std::vector<double> in_order = a;
        std::sort(in_order.begin(), in_order.end());
        for (std::size_t j = 0; j < in_order.size(); ++j) {
            const double gap = in_order[(j + 1) % in_order.size()] - in_order[j];
            widest = std::max(widest, gap < 0 ? gap + 2.0 * std::numbers::pi : gap);
        }
        const bool open = sorted.note(i).open;
        ASSERT_EQ(open, widest >= std::numbers::pi);
        if (!open) {
            ASSERT_NEAR(std::abs(turns(a)), 1.0, 1e-9);
        }
        closed += !open;
        // An open neighbors begins and ends at the gap: every step within is less than half a turn.
        for (std::size_t j = 0; open && j + 1 < a.size(); ++j) {
            const double step = std::remainder(a[j + 1] - a[j], 2.0 * std::numbers::pi);
            ASSERT_EQ(step > 0, std::remainder(a[1] - a[0], 2.0 * std::numbers::pi) > 0);
        }
    }
    EXPECT_GT(closed, 1700);
    EXPECT_LT(closed, 2000);
}

TEST(angularly_sorted, sorts_a_stored_graph_alike) {
    const auto points = clouds::sheet(500, 2);
    const auto graph = gnomon::knn{.k = 9}(points);
    EXPECT_EQ(gnomon::detail::sort_angularly(points, graph),
              gnomon::angularly_sorted{gnomon::knn{.k = 9}}(points));
    EXPECT_THROW((void)gnomon::detail::sort_angularly(clouds::sheet(499, 2), graph),
                 std::invalid_argument);
    const std::vector<std::vector<gnomon::point_index>> foreign{{500}, {0}};
    EXPECT_THROW((void)gnomon::detail::sort_angularly(clouds::sheet(2, 1), foreign),
                 std::invalid_argument);
}

/// What the base does not certify stays so, and along a scan line there is no plane to sort in.
TEST(angularly_sorted, certifies_no_more_than_its_base_and_its_plane) {
    const auto points = clouds::sheet(400, 3);
    const gnomon::delaunay base{.k = 4, .max_doublings = 0};
    const auto graph = base(points);
    const auto sorted = gnomon::angularly_sorted{base}(points);
    const auto sorted_again = gnomon::detail::sort_angularly(points, graph);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LE(sorted.note(i).certified, graph.note(i).certified);
        EXPECT_LE(sorted_again.note(i).certified, graph.note(i).certified);
    }
    gnomon::random_stream random(4);
    clouds::cloud line;
    for (int i = 0; i < 200; ++i) line.push_back({0.001 * i, 2.0 + 1e-4 * random.gaussian(), 0.0});
    const auto along = gnomon::angularly_sorted{gnomon::knn{20}}(line);
    for (std::size_t i = 0; i < line.size(); ++i) EXPECT_FALSE(along.note(i).certified);
}

/// A neighbor right above the point has no direction, but is not lost.
TEST(angularly_sorted, keeps_neighbors_without_a_direction) {
    const clouds::cloud points{{0, 0, 0},  {1, 0, 0},  {0, 1, 0},
                               {-1, 0, 0}, {0, -1, 0}, {0, 0, 0.1}};
    const auto graph = gnomon::angularly_sorted{gnomon::knn{.k = 5}}(points);
    ASSERT_EQ(graph[0].size(), 5u);
    EXPECT_EQ(graph[0][0], 5u);
    EXPECT_FALSE(graph.note(0).open);
}

}  // namespace

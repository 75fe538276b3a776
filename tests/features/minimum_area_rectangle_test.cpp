// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/features/minimum_area_rectangle.hpp>

namespace {

using gnomon::convex_polygon;
using gnomon::minimum_area_rectangle;
using gnomon::oriented_box;

/// Oracle: the rectangle on each edge of the polygon, around all corners.
double smallest_area_by_brute_force(const convex_polygon& polygon) {
    double smallest = std::numeric_limits<double>::infinity();
    const std::size_t n = polygon.outline.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d u = (polygon.outline[(i + 1) % n] - polygon.outline[i]).normalized();
        const Eigen::Vector2d v(-u.y(), u.x());
        Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300);
        Eigen::Vector2d high = -low;
        for (const Eigen::Vector2d& x : polygon.outline) {
            low = low.cwiseMin(Eigen::Vector2d(u.dot(x), v.dot(x)));
            high = high.cwiseMax(Eigen::Vector2d(u.dot(x), v.dot(x)));
        }
        smallest = std::min(smallest, (high - low).prod());
    }
    return smallest;
}

void expect_rectangle_around(const oriented_box& box, const convex_polygon& polygon,
                             double rounding) {
    EXPECT_NEAR((box.axes.transpose() * box.axes - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(box.axes.determinant(), 1.0, 1e-12);
    EXPECT_EQ(Eigen::Vector3d(box.axes.col(2)), Eigen::Vector3d(polygon.axes.col(2)));
    EXPECT_GE(box.lengths[0], box.lengths[1]);
    EXPECT_EQ(box.lengths[2], 0.0);
    for (std::size_t i = 0; i < polygon.outline.size(); ++i) {
        const Eigen::Vector3d x = box.axes.transpose() * (polygon.corner(i) - box.center);
        for (int a = 0; a < 3; ++a) EXPECT_LE(std::abs(x[a]), 0.5 * box.lengths[a] + rounding);
    }
}

TEST(minimum_area_rectangle, is_the_smallest_on_an_edge_of_the_hull) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        gnomon::random_stream random(seed);
        clouds::cloud points;
        const std::size_t n = 3 + random.below(200);
        const double stretch = std::pow(10.0, -4.0 * random.uniform());
        for (std::size_t i = 0; i < n; ++i) {
            Eigen::Vector3d p(random.uniform(), random.uniform(), 0.0);
            const double t = 7.0 * random.uniform();
            if (seed % 3 == 1) p = {std::cos(t), std::sin(t), 0.0};
            if (seed % 3 == 2) p = {std::floor(5.0 * p.x()), std::floor(5.0 * p.y()), 0.0};
            p.x() *= stretch;
            points.push_back(clouds::random_rotation(seed) * p);
        }
        const Eigen::Vector3d normal = clouds::random_rotation(seed).col(2);
        const auto polygon = convex_polygon::of(points, {normal, 0.0});
        const oriented_box box = minimum_area_rectangle(polygon);
        const double area = box.lengths[0] * box.lengths[1];
        if (polygon.outline.size() > 2) {
            EXPECT_NEAR(area, smallest_area_by_brute_force(polygon), 1e-12 * area + 1e-15);
        }
        expect_rectangle_around(box, polygon, 1e-13);
    }
}

TEST(minimum_area_rectangle, recovers_a_table_top_at_utm_coordinates) {
    const Eigen::Matrix3d turn = clouds::random_rotation(8);
    const Eigen::Vector3d center(4e5, 5e6, 100.0);
    for (const double width : {2.0, 1.999, 0.01}) {  // the axes of the variance of a square are any
        clouds::cloud points;
        for (int i = 0; i <= 20; ++i) {
            for (int j = 0; j <= 20; ++j) {
                points.push_back(center + turn * Eigen::Vector3d(2.0 * (i / 20.0 - 0.5),
                                                                 width * (j / 20.0 - 0.5), 0));
            }
        }
        const auto polygon = convex_polygon::of(points, {turn.col(2), turn.col(2).dot(center)});
        const oriented_box box = minimum_area_rectangle(polygon);
        EXPECT_NEAR(box.lengths[0], 2.0, 1e-8);
        EXPECT_NEAR(box.lengths[1], width, 1e-8);
        EXPECT_NEAR((box.center - center).norm(), 0.0, 1e-8);
        if (width < 1.9995) {
            EXPECT_NEAR(std::abs(box.axes.col(0).dot(turn.col(0))), 1.0, 1e-6);
        }
        expect_rectangle_around(box, polygon, 1e-8);
    }
}

TEST(minimum_area_rectangle, of_degenerate_points_has_fewer_lengths) {
    const oriented_box none = minimum_area_rectangle(convex_polygon{});
    EXPECT_EQ(none.lengths, Eigen::Vector3d::Zero());
    EXPECT_EQ(none.axes, Eigen::Matrix3d::Identity());
    const oriented_box one =
        minimum_area_rectangle(convex_polygon::of(clouds::cloud(3, {4e5, 5e6, 1}), {}));
    EXPECT_EQ(one.center, Eigen::Vector3d(4e5, 5e6, 0));
    EXPECT_EQ(one.lengths, Eigen::Vector3d::Zero());
    const clouds::cloud line{{1, 1, 0}, {4, 5, 0}, {2.5, 3, 0}};
    const oriented_box two = minimum_area_rectangle(convex_polygon::of(line, {}));
    EXPECT_NEAR((two.lengths - Eigen::Vector3d(5, 0, 0)).norm(), 0.0, 1e-14);
    EXPECT_NEAR((two.center - Eigen::Vector3d(2.5, 3, 0)).norm(), 0.0, 1e-14);
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const oriented_box box = minimum_area_rectangle(convex_polygon::of(points, {}));
        EXPECT_TRUE(box.center.allFinite() && box.axes.allFinite() && box.lengths.allFinite());
    }
}

}  // namespace

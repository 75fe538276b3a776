// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/looks.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/occlusion/ray_spacing.hpp>

namespace {

/// By azimuth and elevation [degrees].
Eigen::Vector3d ray_at(double azimuth, double elevation) {
    const gnomon::angle a = gnomon::degrees(azimuth), e = gnomon::degrees(elevation);
    return {cos(e) * cos(a), cos(e) * sin(a), sin(e)};
}

gnomon::angle ray_spacing(const auto& points) {
    return gnomon::detail::ray_spacing(gnomon::position_view(points),
                                       gnomon::detail::viewpoints_of(points));
}

TEST(ray_spacing, is_that_of_the_rays) {
    for (const double spacing : {0.5, 1.0, 2.0}) {
        const auto seen = looks::look_at(looks::hidden(), {.spacing = spacing});
        EXPECT_NEAR(ray_spacing(seen.scan).degrees(), spacing, 0.25 * spacing);
    }
    const auto seen = looks::look_at(looks::hidden(), {.step = {0, 0.02, 0}});
    EXPECT_NEAR(ray_spacing(seen.scan).degrees(), 1.0, 0.25);
}

/// Points in another order are the same cloud: one with several returns along each ray, from a
/// sensor that moves.
TEST(ray_spacing, depends_on_no_order) {
    auto seen = looks::look_at(looks::hidden(), {.step = {0, 0.2, 0}, .sigma = 0.01});
    const gnomon::viewpoint_table& v = seen.scan.viewpoints;
    clouds::cloud points, viewpoints;
    for (std::size_t i = 0; i < seen.scan.size(); ++i) {
        for (const double times : {1.0, 8.0}) {
            points.push_back(v[i] + times * (seen.scan.points[i] - v[i]));
            viewpoints.push_back(v[i]);
        }
    }
    const gnomon::viewpoint_table table(viewpoints);
    const auto all = gnomon::with_viewpoints(points, table);
    const double expected = ray_spacing(all).radians();
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        std::vector<std::size_t> order;
        clouds::permuted(points, seed, order);
        const std::vector<gnomon::point_index> indices(order.begin(), order.end());
        const gnomon::subset_view shuffled(all, indices);
        EXPECT_EQ(ray_spacing(shuffled).radians(), expected);
    }
}

/// However many points are in a line: rays are not all drawn from one place of the lines.
TEST(ray_spacing, draws_from_all_over_an_organised_scan) {
    for (const int columns : {96, 192, 360, 720}) {
        const double step = 360.0 / columns;
        clouds::cloud points;
        for (int e = 0; e < columns / 2; ++e)
            for (int a = 0; a < columns; ++a)
                points.push_back(ray_at(a * step, (e + 0.5) * step - 90.0));
        EXPECT_NEAR(ray_spacing(points).degrees(), step, 0.3 * step) << columns;
    }
}

/// Scans of several stations have the pixels of each of them.
TEST(ray_spacing, of_stations_apart_is_that_of_one) {
    const auto one = looks::look_at(looks::hidden());
    const double expected = ray_spacing(one.scan).degrees();
    clouds::cloud points, viewpoints;
    for (int station = 0; station < 9; ++station) {
        const Eigen::Vector3d by(0.011 * station, station, 0.013 * station);
        for (const Eigen::Vector3d& p : one.scan.points) {
            points.push_back(p + by);
            viewpoints.push_back(by);
        }
    }
    const gnomon::viewpoint_table table(viewpoints);
    EXPECT_NEAR(ray_spacing(gnomon::with_viewpoints(points, table)).degrees(), expected,
                0.1 * expected);
}

TEST(ray_spacing, is_between_a_twentieth_and_five_degrees) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const double spacing = ray_spacing(points).degrees();
        EXPECT_GE(spacing, 0.05 - 1e-12);
        EXPECT_LE(spacing, 5.0 + 1e-12);
    }
}

/// Of a length that its square hardly holds, or not at all, no direction is known.
TEST(ray_spacing, ignores_points_next_to_the_view_point) {
    clouds::cloud points = clouds::sheet(2000, 1);
    for (Eigen::Vector3d& p : points) p.z() += 1.0;
    const double expected = ray_spacing(points).degrees();
    for (const double tiny : {2.71e-162, 1e-160, 5e-324}) {
        const clouds::cloud only(40, Eigen::Vector3d(tiny, 0, 0));
        EXPECT_EQ(ray_spacing(only).degrees(), ray_spacing(clouds::cloud{}).degrees());
        clouds::cloud more = points;
        more.emplace_back(tiny, 0, 0);
        EXPECT_EQ(ray_spacing(more).degrees(), expected);
    }
}

}  // namespace

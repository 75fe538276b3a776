// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/across_lines.hpp>
#include <gnomon/neighborhoods/noise_knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::noise_knn, gnomon::point_index, gnomon::spatial_index;

/// The returns of a spinning lidar from the ground 2 m below it: lines 2 degrees apart, in each a
/// return every 0.2 degrees.
clouds::cloud ground(double across = 2.0, double along = 0.2) {
    clouds::cloud points;
    for (int line = 0; line < 8; ++line) {
        const double elevation = gnomon::degrees(-25.0 + across * line).radians();
        for (double azimuth = -40.0; azimuth < 40.0; azimuth += along) {
            const double a = gnomon::degrees(azimuth).radians();
            const double range = 2.0 / std::sin(-elevation);
            points.emplace_back(range * std::cos(elevation) * std::cos(a),
                                range * std::cos(elevation) * std::sin(a), -2.0);
        }
    }
    return points;
}

const Eigen::Vector3d sensor(0.0, 0.0, 0.0);

/// The number of scan lines among some points.
std::size_t lines_of(const clouds::cloud& points, const auto& indices) {
    std::vector<long> ranges;
    for (const point_index i : indices) ranges.push_back(std::lround(1e6 * points[i].norm()));
    std::sort(ranges.begin(), ranges.end());
    return static_cast<std::size_t>(std::unique(ranges.begin(), ranges.end()) - ranges.begin());
}

TEST(across_lines, measures_the_spacing_of_rays) {
    for (const double along : {0.2, 0.5}) {
        for (const double across : {1.0, 2.0, 3.0}) {
            const auto points = ground(across, along);
            const spatial_index index(gnomon::with_viewpoint(points, sensor));
            const gnomon::sequential run;  // named: g++ 13 warns of a reference to a temporary
            const auto& spacing = gnomon::detail::directions_of(index, run).spacing();
            EXPECT_NEAR(spacing.across.degrees(), across, 0.02 * across);
            EXPECT_LT(spacing.along.degrees(), 1.01 * along);
            EXPECT_GT(spacing.along.degrees(), 0.85 * along) << "at -25 degrees";
        }
    }
}

TEST(across_lines, finds_points_of_the_next_lines) {
    const auto points = ground();
    const auto viewed = gnomon::with_viewpoint(points, sensor);
    const noise_knn across{.noise = gnomon::constant_noise{0.01}};
    noise_knn along = across;
    along.sees_across_lines = false;
    const auto graph = across(viewed), without = along(viewed);
    std::size_t fewest = 100, most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::abs(std::atan2(points[i].y(), points[i].x())) > 0.6) continue;
        fewest = std::min(fewest, lines_of(points, graph[i]));
        most = std::max(most, lines_of(points, without[i]));
    }
    EXPECT_EQ(most, 1u);
    EXPECT_GE(fewest, 2u);
    EXPECT_EQ(across(points), along(points)) << "of unknown view points";
}

/// By brute force: of the rays up to two spacings away, the four nearest in each quadrant.
TEST(across_lines, finds_the_nearest_of_each_quadrant) {
    const auto points = ground();
    const spatial_index index(gnomon::with_viewpoint(points, sensor));
    gnomon::detail::across_lines<spatial_index> search(index);
    const double reach = gnomon::degrees(2.0 * 2.0).radians();
    constexpr std::size_t reach_of_line = 3;
    std::size_t found_some = 0;
    for (std::size_t i = reach_of_line; i + reach_of_line < points.size(); i += 7) {
        std::vector<point_index> on_line;
        const Eigen::Vector3d u = points[i].normalized();
        const gnomon::detail::ray_plane<> plane(u);
        gnomon::detail::scan_line<> line;
        for (std::size_t j = i - reach_of_line; j <= i + reach_of_line; ++j) {
            if (j == i) continue;
            on_line.push_back(static_cast<point_index>(j));
            line.add(plane.offset(points[j]));
        }
        line.fit();
        std::vector<std::vector<gnomon::neighbor>> quadrants(4);
        for (std::size_t j = 0; j < points.size(); ++j) {
            const Eigen::Vector3d v = points[j].normalized();
            const double squared = gnomon::squared_distance(u, v);
            if (j == i || squared > reach * reach) continue;
            quadrants[line.quadrant(plane.offset(v))].push_back(
                {squared, static_cast<point_index>(j)});
        }
        std::vector<double> expected, distances;
        for (auto& q : quadrants) {
            std::sort(q.begin(), q.end());
            for (std::size_t n = 0; n < std::min<std::size_t>(4, q.size()); ++n)
                expected.push_back(q[n].squared_distance);
        }
        const auto found = search(static_cast<point_index>(i), on_line.size(),
                                  [&](std::size_t n) { return on_line[n]; });
        for (const point_index j : found)
            distances.push_back(gnomon::squared_distance(u, points[j].normalized()));
        std::sort(expected.begin(), expected.end());
        std::sort(distances.begin(), distances.end());
        ASSERT_EQ(distances.size(), expected.size()) << i;
        for (std::size_t n = 0; n < expected.size(); ++n)
            ASSERT_NEAR(distances[n], expected[n], 1e-12) << i;
        found_some += found.empty() ? 0 : 1;
    }
    EXPECT_GT(found_some, 300u);
}

/// The graph, and one search after the other; in any order of the points, from any side.
TEST(across_lines, is_the_same_however_it_is_asked) {
    auto points = ground();
    points[5] = points[9];  // two returns of one ray, one of none, and one at the sensor
    points[11] *= 1.5;
    points[20][0] = clouds::nan;
    points[30] = sensor;
    const auto viewed = gnomon::with_viewpoint(points, sensor);
    const noise_knn policy{.noise = gnomon::constant_noise{0.01}};
    const auto graph = policy(viewed);
    for (const unsigned t : {1u, 2u, 4u}) EXPECT_EQ(policy(viewed, gnomon::threads{t}), graph);
    const spatial_index index(viewed);
    std::vector<gnomon::neighbor> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!index.is_finite(i)) continue;
        policy.find(index, i, found);
        ASSERT_EQ(found.size(), graph[i].size());
        for (std::size_t n = 0; n < found.size(); ++n) ASSERT_EQ(found[n].index, graph[i][n]);
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    }
    EXPECT_TRUE(graph[20].empty());

    std::vector<std::size_t> order;
    clouds::permuted(points, 1, order);
    const std::vector<point_index> indices(order.begin(), order.end());
    const gnomon::subset_view shuffled(viewed, indices);
    const auto again = policy(shuffled);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        std::vector<point_index> now;
        for (const point_index j : again[i]) now.push_back(indices[j]);
        std::sort(now.begin(), now.end());
        std::vector<point_index> before(graph[indices[i]].begin(), graph[indices[i]].end());
        std::sort(before.begin(), before.end());
        differing += now != before ? 1 : 0;
    }
    EXPECT_LT(differing, points.size() / 20) << "but where distances tie";
}

/// An index keeps the directions until its points or view points change.
TEST(across_lines, follows_the_view_points) {
    const auto points = ground();
    spatial_index index(gnomon::with_viewpoint(points, sensor));
    const noise_knn policy{.noise = gnomon::constant_noise{0.01}};
    const auto graph = policy(index);
    const Eigen::Vector3d above(0.0, 0.0, 30.0);
    index.viewpoints = above;
    const auto from_above = policy(index);
    EXPECT_EQ(from_above, policy(gnomon::with_viewpoint(points, above)));
    EXPECT_NE(from_above, graph);
    const spatial_index copy = index;
    EXPECT_EQ(policy(copy), from_above);
    index.rebuild(gnomon::with_viewpoint(points, sensor));
    EXPECT_EQ(policy(index), graph);
    index.clear();
    EXPECT_EQ(policy(index).size(), 0u);
}

TEST(across_lines, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const double x : {0.0, 1.0, 1e6, clouds::nan})
            EXPECT_EQ(noise_knn{}(gnomon::with_viewpoint(points, {x, 0.5, 0.0})).size(),
                      points.size());
        EXPECT_EQ(
            noise_knn{}(gnomon::with_viewpoints(points, gnomon::viewpoint_table(points))).size(),
            points.size());
    }
}

TEST(across_lines, ends_where_points_are_seen_from_elsewhere) {
    const auto points = ground();
    clouds::cloud from(points.size(), sensor);
    for (std::size_t i = 0; i < points.size(); ++i)  // each line from another place, 1 m apart
        from[i].z() = std::round(points[i].norm() * 10.0);
    const auto viewed = gnomon::with_viewpoints(points, gnomon::viewpoint_table(from));
    const noise_knn policy{.noise = gnomon::constant_noise{0.01}};
    const auto graph = policy(viewed);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(lines_of(points, graph[i]), 1u);
}

}  // namespace

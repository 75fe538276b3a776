// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::average_voxels;
using gnomon::thin_voxels;
using gnomon::voxel_grid;

/// The points of each cell of a grid, by brute force.
std::map<std::array<double, 3>, std::vector<gnomon::point_index>> cells_of(
    const clouds::cloud& points, double size) {
    std::map<std::array<double, 3>, std::vector<gnomon::point_index>> cells;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d& p = points[i];
        if (!gnomon::is_finite(p)) continue;
        cells[{std::floor(p.x() / size), std::floor(p.y() / size), std::floor(p.z() / size)}]
            .push_back(static_cast<gnomon::point_index>(i));
    }
    return cells;
}

/// On both sides of the origin, with points on the faces of cells, duplicates, and points that are
/// not finite.
clouds::cloud cloud_to_thin(std::uint64_t seed, const Eigen::Vector3d& shift = {0, 0, 0}) {
    clouds::cloud points = clouds::in_cube(3000, seed);
    for (const Eigen::Vector3d& p : clouds::on_grid(1500, seed)) points.push_back(p);
    for (std::size_t i = 0; i < 500; ++i) points.push_back(points[3 * i]);
    for (Eigen::Vector3d& p : points) p += shift - Eigen::Vector3d(0.5, 0.5, 0.5);
    points[20] = {clouds::nan, 0, 0};
    points[4000] = {0, -clouds::infinity, 0};
    return points;
}

void expect_brute_force(const clouds::cloud& points, const voxel_grid& grid, double tolerance) {
    const auto means = average_voxels(points, grid);
    std::size_t expected = 0;
    for (const auto& [at, members] : cells_of(points, grid.edge)) {
        if (members.size() < grid.min_points) {
            for (const auto i : members) ASSERT_EQ(means.of_point[i], voxel_grid::means::no_cell);
            continue;
        }
        ++expected;
        const std::size_t c = means.of_point[members[0]];
        ASSERT_LT(c, means.size());
        for (const auto i : members) ASSERT_EQ(means.of_point[i], c);
        ASSERT_EQ(means.counts[c], members.size());
        Eigen::Vector3d mean(0, 0, 0);
        for (const auto i : members) mean += points[i] - points[members[0]];
        mean = points[members[0]] + mean / static_cast<double>(members.size());
        ASSERT_LE((means.points[c] - mean).norm(), tolerance);
        double least = clouds::infinity;
        for (const auto i : members) least = std::min(least, (points[i] - means.points[c]).norm());
        ASSERT_LE((points[means.nearest[c]] - means.points[c]).norm(), least + 1e-15 + tolerance);
        ASSERT_EQ(means.of_point[means.nearest[c]], c);
    }
    ASSERT_EQ(means.size(), expected);
    ASSERT_TRUE(std::is_sorted(means.nearest.begin(), means.nearest.end()));
    ASSERT_EQ(thin_voxels(points, grid), means.nearest);
}

TEST(voxel_grid, equals_brute_force) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const double size : {0.01, 0.0625, 0.1, 0.25, 0.7, 30.0, 1e12}) {
            for (const std::size_t least : {0u, 1u, 3u}) {
                expect_brute_force(cloud_to_thin(seed), {.edge = size, .min_points = least},
                                   1e-14 + size * 0x1p-48);
            }
        }
        expect_brute_force(cloud_to_thin(seed, {4e5, 5e6, 300}), {.edge = 0.1}, 2e-9);
        expect_brute_force(cloud_to_thin(seed, {4e5, 5e6, 300}), {.edge = 1e-6}, 2e-9);
    }
}

/// More points than one part has, and a part of many cells.
TEST(voxel_grid, equals_brute_force_in_many_parts) {
    expect_brute_force(clouds::in_cube(40'000, 9), {.edge = 0.02}, 1e-14);
    expect_brute_force(clouds::in_cube(40'000, 9), {.edge = 0.4}, 1e-14);
}

TEST(voxel_grid, keeps_a_single_point_and_its_copies_as_they_are) {
    const Eigen::Vector3d p(432101.12345678, 5432100.98765432, -0.1);
    EXPECT_EQ(average_voxels(clouds::cloud{p}, {.edge = 0.1}).points[0], p);
    const auto copies = average_voxels(clouds::cloud(1000, p), {.edge = 0.1});
    EXPECT_LE((copies.points[0] - p).norm(), 1e-9);
    EXPECT_EQ(copies.counts, std::vector<gnomon::point_index>{1000});
    EXPECT_EQ(copies.nearest, std::vector<gnomon::point_index>{0});
}

/// Kept positions and means are the same bits for any order of the points.
TEST(voxel_grid, does_not_depend_on_the_order_of_the_points) {
    const clouds::cloud points = cloud_to_thin(4);
    std::vector<std::size_t> order;
    const clouds::cloud others = clouds::permuted(points, 8, order);
    const auto sorted = [](clouds::cloud some) {
        std::sort(some.begin(), some.end(), [](const auto& p, const auto& q) {
            return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
        });
        return some;
    };
    for (const double size : {0.03, 0.1, 0.5}) {
        const auto kept_of = [size](const clouds::cloud& some) {
            clouds::cloud kept;
            for (const auto i : thin_voxels(some, {.edge = size})) kept.push_back(some[i]);
            return kept;
        };
        EXPECT_EQ(sorted(kept_of(points)), sorted(kept_of(others)));
        EXPECT_EQ(sorted(average_voxels(points, {.edge = size}).points),
                  sorted(average_voxels(others, {.edge = size}).points));
    }
}

/// Cells begin at multiples of the size: a shift of the cloud by whole cells shifts the result.
TEST(voxel_grid, has_the_grid_of_the_coordinates) {
    const clouds::cloud points = cloud_to_thin(5);
    const clouds::cloud shifted =
        clouds::moved(points, Eigen::Matrix3d::Identity(), {-16.0, 64.0, 8.0});
    const auto here = average_voxels(points, {.edge = 0.125});
    const auto there = average_voxels(shifted, {.edge = 0.125});
    ASSERT_EQ(here.size(), there.size());
    std::map<gnomon::point_index, gnomon::point_index> same;  // by the cells of the points
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(same.emplace(here.of_point[i], there.of_point[i]).first->second,
                  there.of_point[i]);
    // Other points in other cells change nothing.
    clouds::cloud fewer = points;
    std::erase_if(fewer, [](const auto& p) { return !(p.x() < 0.0); });
    const auto means = average_voxels(points, {.edge = 0.125}).points;
    for (const Eigen::Vector3d& mean : average_voxels(fewer, {.edge = 0.125}).points)
        EXPECT_NE(std::find(means.begin(), means.end(), mean), means.end());
}

TEST(voxel_grid, does_not_depend_on_threads_or_on_the_index) {
    const clouds::cloud points = clouds::in_cube(30'000, 2);
    const auto means = average_voxels(points);
    for (const unsigned n : {2u, 5u}) {
        const auto same = average_voxels(points, {}, gnomon::threads{n});
        EXPECT_EQ(same.points, means.points);
        EXPECT_EQ(same.of_point, means.of_point);
        EXPECT_EQ(thin_voxels(points, {}, gnomon::threads{n}), means.nearest);
    }
    EXPECT_EQ(average_voxels(gnomon::spatial_index(points)).points, means.points);
}

TEST(voxel_grid, gives_means_the_view_points_of_their_nearest_points) {
    gnomon::scan scan{.points = cloud_to_thin(6), .viewpoints = {}, .fields = {}, .width = 0};
    EXPECT_TRUE(average_voxels(scan).viewpoints.empty());
    scan.viewpoints = Eigen::Vector3d(1, 2, 3);
    EXPECT_EQ(average_voxels(scan).viewpoints[5], Eigen::Vector3d(1, 2, 3));
    scan.viewpoints = gnomon::viewpoint_table(clouds::in_cube(scan.size(), 77));
    const auto means = average_voxels(scan);
    ASSERT_TRUE(means.viewpoints.covers(means.size()));
    for (std::size_t c = 0; c < means.size(); ++c)
        EXPECT_EQ(means.viewpoints[c], scan.viewpoints[means.nearest[c]]);
    scan.viewpoints = gnomon::viewpoint_table(clouds::in_cube(3, 77));
    EXPECT_THROW(static_cast<void>(average_voxels(scan)), std::invalid_argument);
}

TEST(voxel_grid, has_a_result_for_degenerate_clouds) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const bool is_huge = std::any_of(points.begin(), points.end(), [](const auto& p) {
            return gnomon::is_finite(p) && p.cwiseAbs().maxCoeff() >= 0.05 * 0x1p50;
        });
        if (is_huge)
            EXPECT_THROW(static_cast<void>(thin_voxels(points)), std::invalid_argument);
        else
            expect_brute_force(points, {.edge = 0.05}, 1e-9);
    }
    EXPECT_TRUE(thin_voxels(clouds::cloud()).empty());
    EXPECT_EQ(average_voxels(clouds::cloud()).size(), 0u);
    const auto none = average_voxels(clouds::cloud(3, {clouds::nan, 1, 1}));
    EXPECT_EQ(none.size(), 0u);
    EXPECT_EQ(none.of_point, std::vector<gnomon::point_index>(3, voxel_grid::means::no_cell));
}

TEST(voxel_grid, refuses_sizes_out_of_range) {
    const clouds::cloud points{{4e5, 5e6, 0}};
    for (const double size : {0.0, -1.0, clouds::nan, clouds::infinity, 5e6 / 0x1p50, 1e-300,
                              5e-324, 0.9e-150, 1.1e150, 1e300}) {
        EXPECT_THROW(static_cast<void>(thin_voxels(points, {.edge = size})), std::invalid_argument);
        EXPECT_THROW(static_cast<void>(average_voxels(points, {.edge = size})),
                     std::invalid_argument);
    }
    EXPECT_EQ(thin_voxels(points, {.edge = 2 * 5e6 / 0x1p50}).size(), 1u);
    EXPECT_EQ(thin_voxels(clouds::cloud{{1e140, 0, 0}}, {.edge = 1e130}).size(), 1u);
}

/// At the origin the smallest cells hold a point. Sums of the largest and smallest cells have a
/// finite scale.
TEST(voxel_grid, has_cells_of_any_size_at_the_origin) {
    const clouds::cloud points(3, {0, 0, 0});
    for (const double size : {1e-150, 1e-100, 1e150}) {
        const auto means = average_voxels(points, {.edge = size});
        ASSERT_EQ(means.size(), 1u);
        EXPECT_TRUE(means.points[0].allFinite());
    }
}

}  // namespace

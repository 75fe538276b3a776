// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/alpha_shape.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/features/project_to_plane.hpp>

namespace {

using gnomon::project_to_plane;

/// A grid of 4 m x 2 m on the floor, seen from different places 1.2 m above it, with noise along
/// the rays; moved by a rotation and a shift.
struct seen_floor {
    gnomon::plane plane;
    clouds::cloud true_ones, noisy, eyes;

    explicit seen_floor(std::uint64_t seed, double sigma = 0.015,
                        const Eigen::Vector3d& shift = {0.0, 0.0, 0.0}) {
        gnomon::random_stream random(seed);
        const Eigen::Matrix3d turn = clouds::random_rotation(seed);
        plane.normal = turn.col(2);
        plane.offset = plane.normal.dot(shift);
        for (int i = 0; i <= 80; ++i) {
            for (int j = 0; j <= 40; ++j) {
                const Eigen::Vector3d eye(-1.0 + 0.02 * i, 0.1 * j, 1.2);
                const Eigen::Vector3d p(0.05 * i, 0.05 * j, 0.0);
                const Eigen::Vector3d along = (p - eye).normalized();
                true_ones.push_back(turn * p + shift);
                noisy.push_back(turn * (p + sigma * random.gaussian() * along) + shift);
                eyes.push_back(turn * eye + shift);
            }
        }
    }
    [[nodiscard]] auto seen() const {
        return gnomon::with_viewpoints(noisy, gnomon::viewpoint_table(eyes));
    }
};

double largest_distance(const clouds::cloud& a, const clouds::cloud& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
    return largest;
}

/// Without an error of the plane, points are where they would be without noise.
TEST(project_to_plane, undoes_noise_along_the_rays) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const seen_floor floor(seed);
        EXPECT_LE(largest_distance(project_to_plane(floor.seen(), floor.plane), floor.true_ones),
                  1e-12);
        const seen_floor far(seed, 0.015, {4e5, 5e6, 100.0});
        EXPECT_LE(largest_distance(project_to_plane(far.seen(), far.plane), far.true_ones), 1e-7);
    }
}

TEST(project_to_plane, moves_along_the_normal_where_rays_are_not_known) {
    const seen_floor floor(6);
    clouds::cloud feet;
    for (const Eigen::Vector3d& p : floor.noisy)
        feet.push_back(p - floor.plane.signed_distance(p) * floor.plane.normal);
    EXPECT_LE(largest_distance(project_to_plane(floor.noisy, floor.plane), feet), 1e-14);
    const clouds::cloud nowhere(feet.size(), {clouds::nan, 0.0, 0.0});
    const auto seen = gnomon::with_viewpoints(floor.noisy, gnomon::viewpoint_table(nowhere));
    EXPECT_LE(largest_distance(project_to_plane(seen, floor.plane), feet), 1e-14);
    const auto from_itself =
        gnomon::with_viewpoints(floor.noisy, gnomon::viewpoint_table(floor.noisy));
    EXPECT_LE(largest_distance(project_to_plane(from_itself, floor.plane), feet), 1e-14);
    // All rays are within a degree of the plane.
    const Eigen::Vector3d low = floor.noisy.front() - 500.0 * floor.plane.normal.unitOrthogonal();
    const auto grazing = gnomon::with_viewpoint(floor.noisy, low);
    EXPECT_LE(largest_distance(project_to_plane(grazing, floor.plane), feet), 1e-14);
}

/// Along its ray a point 10 cm from the plane would be moved by metres.
TEST(project_to_plane, moves_outliers_along_the_normal) {
    seen_floor floor(7);
    const std::size_t i = floor.noisy.size() - 1;
    floor.noisy[i] = floor.true_ones[i] + 0.1 * floor.plane.normal;
    EXPECT_LE(largest_distance(project_to_plane(floor.seen(), floor.plane), floor.true_ones),
              1e-12);
    floor.noisy[i] = floor.true_ones[i] + 0.02 * floor.plane.normal;
    EXPECT_GT(largest_distance(project_to_plane(floor.seen(), floor.plane), floor.true_ones), 0.03);
}

TEST(project_to_plane, keeps_points_that_are_not_finite_and_their_order) {
    seen_floor floor(8);
    const auto expected = project_to_plane(floor.seen(), floor.plane);
    floor.noisy.insert(floor.noisy.begin(), {clouds::nan, 1.0, 2.0});
    floor.eyes.insert(floor.eyes.begin(), {0.0, 0.0, 0.0});
    const auto found = project_to_plane(floor.seen(), floor.plane);
    ASSERT_EQ(found.size(), expected.size() + 1);
    EXPECT_TRUE(std::isnan(found[0].x()));
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(found[k + 1], expected[k]);
    for (const auto& [name, cloud] : clouds::degenerate())
        EXPECT_EQ(project_to_plane(gnomon::with_viewpoint(cloud, {0.1, 0.2, 0.3}), {}).size(),
                  cloud.size())
            << name;
}

TEST(project_to_plane, refuses_view_points_of_other_points) {
    struct other_table : clouds::cloud {
        gnomon::viewpoint_table viewpoints{clouds::cloud(3)};
    } const points{clouds::in_cube(4, 1), gnomon::viewpoint_table{clouds::cloud(3)}};
    EXPECT_THROW((void)project_to_plane(points, {}), std::invalid_argument);
    EXPECT_THROW((void)project_to_plane(clouds::in_cube(4, 1), {{0, 0, 2}, 0.0}),
                 std::invalid_argument);
}

/// Outlines and rectangles of noisy points are those of the points without noise.
TEST(project_to_plane, makes_outlines_free_of_noise) {
    for (std::uint64_t seed = 11; seed <= 13; ++seed) {
        const seen_floor floor(seed);
        const auto of = [](const auto& points, const gnomon::plane& plane) {
            return gnomon::minimum_area_rectangle(gnomon::convex_polygon::of(points, plane));
        };
        const auto truth = of(floor.true_ones, floor.plane);
        EXPECT_LE((of(floor.seen(), floor.plane).lengths - truth.lengths).norm(), 1e-9);
        EXPECT_GT((of(floor.noisy, floor.plane).lengths - truth.lengths).norm(), 0.03);
        const double area = gnomon::alpha_shape::of(floor.true_ones, floor.plane).area;
        EXPECT_NEAR(gnomon::alpha_shape::of(floor.seen(), floor.plane).area, area, 1e-6);
        std::vector<gnomon::point_index> half;
        for (gnomon::point_index i = 0; i < floor.noisy.size(); i += 2) half.push_back(i);
        const auto seen = floor.seen();
        const auto some = project_to_plane(gnomon::subset_view(seen, half), floor.plane);
        for (std::size_t k = 0; k < half.size(); ++k)
            EXPECT_LE((some[k] - floor.true_ones[half[k]]).norm(), 1e-12);
    }
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/descriptor_laws.hpp"
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/describe_points.hpp>
#include <gnomon/features/shape_context.hpp>

namespace {

using gnomon::shape_context, gnomon::trust;

static_assert(gnomon::descriptor<shape_context>);

const Eigen::Vector3d context_center(3, -2, 1);

/// Neighbors in a cube about a point, some beyond the ball of radius 0.2.
clouds::cloud context_neighbors(std::uint64_t seed, std::size_t n = 300) {
    clouds::cloud all = clouds::in_cube(n, seed);
    for (Eigen::Vector3d& q : all) q = context_center + 0.5 * (q - Eigen::Vector3d(0.5, 0.5, 0.5));
    return all;
}

Eigen::Vector3d context_normal(std::uint64_t seed) {
    gnomon::random_stream random(seed, 4);
    return clouds::gaussian_vector(random).normalized();
}

std::vector<double> context_of(const shape_context& describe, const Eigen::Vector3d& normal,
                               const clouds::cloud& neighbors,
                               std::span<const double> densities = {}) {
    std::vector<double> row(describe.dimension(), 0.0);
    (void)describe(context_center, normal, neighbors, row, densities);
    return row;
}

/// By angles and logarithms of the standard library, point by point.
std::vector<double> context_one_by_one(const shape_context& s, const Eigen::Vector3d& normal,
                                       const clouds::cloud& neighbors) {
    const Eigen::Vector3d t = gnomon::detail::orthogonal(normal), u = normal.cross(t);
    std::vector<double> row(s.dimension(), 0.0);
    for (const Eigen::Vector3d& q : neighbors) {
        const Eigen::Vector3d d = q - context_center;
        const double r = d.norm();
        if (r > s.radius || r < s.inner_radius || r == 0.0) continue;
        double azimuth = std::atan2(u.dot(d), t.dot(d)) / (2 * std::numbers::pi);
        if (azimuth < 0) azimuth += 1.0;
        const double elevation = std::acos(normal.dot(d) / r) / std::numbers::pi;
        std::size_t shell = 0;
        while (shell + 1 < s.radial_bins &&
               r >= s.inner_radius *
                        std::pow(s.radius / s.inner_radius, static_cast<double>(shell + 1) /
                                                                static_cast<double>(s.radial_bins)))
            ++shell;
        const auto a = static_cast<std::size_t>(azimuth * static_cast<double>(s.azimuth_bins));
        const auto e = static_cast<std::size_t>(elevation * static_cast<double>(s.elevation_bins));
        row[(a * s.elevation_bins + e) * s.radial_bins + shell] += 1.0;
    }
    return row;
}

TEST(shape_context, counts_the_neighbors_of_each_bin) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const shape_context s{.radius = 0.2,
                              .inner_radius = seed % 2 == 0 ? 0.0 : 0.05,
                              .azimuth_bins = 1 + seed % 13,
                              .elevation_bins = 1 + seed % 7,
                              .radial_bins = seed % 2 == 0 ? 1 : 1 + seed % 5};
        const auto neighbors = context_neighbors(seed);
        const Eigen::Vector3d normal = context_normal(seed);
        ASSERT_EQ(context_of(s, normal, neighbors), context_one_by_one(s, normal, neighbors));
    }
}

/// Every neighbor in the ball counts once, but for those at the point itself.
TEST(shape_context, conserves_mass) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        auto neighbors = context_neighbors(seed);
        neighbors[3] = neighbors[4] = context_center;
        const Eigen::Vector3d normal = context_normal(seed);
        neighbors[5] = context_center + 0.1 * normal;  // no azimuth
        for (const double inner : {0.0, 0.05}) {
            shape_context s{
                .radius = 0.2, .inner_radius = inner, .radial_bins = inner > 0.0 ? 15u : 1u};
            double inside = 0.0;
            for (const Eigen::Vector3d& q : neighbors) {
                const double r = (q - context_center).norm();
                inside += r > 0.0 && r >= inner && r <= 0.2 ? 1.0 : 0.0;
            }
            auto row = context_of(s, normal, neighbors);
            EXPECT_EQ(std::accumulate(row.begin(), row.end(), 0.0), inside);
            s.normalize = true;
            row = context_of(s, normal, neighbors);
            EXPECT_NEAR(std::accumulate(row.begin(), row.end(), 0.0), 1.0, 1e-12);
        }
    }
}

std::vector<float> stored(const std::vector<double>& row) { return {row.begin(), row.end()}; }

/// Rotations about the normal by whole bins shift the azimuth, which the distance ignores; any
/// rigid motion leaves the counts over elevation and radius.
TEST(shape_context, turns_with_the_neighbors) {
    const shape_context s{.radius = 0.2, .inner_radius = 0.02, .radial_bins = 5};
    double moved = 0.0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto neighbors = context_neighbors(seed);
        const Eigen::Vector3d normal = context_normal(seed);
        const auto row = context_of(s, normal, neighbors);
        const double angle = 2 * std::numbers::pi * static_cast<double>(seed % 12) / 12.0;
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, normal).toRotationMatrix();
        const auto turned = context_of(
            s, normal, clouds::moved(neighbors, turn, context_center - turn * context_center));
        ASSERT_LT(s.distance(stored(row), stored(turned)), 2.0);  // one neighbor on a boundary

        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        const auto rotated = context_of(
            s, r * normal, clouds::moved(neighbors, r, context_center - r * context_center));
        std::vector<double> a(55, 0.0), b(55, 0.0);
        for (std::size_t i = 0; i < row.size(); ++i) {
            a[i % 55] += row[i];
            b[i % 55] += rotated[i];
        }
        moved += laws::share_that_differs(a, b);
    }
    EXPECT_LT(moved / 100, 0.01);
}

TEST(shape_context, distance_is_the_least_over_azimuths) {
    const shape_context s{.azimuth_bins = 4, .elevation_bins = 2};
    const std::vector<float> a{1, 2, 3, 4, 5, 6, 7, 8}, b{5, 6, 7, 8, 1, 2, 3, 5};
    EXPECT_DOUBLE_EQ(s.distance(a, b), 1.0);
    EXPECT_DOUBLE_EQ(s.distance(b, a), 1.0);
    const std::vector<float> within{2, 1, 4, 3, 6, 5, 8, 7};  // elevations are not shifted
    EXPECT_GT(s.distance(a, within), 1.0);
}

/// Frome's weights: the volumes of the bins add up to that of the shells, and densities divide.
TEST(shape_context, weighs_by_volume_and_density) {
    const shape_context s{.radius = 0.2,
                          .inner_radius = 0.05,
                          .azimuth_bins = 5,
                          .elevation_bins = 4,
                          .radial_bins = 3,
                          .density_radius = 0.1};
    const auto neighbors = context_neighbors(3, 40000);
    const std::vector<double> one(neighbors.size(), 1.0), four(neighbors.size(), 4.0);
    const Eigen::Vector3d normal = context_normal(3);
    const auto counts = context_of(s, normal, neighbors);
    const auto weights = context_of(s, normal, neighbors, one);
    const auto quarter = context_of(s, normal, neighbors, four);
    double volume = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        ASSERT_GT(counts[i], 0.0);
        volume += std::pow(counts[i] / weights[i], 3);
        ASSERT_NEAR(quarter[i], 0.25 * weights[i], 1e-12 * weights[i]);
    }
    EXPECT_NEAR(volume, 4.0 / 3.0 * std::numbers::pi * (0.008 - 0.000125), 1e-12);
    // The volume of a bin between 45 and 90 degrees, in the middle shell.
    const double low = 0.05 * std::pow(4.0, 1.0 / 3), high = 0.05 * std::pow(4.0, 2.0 / 3);
    const double expected = 2 * std::numbers::pi / 5 * std::cos(std::numbers::pi / 4) *
                            (std::pow(high, 3) - std::pow(low, 3)) / 3;
    EXPECT_NEAR(std::pow(counts[4] / weights[4], 3), expected, 1e-12);
}

/// describe_points counts the points within `density_radius` of each neighbor.
TEST(shape_context, is_given_densities) {
    const auto points = clouds::sheet(600, 8);
    const std::vector<laws::described_normal> surface(points.size(), {{0, 0, 1}});
    const shape_context s{
        .radius = 0.2, .inner_radius = 0.01, .radial_bins = 4, .density_radius = 0.07};
    const auto rows = gnomon::describe_points(points, surface, s);
    for (std::size_t i = 0; i < points.size(); i += 37) {
        clouds::cloud neighbors;
        std::vector<double> densities;
        for (std::size_t j = 0; j < points.size(); ++j) {
            if (j == i || (points[j] - points[i]).norm() > 0.2) continue;
            neighbors.push_back(points[j]);
            densities.push_back(static_cast<double>(std::count_if(
                points.begin(), points.end(),
                [&](const Eigen::Vector3d& q) { return (q - points[j]).norm() <= 0.07; })));
        }
        std::vector<double> row(s.dimension(), 0.0);
        (void)s(points[i], {0, 0, 1}, neighbors, row, densities);
        ASSERT_LT(laws::share_that_differs(row, rows[i]), 1e-6);
    }
}

TEST(shape_context, has_a_trust) {
    std::vector<double> row(132, 0.0);
    const clouds::cloud at_itself(5, {0, 0, 0}), one{{0.01, 0, 0}};
    EXPECT_EQ(shape_context{}({0, 0, 0}, {0, 0, 1}, at_itself, row), trust::too_few_neighbors);
    EXPECT_EQ(row, std::vector<double>(132, 0.0));
    EXPECT_EQ(shape_context{}({0, 0, 0}, {0, 0, 1}, one, row), trust::good);
    EXPECT_EQ((shape_context{.min_neighbors = 2}({0, 0, 0}, {0, 0, 1}, one, row)),
              trust::too_few_neighbors);
}

TEST(shape_context, refuses_numbers_out_of_range) {
    const auto refused = [](const shape_context& s) {
        EXPECT_THROW(s.require_valid(), std::invalid_argument);
    };
    for (const double bad : {0.0, -1.0, clouds::nan, clouds::infinity}) refused({.radius = bad});
    for (const double bad : {-1.0, 0.1, clouds::nan}) refused({.inner_radius = bad});
    for (const double bad : {-1.0, clouds::nan, clouds::infinity}) refused({.density_radius = bad});
    refused({.azimuth_bins = 0});
    refused({.elevation_bins = 0});
    refused({.radial_bins = 0});
    refused({.radial_bins = 2});  // without an inner radius
    refused({.min_neighbors = 0});
    constexpr std::size_t huge = std::size_t{1} << 32, most = std::size_t{1} << 20;
    refused({.azimuth_bins = huge, .elevation_bins = huge});  // the product wraps to 0
    refused({.azimuth_bins = most / 8, .elevation_bins = 9});
    EXPECT_NO_THROW((shape_context{.azimuth_bins = most / 8, .elevation_bins = 8}.require_valid()));
    const shape_context s;
    const std::vector<float> row(s.dimension()), less(s.dimension() - s.elevation_bins);
    EXPECT_EQ(s.distance(row, row), 0.0);
    EXPECT_THROW((void)s.distance(row, less), std::invalid_argument);
    EXPECT_THROW((void)s.distance(less, row), std::invalid_argument);
    EXPECT_THROW((void)s.distance(less, less), std::invalid_argument);
    EXPECT_NO_THROW(shape_context{}.require_valid());
}

TEST(shape_context, obeys_the_laws) {
    laws::descriptor_laws(shape_context{.radius = 0.1});
    laws::descriptor_laws(shape_context{
        .radius = 0.2, .inner_radius = 0.02, .radial_bins = 3, .density_radius = 0.05});
}

}  // namespace

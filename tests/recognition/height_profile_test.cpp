// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/recognition/height_profile.hpp>

using gnomon::recognition::height_profile;

namespace {

std::vector<Eigen::Vector3d> profiled_points(std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < n; ++i)
        points.emplace_back(random.gaussian(), 0.3 * random.gaussian(), random.uniform(-0.5, 4.0));
    return points;
}

height_profile profile_of(const std::vector<Eigen::Vector3d>& points) {
    height_profile profile;
    for (const auto& x : points) profile.add(x.z(), x.x(), x.y());
    return profile;
}

TEST(height_profile, has_the_moments_of_each_level) {
    const auto points = profiled_points(2000, 1);
    const height_profile profile = profile_of(points);
    for (std::size_t l = 0; l < height_profile::count; ++l) {
        const double low = static_cast<double>(l) * height_profile::thickness;
        const double high = l + 1 == height_profile::count ? 1e9 : low + height_profile::thickness;
        height_profile::level sum;
        for (const auto& x : points)
            if (l > 0 && x.z() >= low && x.z() < high)
                sum += {1.0, x.x(), x.y(), x.x() * x.x(), x.x() * x.y(), x.y() * x.y()};
        EXPECT_EQ(profile.levels[l].points, sum.points) << l;
        EXPECT_NEAR(profile.levels[l].u, sum.u, 1e-9);
        EXPECT_NEAR(profile.levels[l].v, sum.v, 1e-9);
        EXPECT_NEAR(profile.levels[l].uu, sum.uu, 1e-9);
        EXPECT_NEAR(profile.levels[l].uv, sum.uv, 1e-9);
        EXPECT_NEAR(profile.levels[l].vv, sum.vv, 1e-9);
    }
}

TEST(height_profile, adds_up_to_that_of_the_union) {
    const auto a = profiled_points(300, 2), b = profiled_points(500, 3);
    auto both = a;
    both.insert(both.end(), b.begin(), b.end());
    height_profile sum = profile_of(a);
    sum += profile_of(b);
    const height_profile whole = profile_of(both);
    for (std::size_t l = 0; l < height_profile::count; ++l) {
        EXPECT_EQ(sum.levels[l].points, whole.levels[l].points);
        EXPECT_NEAR(sum.levels[l].uv, whole.levels[l].uv, 1e-9);
    }
}

TEST(height_profile, counts_no_floor_no_nan_and_all_that_is_high) {
    height_profile profile;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double h : {-infinity, -1.0, 0.0, 0.049, std::nan("")}) profile.add(h, 1.0, 1.0);
    EXPECT_EQ(profile.band(0, height_profile::count).points, 0.0);
    for (const double h : {2.39, 2.4, 1e300, infinity}) profile.add(h, 0.0, 0.0);
    EXPECT_EQ(profile.levels.back().points, 4.0);
    profile.add(height_profile::thickness, 0.0, 0.0);
    EXPECT_EQ(profile.levels[1].points, 1.0);
}

TEST(height_profile, sums_bands) {
    const height_profile profile = profile_of(profiled_points(1000, 4));
    height_profile::level sum;
    for (std::size_t l = 8; l < 13; ++l) sum += profile.levels[l];
    EXPECT_EQ(profile.band(8, 13).points, sum.points);
    EXPECT_EQ(profile.band(8, 13).vv, sum.vv);
    EXPECT_EQ(profile.band(5, 5).points, 0.0);
}

/// Oracle: eigenvalues by Eigen. Rotation about the vertical changes nothing.
TEST(horizontal_extent, has_the_deviations_along_the_principal_axes) {
    using gnomon::recognition::detail::horizontal_extent;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const auto points = profiled_points(100, seed);
        Eigen::MatrixXd m(2, 100);
        for (int i = 0; i < 100; ++i) m.col(i) = points[static_cast<std::size_t>(i)].head<2>();
        m.colwise() -= m.rowwise().mean().eval();
        const Eigen::Matrix2d covariance = m * m.transpose() / 100.0;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> oracle(covariance);
        for (const double turn : {0.0, 0.4, 2.0}) {
            const Eigen::Rotation2Dd rotation(turn);
            height_profile profile;
            for (const auto& x : points) {
                const Eigen::Vector2d y = rotation * Eigen::Vector2d(x.head<2>());
                profile.add(1.0, y.x() + 3.0, y.y() - 2.0);
            }
            const auto extent = horizontal_extent(profile.band(0, height_profile::count));
            EXPECT_NEAR(extent[0], std::sqrt(oracle.eigenvalues()[1]), 1e-10);
            EXPECT_NEAR(extent[1], std::sqrt(oracle.eigenvalues()[0]), 1e-10);
        }
    }
}

TEST(horizontal_extent, is_zero_of_few_points_and_across_a_line) {
    using gnomon::recognition::detail::horizontal_extent;
    height_profile profile;
    EXPECT_EQ(horizontal_extent(profile.levels[3]), (std::array<double, 2>{0.0, 0.0}));
    for (const double u : {-1.0, 1.0}) profile.add(1.0, u, 0.0);
    EXPECT_EQ(horizontal_extent(profile.levels[20])[0], 0.0);
    profile.add(1.0, 0.0, 0.0);
    const auto extent = horizontal_extent(profile.band(0, height_profile::count));
    EXPECT_NEAR(extent[0], std::sqrt(2.0 / 3.0), 1e-12);
    EXPECT_NEAR(extent[1], 0.0, 1e-12);
}

}  // namespace

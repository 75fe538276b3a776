// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/descriptor_laws.hpp"
#include <gnomon/features/harmonic_shape_context.hpp>

namespace {

using gnomon::harmonic_shape_context, gnomon::trust;

static_assert(gnomon::descriptor<harmonic_shape_context>);

/// Neighbors about the origin, in a cube that the ball of radius 0.5 touches.
clouds::cloud harmonic_neighbors(std::uint64_t seed) {
    clouds::cloud all = clouds::in_cube(200, seed);
    for (Eigen::Vector3d& q : all) q -= Eigen::Vector3d(0.5, 0.4, 0.6);
    return all;
}

std::vector<double> harmonics_of(const harmonic_shape_context& describe,
                                 const Eigen::Vector3d& normal, const clouds::cloud& neighbors) {
    std::vector<double> row(describe.dimension(), 0.0);
    EXPECT_EQ(describe({0, 0, 0}, normal, neighbors, row), trust::good);
    return row;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance);
}

/// Any rotation about the normal, to 1e-12 of the number of neighbors.
TEST(harmonic_shape_context, is_invariant_under_rotation_about_the_normal) {
    for (const std::size_t shells : {1u, 4u}) {
        const harmonic_shape_context s{.radius = 0.5,
                                       .inner_radius = 0.01,
                                       .bandwidth = 16,
                                       .radial_bins = shells,
                                       .normalize = true};
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto neighbors = harmonic_neighbors(seed);
            const Eigen::Vector3d normal = clouds::random_rotation(seed).col(0);
            const Eigen::Matrix3d turn =
                Eigen::AngleAxisd(0.1 + static_cast<double>(seed), normal).toRotationMatrix();
            expect_near(harmonics_of(s, normal, neighbors),
                        harmonics_of(s, normal, clouds::moved(neighbors, turn, {0, 0, 0})), 1e-12);
        }
    }
}

/// Rigid motions with the normal; for amplitudes per degree, with any normal.
TEST(harmonic_shape_context, is_invariant_under_rigid_motion) {
    harmonic_shape_context s{.radius = 0.5, .bandwidth = 12, .normalize = true};
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const auto neighbors = harmonic_neighbors(seed);
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        const auto moved = clouds::moved(neighbors, r, {0, 0, 0});
        const Eigen::Vector3d normal(0.6, 0, 0.8);
        s.per_degree = false;
        const auto row = harmonics_of(s, normal, neighbors);
        expect_near(row, harmonics_of(s, r * normal, moved), 1e-12);
        s.per_degree = true;
        const auto degrees = harmonics_of(s, normal, neighbors);
        expect_near(degrees, harmonics_of(s, normal, moved), 1e-12);
        for (std::size_t l = 0; l < s.bandwidth; ++l) {
            double squares = 0.0;
            for (std::size_t m = 0; m <= l; ++m)
                squares += (m == 0 ? 1.0 : 2.0) * std::pow(row[l * (l + 1) / 2 + m], 2);
            ASSERT_NEAR(degrees[l], std::sqrt(squares), 1e-12);
        }
    }
}

/// Amplitudes of one direction at the angle theta to the normal, from the closed forms of Y_lm.
TEST(harmonic_shape_context, has_the_amplitudes_of_one_direction) {
    const double theta = 0.7, c = std::cos(theta), s = std::sin(theta), pi = std::numbers::pi;
    const clouds::cloud one{{0.3 * s, 0.0, 0.3 * c}};
    const auto row = harmonics_of({.radius = 0.5, .bandwidth = 3}, {0, 0, 1}, one);
    const std::vector<double> expected{
        std::sqrt(1 / (4 * pi)),          std::sqrt(3 / (4 * pi)) * c,
        std::sqrt(3 / (8 * pi)) * s,      std::sqrt(5 / (16 * pi)) * (3 * c * c - 1),
        std::sqrt(15 / (8 * pi)) * s * c, std::sqrt(15 / (32 * pi)) * s * s};
    expect_near(row, expected, 1e-14);
}

TEST(harmonic_shape_context, has_a_dimension_by_its_bandwidth) {
    EXPECT_EQ((harmonic_shape_context{.bandwidth = 8}.dimension()), 36u);
    EXPECT_EQ((harmonic_shape_context{.bandwidth = 8, .per_degree = true}.dimension()), 8u);
    EXPECT_EQ((harmonic_shape_context{.bandwidth = 3, .radial_bins = 5}.dimension()), 30u);
}

/// A neighbor is in one shell alone, and the shells add up.
TEST(harmonic_shape_context, has_shells) {
    const harmonic_shape_context s{
        .radius = 0.5, .inner_radius = 0.05, .bandwidth = 1, .radial_bins = 2};
    const double limit = std::sqrt(0.5 * 0.05), y00 = std::sqrt(1 / (4 * std::numbers::pi));
    const clouds::cloud neighbors{{limit + 1e-9, 0, 0}, {0, limit - 1e-9, 0}, {0, 0, 0.05},
                                  {0.5, 0, 0},          {0.04, 0, 0},         {0, 0, 0}};
    expect_near(harmonics_of(s, {0, 0, 1}, neighbors), {2 * y00, 2 * y00}, 1e-14);
}

TEST(harmonic_shape_context, has_a_trust) {
    std::vector<double> row(36, 0.0);
    const clouds::cloud at_itself(5, {0, 0, 0}), one{{0.01, 0, 0}};
    const harmonic_shape_context s{.normalize = true};
    EXPECT_EQ(s({0, 0, 0}, {0, 0, 1}, at_itself, row), trust::too_few_neighbors);
    EXPECT_EQ(row, std::vector<double>(36, 0.0));
    EXPECT_EQ(s({0, 0, 0}, {0, 0, 1}, one, row), trust::good);
}

TEST(harmonic_shape_context, refuses_numbers_out_of_range) {
    const auto refused = [](const harmonic_shape_context& s) {
        EXPECT_THROW(s.require_valid(), std::invalid_argument);
    };
    for (const double bad : {0.0, -1.0, clouds::nan, clouds::infinity}) refused({.radius = bad});
    refused({.inner_radius = -0.1});
    refused({.bandwidth = 0});
    refused({.radial_bins = 0});
    refused({.radial_bins = 2});
    refused({.min_neighbors = 0});
    constexpr std::size_t huge = std::size_t{1} << 32, most = std::size_t{1} << 20;
    refused({.bandwidth = huge});  // the product wraps to 0
    refused({.bandwidth = 513});
    refused({.inner_radius = 0.01, .bandwidth = 2, .radial_bins = most / 2});
    const std::vector<float> three(3), four(4);
    EXPECT_THROW((void)harmonic_shape_context{}.distance(three, four), std::invalid_argument);
    EXPECT_THROW((void)harmonic_shape_context{}.distance(four, three), std::invalid_argument);
    EXPECT_NO_THROW(harmonic_shape_context{}.require_valid());
}

/// Near the axis, powers of the sine underflow, and the other factors are large.
TEST(harmonic_shape_context, is_finite_for_the_largest_bandwidth) {
    const harmonic_shape_context s{.bandwidth = 512};
    ASSERT_NO_THROW(s.require_valid());
    for (const double x : {0.0, 1e-200, 1e-5, 1e-3, 0.02}) {
        std::vector<double> row(s.dimension(), 0.0);
        const std::vector<Eigen::Vector3d> neighbors{{x, 0.0, 0.05}, {x, x, -0.05}};
        (void)s({0, 0, 0}, {0, 0, 1}, neighbors, row);
        for (const double entry : row) ASSERT_TRUE(std::isfinite(entry));
    }
}

TEST(harmonic_shape_context, obeys_the_laws) {
    laws::descriptor_laws(harmonic_shape_context{.radius = 0.1});
    laws::descriptor_laws(harmonic_shape_context{.radius = 0.1, .per_degree = true});
}

}  // namespace

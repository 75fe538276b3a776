// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/plane_filter.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/with_covariance.hpp>

namespace {

using gnomon::detail::tangent_basis;

/// A belief in the z axis with deviations a, b along directions turned by `turn` in the plane.
gnomon::normal_belief<> belief_in_z(double a, double b, double turn) {
    gnomon::normal_belief<> belief;
    belief.normal = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d u(std::cos(turn), std::sin(turn), 0.0);
    const Eigen::Vector3d v(-u.y(), u.x(), 0.0);
    belief.covariance = a * a * u * u.transpose() + b * b * v * v.transpose();
    return belief;
}

TEST(normal_belief, scalars_of_the_covariance) {
    const auto belief = belief_in_z(0.2, 0.5, 0.7);
    EXPECT_NEAR(belief.trace(), 0.04 + 0.25, 1e-15);
    EXPECT_NEAR(belief.determinant(), 0.04 * 0.25, 1e-15);
    EXPECT_NEAR(belief.covariance.determinant(), 0.0, 1e-15);
}

TEST(normal_belief, nees_is_the_squared_distance_in_deviations) {
    const auto belief = belief_in_z(0.2, 0.5, 0.7);
    const Eigen::Vector3d u(std::cos(0.7), std::sin(0.7), 0.0);
    // Two deviations along the first direction, by whichever sign, of a normal of whichever sign.
    for (const double sign : {1.0, -1.0}) {
        const Eigen::Vector3d truth = std::cos(0.4) * Eigen::Vector3d::UnitZ() + std::sin(0.4) * u;
        EXPECT_NEAR(nees(belief, sign * truth), 4.0, 1e-12);
    }
    EXPECT_EQ(nees(belief, Eigen::Vector3d::UnitZ()), 0.0);
}

/// A covariance that allows no error: as the limit of small ones.
TEST(normal_belief, nees_of_certainty) {
    const Eigen::Vector3d off(std::sin(1e-3), 0.0, std::cos(1e-3));
    for (const auto& certain : {belief_in_z(0.0, 0.0, 0.0), belief_in_z(0.0, 0.1, 0.0)}) {
        EXPECT_EQ(nees(certain, off), clouds::infinity);
        EXPECT_EQ(nees(certain, Eigen::Vector3d::UnitZ()), 0.0);
    }
    const Eigen::Vector3d u(std::cos(0.7), std::sin(0.7), 0.0);
    EXPECT_NEAR(nees(belief_in_z(2e-90, 5e-90, 0.7), Eigen::Vector3d::UnitZ() + 4e-90 * u), 4.0,
                1e-12);
    EXPECT_TRUE(std::isnan(nees(belief_in_z(clouds::nan, 0.1, 0.7), off)));
}

/// Drawn from its own covariance, an error has a mean NEES of two, and 5.991 is exceeded in 5 %.
TEST(normal_belief, nees_of_consistent_errors_is_chi_square_with_two_degrees) {
    gnomon::random_stream random(1);
    const auto belief = belief_in_z(0.02, 0.05, -0.3);
    const Eigen::Vector3d u(std::cos(-0.3), std::sin(-0.3), 0.0);
    const Eigen::Vector3d v(-u.y(), u.x(), 0.0);
    double sum = 0.0;
    int beyond = 0;
    constexpr int trials = 100'000;
    for (int i = 0; i < trials; ++i) {
        const Eigen::Vector3d d = 0.02 * random.gaussian() * u + 0.05 * random.gaussian() * v;
        const double angle = d.norm();
        const double value =
            nees(belief, std::cos(angle) * Eigen::Vector3d::UnitZ() + std::sin(angle) / angle * d);
        sum += value;
        beyond += value > 5.991;
    }
    EXPECT_NEAR(sum / trials, 2.0, 0.03);
    EXPECT_NEAR(static_cast<double>(beyond) / trials, 0.05, 0.003);
}

/// Eigenvalues above (pi/2)^2 become that, the eigenvectors stay, and what is within the limits
/// keeps its bits.
TEST(normal_belief, covariances_are_limited) {
    using gnomon::detail::largest_variance, gnomon::detail::limited_covariance;
    const auto matrix_of = [](const gnomon::detail::tangent_matrix& p) -> Eigen::Matrix2d {
        return Eigen::Matrix2d{{p.p11, p.p12}, {p.p12, p.p22}};
    };
    gnomon::random_stream random(3);
    for (int i = 0; i < 1000; ++i) {
        const double turn = random.uniform(0.0, 4.0);
        const Eigen::Vector2d u(std::cos(turn), std::sin(turn));
        const Eigen::Vector2d v(-u.y(), u.x());
        const double a = std::pow(10.0, random.uniform(-5.0, 5.0));
        const double b = std::pow(10.0, random.uniform(-5.0, 5.0));
        const Eigen::Matrix2d given = a * u * u.transpose() + b * v * v.transpose();
        const Eigen::Matrix2d expected = std::min(a, largest_variance) * u * u.transpose() +
                                         std::min(b, largest_variance) * v * v.transpose();
        const auto found = matrix_of(limited_covariance({given(0, 0), given(0, 1), given(1, 1)}));
        ASSERT_LT((found - expected).norm(), 1e-9);
        if (a < largest_variance && b < largest_variance) {
            ASSERT_EQ(found.triangularView<Eigen::Upper>().toDenseMatrix(),
                      given.triangularView<Eigen::Upper>().toDenseMatrix());
        }
    }
    const Eigen::Matrix2d anywhere = largest_variance * Eigen::Matrix2d::Identity();
    EXPECT_EQ(matrix_of(limited_covariance({clouds::infinity, 0.0, 1.0})), anywhere);
    EXPECT_EQ(matrix_of(limited_covariance({1.0, clouds::nan, 1.0})), anywhere);
    // Rounding made it indefinite: the negative eigenvalue goes.
    const auto limited = matrix_of(limited_covariance({1e-4, 1.1e-4, 1e-4}));
    EXPECT_GE(limited.determinant(), 0.0);
    EXPECT_NEAR(limited.trace(), 2.1e-4, 1e-12);
}

TEST(normal_belief, tangent_basis_round_trip_is_exact) {
    gnomon::random_stream random(2);
    for (int i = 0; i < 1000; ++i) {
        const Eigen::Vector3d n = clouds::gaussian_vector(random).normalized();
        const tangent_basis frame(n);
        Eigen::Matrix3d axes;
        axes << frame.b1, frame.b2, frame.normal;
        EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-14);
        const double d1 = random.uniform(-1.0, 1.0);
        const double d2 = random.uniform(-1.0, 1.0);
        const Eigen::Vector3d moved = frame.moved(d1, d2);
        EXPECT_NEAR(moved.norm(), 1.0, 1e-14);
        for (const double sign : {1.0, -1.0})  // a normal and its antipode are one
            EXPECT_LT((frame.towards(sign * moved) - Eigen::Vector3d(d1, d2, 0.0)).norm(), 1e-12);
    }
}

/// The covariance is that of the normal's difference: of a patch that is wide along y and narrow
/// along z, the normal may deviate along z, by a rotation about y.
void expect_deviation_along_z(const auto& estimate) {
    gnomon::random_stream random(5);
    std::vector<Eigen::Vector3d> neighbors;
    for (int i = 0; i < 60; ++i)
        neighbors.emplace_back(2.0 + 0.005 * random.gaussian(), 0.2 * random.gaussian(),
                               0.02 * random.gaussian());
    const auto belief =
        estimate(Eigen::Vector3d(2.0, 0.0, 0.0), neighbors, Eigen::Vector3d::Zero());
    ASSERT_TRUE(gnomon::usable(belief.trust));
    EXPECT_GT(belief.covariance(2, 2), 30.0 * belief.covariance(1, 1));
}

/// At the slope itself it is the test of the trace; the farther it looks, the more is vague.
TEST(normal_belief, is_vague_where_a_flatter_plane_would_be) {
    using gnomon::detail::is_vague_within;
    gnomon::random_stream random(9);
    std::size_t vague = 0, only_if_flatter = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const gnomon::detail::tangent_basis frame(clouds::gaussian_vector(random).normalized());
        const Eigen::Vector3d u = clouds::gaussian_vector(random).normalized();
        if (std::abs(u.dot(frame.normal)) < 0.05) continue;
        const double a = random.uniform(0.0, 0.15), b = random.uniform(0.0, 0.15);
        const gnomon::detail::tangent_matrix p{a, random.uniform(-1.0, 1.0) * std::sqrt(a * b), b};
        const bool here = is_vague_within(0.0, frame, p, u);
        EXPECT_EQ(here, a + b > gnomon::detail::vague_trace) << a + b;
        const bool flatter = is_vague_within(2.0, frame, p, u);
        EXPECT_TRUE(flatter || !here);
        EXPECT_TRUE(is_vague_within(4.0, frame, p, u) || !flatter);
        vague += here ? 1 : 0;
        only_if_flatter += flatter && !here ? 1 : 0;
    }
    EXPECT_GT(vague, 100u);
    EXPECT_GT(only_if_flatter, 100u);
    // Seen along the normal nothing is flatter; along the surface everything is vague.
    const gnomon::detail::tangent_basis up(Eigen::Vector3d::UnitZ());
    EXPECT_FALSE(is_vague_within(9.0, up, {0.01, 0.0, 0.01}, Eigen::Vector3d::UnitZ()));
    EXPECT_TRUE(is_vague_within(0.0, up, {1e-9, 0.0, 1e-9}, Eigen::Vector3d::UnitX()));
}

TEST(normal_belief, is_of_the_difference_of_normals) {
    expect_deviation_along_z(gnomon::plane_eif{.noise = gnomon::constant_noise{0.005}});
    expect_deviation_along_z(gnomon::plane_ekf{.noise = gnomon::constant_noise{0.005}});
    expect_deviation_along_z(gnomon::plane_ukf{.noise = gnomon::constant_noise{0.005}});
    expect_deviation_along_z(
        gnomon::with_covariance<gnomon::plane_pca>{.noise = gnomon::constant_noise{0.005}});
}

}  // namespace

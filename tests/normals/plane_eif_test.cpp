// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/ray_ls.hpp>

namespace {

using gnomon::plane_eif, gnomon::trust;

/// The batch is the sequential filter on m = n/d at the same linearization point: the measurement
/// 1/r = u . m is linear, with variance sigma^2 / r^4. Long double, and an uninformative prior.
TEST(plane_eif, is_the_sequential_filter_in_one_batch) {
    constexpr double sigma = 0.01;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto s = laws::sample_neighborhood(seed);
        oracles::vector3 m = oracles::vector3::Zero();
        Eigen::Matrix<long double, 3, 3> p = 1e6L * Eigen::Matrix<long double, 3, 3>::Identity();
        const auto update = [&](const Eigen::Vector3d& q) {
            const oracles::vector3 x = q.cast<long double>() - s.viewpoint.cast<long double>();
            const long double r = x.norm();
            const oracles::vector3 u = x / r;
            const oracles::vector3 pu = p * u;
            const long double variance = u.dot(pu) + sigma * sigma / (r * r * r * r);
            m += pu * ((1.0L / r - u.dot(m)) / variance);
            p -= pu * pu.transpose() / variance;
        };
        update(s.p);
        for (const auto& q : s.neighbors) update(q);
        const oracles::vector3 n = m.normalized();
        const Eigen::Matrix<long double, 3, 3> j =
            (Eigen::Matrix<long double, 3, 3>::Identity() - n * n.transpose()) / m.norm();
        const Eigen::Matrix3d covariance = (j * p * j.transpose()).cast<double>();

        const auto belief =
            plane_eif{.noise = gnomon::constant_noise{sigma}}(s.p, s.neighbors, s.viewpoint);
        ASSERT_LT(laws::angle_between(belief.normal, n.cast<double>()), 1e-9);
        ASSERT_LT((belief.covariance - covariance).norm(), 1e-7 * covariance.norm());
        ASSERT_EQ(belief.normal, gnomon::ray_ls{}(s.p, s.neighbors, s.viewpoint).normal);
    }
}

TEST(plane_eif, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(2, 0, 0);
    EXPECT_EQ(plane_eif{}(p, clouds::cloud{{2, 1, 0}, {2, 0, 1}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(plane_eif{}(p, clouds::cloud{{2, 1, 0}, {2, 2, 0}, {2, -1, 0}}).trust,
              trust::degenerate);
    EXPECT_THROW((void)(plane_eif{.noise = gnomon::constant_noise{-1.0}}(p, clouds::cloud(4, p))),
                 std::invalid_argument);
}

/// The variance of the inverse range overflows where the cloud is as small as this.
TEST(plane_eif, of_a_tiny_cube_is_anywhere) {
    clouds::cloud cube = clouds::in_cube(30, 1);
    for (Eigen::Vector3d& p : cube) p *= 1e-160;
    const auto belief = plane_eif{}(cube[0], std::span(cube).subspan(1), {0, 0, -3e-160});
    EXPECT_EQ(belief.trust, trust::weak);
    EXPECT_NEAR(belief.trace(), 0.5 * std::numbers::pi * std::numbers::pi, 1e-12);
}

TEST(plane_eif, laws_hold) { laws::estimator_laws(plane_eif{}); }

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/ray_ls.hpp>

namespace {

using gnomon::ray_ls, gnomon::trust;

/// Oracle: (sum r^2 x x^T) m = sum r^2 x in long double, without any rotation.
TEST(ray_ls, solves_the_weighted_normal_equations_of_inverse_range) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const auto s = laws::sample_neighborhood(seed);
        Eigen::Matrix<long double, 3, 3> a = Eigen::Matrix<long double, 3, 3>::Zero();
        oracles::vector3 b = oracles::vector3::Zero();
        const auto add = [&](const Eigen::Vector3d& q) {
            const oracles::vector3 x = q.cast<long double>() - s.viewpoint.cast<long double>();
            a += x.squaredNorm() * x * x.transpose();
            b += x.squaredNorm() * x;
        };
        add(s.p);
        for (const auto& q : s.neighbors) add(q);
        const oracles::vector3 m = a.fullPivLu().solve(b);
        const auto fit = ray_ls{}(s.p, s.neighbors, s.viewpoint);
        ASSERT_EQ(fit.trust, trust::good);
        ASSERT_LT(laws::angle_between(fit.normal, m.normalized().cast<double>()), 1e-12);
        ASSERT_NEAR(fit.distance, static_cast<double>(1.0L / m.norm()), 1e-12);
        // The normal points away from the view point: m . x = 1.
        ASSERT_GT(fit.normal.dot(s.p - s.viewpoint), 0.0);
    }
}

/// With noise along the rays it errs less than the total least squares plane; by how much depends
/// on the scene, see the examples.
TEST(ray_ls, of_a_perfect_plane_is_perfect) {
    const Eigen::Vector3d n = Eigen::Vector3d(1, 2, -3).normalized();
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        gnomon::random_stream random(seed);
        clouds::cloud plane;
        for (int i = 0; i < 20; ++i) {
            const Eigen::Vector3d u = (n + 0.1 * clouds::gaussian_vector(random)).normalized();
            plane.push_back(2.5 / u.dot(n) * u);
        }
        const auto fit = ray_ls{}(plane[0], std::span(plane).subspan(1));
        EXPECT_LT(laws::angle_between(fit.normal, n), 1e-13);
        EXPECT_NEAR(fit.distance, 2.5, 1e-12);
    }
}

TEST(ray_ls, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(2, 0, 0);
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2, 1, 0}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2, 1, 0}, {2, 0, 1}}).trust, trust::good);
    // One scan line, whatever its ranges: the rays span a plane.
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2.1, 1, 0}, {1.9, 2, 0}, {2.2, -1, 0}}).trust,
              trust::degenerate);
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2, 1, 0}, {2, -1, 0}, {2, 0, 1e-3}}).trust, trust::weak);
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2, 1, 0}, {-2, 0, 1}}).trust,
              trust::degenerate);  // behind
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2, 1, 0}, {2, 0, 1}}, p).trust, trust::degenerate);
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2, 1, 0}, {2, clouds::nan, 1}}).trust, trust::not_finite);
    EXPECT_EQ(ray_ls{}(p, clouds::cloud{{2, 1, 0}, {2, 0, 1}}, {clouds::nan, 0, 0}).trust,
              trust::not_finite);
}

TEST(ray_ls, laws_hold) { laws::estimator_laws(ray_ls{}); }

}  // namespace

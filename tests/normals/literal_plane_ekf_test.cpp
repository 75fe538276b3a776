// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/detail/range_of_plane.hpp>
#include <gnomon/normals/literal_plane_ekf.hpp>

namespace {

using gnomon::literal_plane_ekf, gnomon::trust;

/// Eq. (3.18) against central differences, to 1e-6.
TEST(literal_plane_ekf, jacobian_agrees_with_finite_differences) {
    gnomon::random_stream random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        const Eigen::Vector3d centroid = 3.0 * clouds::gaussian_vector(random);
        const Eigen::Vector3d x = clouds::gaussian_vector(random).normalized();
        const Eigen::Vector3d u = clouds::gaussian_vector(random).normalized();
        if (std::abs(u.dot(x)) < 0.2) continue;
        const Eigen::Vector3d jacobian = gnomon::detail::range_gradient(centroid, x, u);
        constexpr double h = 1e-5;
        for (int j = 0; j < 3; ++j) {
            const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(j);
            const double slope = (gnomon::detail::range_of_plane(centroid, x + step, u) -
                                  gnomon::detail::range_of_plane(centroid, x - step, u)) /
                                 (2.0 * h);
            EXPECT_NEAR(jacobian[j], slope, 1e-6 * (1.0 + std::abs(slope)));
        }
    }
}

/// Alg. 3.2 line by line, with matrices as it has them.
Eigen::Vector3d algorithm_3_2(const clouds::cloud& q, double sigma, int passes,
                              std::uint64_t seed) {
    gnomon::random_stream random(seed);
    Eigen::Matrix3d covariance = 10.0 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d x = clouds::gaussian_vector(random);
    x.normalize();
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const auto& p : q) centroid += p / static_cast<double>(q.size());
    for (int pass = 0; pass < passes; ++pass) {
        for (const auto& p : q) {
            const Eigen::Vector3d u = p / p.norm();
            const double h = centroid.dot(x) / u.dot(x);
            const Eigen::RowVector3d jacobian =
                ((centroid * u.dot(x) - u * centroid.dot(x)) / std::pow(u.dot(x), 2)).transpose();
            const Eigen::Vector3d gain =
                covariance * jacobian.transpose() /
                ((jacobian * covariance * jacobian.transpose())(0) + sigma * sigma);
            x = x + gain * (p.norm() - h);
            covariance = ((Eigen::Matrix3d::Identity() - gain * jacobian) * covariance).eval();
        }
    }
    return x.normalized();
}

TEST(literal_plane_ekf, is_the_algorithm_line_by_line) {
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        auto s = laws::sample_neighborhood(seed);
        clouds::cloud all{s.p - s.viewpoint};
        for (const auto& q : s.neighbors) all.push_back(q - s.viewpoint);
        const auto belief =
            literal_plane_ekf{.noise = gnomon::constant_noise{0.01}, .passes = 1, .seed = seed}(
                s.p, s.neighbors, s.viewpoint);
        const Eigen::Vector3d expected = algorithm_3_2(all, 0.01, 1, seed);
        // From some initial states the filter diverges: it divides by numbers near zero, where
        // rounding determines the result.
        if (laws::angle_between(expected, {0, 0, 1}) > 0.5) continue;
        ++compared;
        EXPECT_LT(laws::angle_between(belief.normal, expected), 1e-6) << seed;
    }
    EXPECT_GT(compared, 50);
}

TEST(literal_plane_ekf, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 2);
    EXPECT_EQ(literal_plane_ekf{}(p, clouds::cloud{{1, 0, 2}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(literal_plane_ekf{}(p, clouds::cloud(4, {clouds::nan, 0, 0})).trust,
              trust::not_finite);
    EXPECT_THROW(
        (void)(literal_plane_ekf{.noise = gnomon::constant_noise{0.0}}(p, clouds::cloud(4, p))),
        std::invalid_argument);
    EXPECT_THROW((void)(literal_plane_ekf{.passes = 0}(p, clouds::cloud(4, p))),
                 std::invalid_argument);
}

TEST(literal_plane_ekf, laws_hold) {
    laws::normals_are_unit_or_zero(literal_plane_ekf{});
    laws::result_does_not_depend_on_execution(literal_plane_ekf{});
    laws::covariances_are_bounded(literal_plane_ekf{});
}

}  // namespace

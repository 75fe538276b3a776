// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/plane_filter.hpp>

namespace {

using gnomon::plane_ekf, gnomon::plane_ukf, gnomon::trust;

struct of_no_state {
    gnomon::detail::linear_range operator()(const Eigen::Vector3d& u) const;
};
static_assert(gnomon::detail::range_linearization<gnomon::detail::by_derivative>);
static_assert(gnomon::detail::range_linearization<gnomon::detail::by_sigma_points>);
static_assert(!gnomon::detail::range_linearization<of_no_state>);

/// A plane and rays that see it, at random.
struct view {
    gnomon::detail::plane_state state;
    Eigen::Vector3d anchor;
    Eigen::Vector3d u;

    explicit view(std::uint64_t seed) {
        gnomon::random_stream random(seed, 4);
        do {
            state.frame =
                gnomon::detail::tangent_basis(clouds::gaussian_vector(random).normalized());
            anchor = 3.0 * clouds::gaussian_vector(random).normalized();
            u = (anchor + 0.2 * clouds::gaussian_vector(random)).normalized();
            state.distance = 0.1 * random.gaussian();
        } while (std::abs(u.dot(state.frame.normal)) < 0.2);
    }
};

/// Eq. (3.18), in the three degrees of freedom, against central differences.
TEST(plane_filter, derivative_agrees_with_finite_differences) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const view v(seed);
        const auto z = gnomon::detail::by_derivative(v.state, v.anchor)(v.u);
        EXPECT_EQ(z.value, v.state.range(v.anchor, v.u));
        constexpr double h = 1e-5;
        for (int j = 0; j < 3; ++j) {
            const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(j);
            const double slope = (v.state.moved(step).range(v.anchor, v.u) -
                                  v.state.moved(-step).range(v.anchor, v.u)) /
                                 (2.0 * h);
            EXPECT_NEAR(z.slope[j], slope, 1e-6 * (1.0 + std::abs(slope)));
        }
        EXPECT_EQ(z.variance, 0.0);
    }
}

/// Sigma points that lie close together give the derivative; far apart, they notice the bend.
TEST(plane_filter, sigma_points_tend_to_the_derivative) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        view v(seed);
        const auto exact = gnomon::detail::by_derivative(v.state, v.anchor)(v.u);
        v.state.covariance = 1e-10 * Eigen::Matrix3d::Identity();
        const auto near = gnomon::detail::by_sigma_points(v.state, v.anchor)(v.u);
        EXPECT_LT((near.slope - exact.slope).norm(), 1e-6 * (1.0 + exact.slope.norm()));
        EXPECT_NEAR(near.value, exact.value, 1e-6);
        v.state.covariance = 1e-2 * Eigen::Matrix3d::Identity();
        EXPECT_GT(gnomon::detail::by_sigma_points(v.state, v.anchor)(v.u).variance, 1e-10);
    }
}

/// Oracle: the most likely plane by Newton steps on the sum of squares, with its inverse Hessian of
/// first order, in long double; the filter must converge to it with an uninformative prior.
TEST(plane_filter, extended_filter_finds_the_most_likely_plane) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        const auto s = laws::sample_neighborhood(seed);
        const plane_ekf filter{
            .noise = gnomon::constant_noise{0.005}, .prior_angle = 10, .prior_distance = 10};
        const auto belief = filter(s.p, s.neighbors, s.viewpoint);
        ASSERT_EQ(belief.trust, trust::good);

        // The gradient of the sum of squares vanishes at the estimate with the best distance.
        clouds::cloud all = s.neighbors;
        all.push_back(s.p);
        const Eigen::Vector3d n = belief.normal;
        double over = 0.0;
        double under = 0.0;
        for (const auto& q : all) {  // argmin of sum (r - d / (u . n))^2 over d
            const Eigen::Vector3d x = q - s.viewpoint;
            const double un = x.normalized().dot(n);
            over += x.norm() / un;
            under += 1.0 / (un * un);
        }
        const double d = over / under;
        const auto [normal, b1, b2] = gnomon::detail::tangent_basis(n);
        Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (const auto& q : all) {
            const Eigen::Vector3d x = q - s.viewpoint;
            const Eigen::Vector3d u = x.normalized();
            const double un = u.dot(n);
            const double residual = x.norm() - d / un;
            const Eigen::Vector3d slope(-d * u.dot(b1) / (un * un), -d * u.dot(b2) / (un * un),
                                        1.0 / un);
            information += slope * slope.transpose() / (0.005 * 0.005);
            gradient += slope * residual / (0.005 * 0.005);
        }
        const Eigen::Matrix3d covariance = information.inverse();
        EXPECT_LT((covariance * gradient).head(2).norm(), 1e-8);
        // Marginal over the distance, the 2 x 2 corner; whatever the tangents' frame.
        EXPECT_NEAR(belief.trace(), covariance(0, 0) + covariance(1, 1), 1e-5 * belief.trace());
        const Eigen::Matrix2d across = covariance.topLeftCorner(2, 2);
        EXPECT_NEAR(belief.determinant(), across.determinant(), 1e-5 * belief.determinant());
        EXPECT_LT((belief.covariance * n).norm(), 1e-15);
    }
}

TEST(plane_filter, covariance_grows_with_the_square_of_sigma) {
    const auto s = laws::sample_neighborhood(3);
    const double one =
        plane_ekf{.noise = gnomon::constant_noise{0.001}}(s.p, s.neighbors, s.viewpoint).trace();
    const double ten =
        plane_ekf{.noise = gnomon::constant_noise{0.01}}(s.p, s.neighbors, s.viewpoint).trace();
    EXPECT_NEAR(ten / one, 100.0, 1.0);
}

TEST(plane_filter, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 0);
    const Eigen::Vector3d v(0, 0, 2);
    const clouds::cloud corner{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
    EXPECT_EQ(plane_ekf{}(p, clouds::cloud{{1, 0, 0}, {0, 1, 0}}, v).trust,
              trust::too_few_neighbors);
    EXPECT_EQ(plane_ekf{}(p, corner, v).trust, trust::good);
    EXPECT_EQ(plane_ekf{}(p, clouds::cloud(5, p), v).trust, trust::degenerate);
    // Rays within the plane do not determine it.
    const auto grazed = plane_ekf{}(p, corner, {5, 0, 0});
    EXPECT_EQ(grazed.trust, trust::weak);
    EXPECT_GT(grazed.trace(), 1.0);
    for (const double sigma : {0.0, -1.0, clouds::nan, clouds::infinity}) {
        EXPECT_THROW((void)(plane_ekf{.noise = gnomon::constant_noise{sigma}}(p, corner, v)),
                     std::invalid_argument);
        EXPECT_THROW((void)(plane_ukf{.noise = gnomon::constant_noise{sigma}}(p, corner, v)),
                     std::invalid_argument);
    }
}

/// Variances far below the rounding of the prior's: nothing may turn negative.
TEST(plane_filter, of_tiny_noise_stays_a_covariance) {
    for (const double sigma : {1e-5, 1e-7, 1e-9}) {
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            const auto s = laws::sample_neighborhood(seed);
            const auto belief =
                plane_ekf{.noise = gnomon::constant_noise{sigma}}(s.p, s.neighbors, s.viewpoint);
            const double reference =
                plane_ekf{.noise = gnomon::constant_noise{1e-3}}(s.p, s.neighbors, s.viewpoint)
                    .trace() *
                1e6 * sigma * sigma;
            ASSERT_GT(belief.determinant(), 0.0);
            ASSERT_NEAR(belief.trace() / reference, 1.0, 1e-3);
        }
    }
}

/// A neighborhood that is long in x and seen from above: the weak direction is known, whatever
/// basis the tangents happen to have on the way.
TEST(plane_filter, covariance_lies_as_the_neighborhood_does) {
    gnomon::random_stream random(9);
    for (int trial = 0; trial < 200; ++trial) {
        clouds::cloud neighbors;
        for (int i = 0; i < 30; ++i)
            neighbors.push_back({random.uniform(-0.4, 0.4), random.uniform(-0.05, 0.05), 0.0});
        const auto check = [&](const auto& filter) {
            const auto belief = filter({0, 0, 0}, neighbors, {0, 0, 2});
            ASSERT_GT(belief.covariance(1, 1), 10.0 * belief.covariance(0, 0));
        };
        check(plane_ekf{.noise = gnomon::constant_noise{0.001}});
        check(plane_ukf{.noise = gnomon::constant_noise{0.001}});
    }
}

/// The unscented filter approaches its result step by step; it is trusted as soon as steps are
/// small in standard deviations.
TEST(plane_filter, unscented_filter_converges_in_strong_noise) {
    constexpr double sigma = 0.02;
    gnomon::random_stream random(5);
    const plane_ukf filter{.noise = gnomon::constant_noise{sigma}};
    const plane_ukf patient{.noise = gnomon::constant_noise{sigma}, .max_iterations = 200};
    int good = 0;
    constexpr int draws = 200;
    for (int draw = 0; draw < draws; ++draw) {
        clouds::cloud points;
        for (int i = 0; i < 30; ++i) {
            const Eigen::Vector3d q(2.0, random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
            points.push_back(q * (1.0 + sigma * random.gaussian() / q.norm()));
        }
        const auto belief = filter(points[0], std::span(points).subspan(1));
        const auto limit = patient(points[0], std::span(points).subspan(1));
        good += belief.trust == trust::good ? 1 : 0;
        EXPECT_LT((belief.normal - limit.normal).norm(), 0.02 * std::sqrt(limit.trace()));
    }
    EXPECT_GT(good, draws * 9 / 10);
}

TEST(plane_filter, refuses_priors_and_iterations_that_make_no_sense) {
    const auto s = laws::sample_neighborhood(1);
    const auto run = [&](const plane_ekf& filter) { (void)filter(s.p, s.neighbors, s.viewpoint); };
    EXPECT_THROW(run({.max_iterations = 0}), std::invalid_argument);
    for (const double bad : {0.0, -1.0, clouds::nan, clouds::infinity}) {
        EXPECT_THROW(run({.prior_angle = bad}), std::invalid_argument);
        EXPECT_THROW(run({.prior_distance = bad}), std::invalid_argument);
    }
}

TEST(plane_filter, laws_hold) {
    for (const double sigma : {0.005, 0.05}) {
        laws::normals_are_unit_or_zero(plane_ekf{.noise = gnomon::constant_noise{sigma}});
        laws::normals_are_unit_or_zero(plane_ukf{.noise = gnomon::constant_noise{sigma}});
    }
    laws::normal_follows_the_cloud(plane_ekf{.noise = gnomon::constant_noise{0.005}},
                                   1e-8);  // where it settles
    laws::normal_follows_the_cloud(plane_ukf{.noise = gnomon::constant_noise{0.005}}, 1e-7);
    laws::result_does_not_depend_on_execution(plane_ekf{});
    laws::result_does_not_depend_on_execution(plane_ukf{});
    laws::covariances_are_bounded(plane_ekf{});
    laws::covariances_are_bounded(
        plane_ekf{.noise = gnomon::constant_noise{1e-6}, .prior_angle = 100.0});
    laws::covariances_are_bounded(plane_ukf{});
    laws::covariances_are_bounded(
        plane_ukf{.noise = gnomon::constant_noise{2.0}, .prior_distance = 100.0});
    static_assert(gnomon::ray_estimator<plane_ekf>);
}

}  // namespace

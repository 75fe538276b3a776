// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/normals/averaging.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/plane_svd.hpp>
#include <gnomon/normals/with_covariance.hpp>

namespace {

using gnomon::plane_pca, gnomon::trust, gnomon::with_covariance;

/// Every compiler deduces the estimator, though not from designated initialisers.
static_assert(std::same_as<decltype(with_covariance{gnomon::constant_noise{0.01}, plane_pca{}}),
                           with_covariance<plane_pca>>);

/// Against the spread of the normals themselves under many draws of the noise.
TEST(with_covariance, is_the_spread_of_the_normals) {
    constexpr double sigma = 0.002;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        SCOPED_TRACE(seed);
        gnomon::random_stream random(seed, 6);
        const auto flat = [&]() -> Eigen::Vector3d {
            const double x = random.uniform(-0.1, 0.1);
            return {x, 0.4 * random.uniform(-0.1, 0.1) + 0.3 * x, 0.0};
        };
        clouds::cloud plane;
        for (int i = 0; i < 30; ++i) plane.push_back(flat());
        const Eigen::Vector3d viewpoint(0.6, -0.3, 0.8);
        const auto expected = with_covariance<plane_pca>{.noise = gnomon::constant_noise{sigma}}(
            plane[0], std::span(plane).subspan(1), viewpoint);
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        constexpr int draws = 20'000;
        for (int draw = 0; draw < draws; ++draw) {
            clouds::cloud noisy;
            for (const auto& p : plane)
                noisy.push_back(p + sigma * random.gaussian() * (p - viewpoint).normalized());
            Eigen::Vector3d n = plane_pca{}(noisy[0], std::span(noisy).subspan(1)).normal;
            if (n.z() < 0) n = -n;
            const Eigen::Vector3d d(n.x(), n.y(), 0.0);
            spread += d * d.transpose() / draws;
        }
        EXPECT_LT((expected.covariance - spread).norm(), 0.05 * spread.norm());
    }
}

/// Where noise along oblique rays is a third of the extent of the nearest neighbors, their
/// covariances hold on average: the part of their extent that is noise does not count.
TEST(with_covariance, holds_where_noise_extends_the_neighborhood) {
    constexpr double sigma = 0.02;
    const Eigen::Vector3d viewpoint(1.2, 0.4, 1.0);
    const with_covariance<plane_pca> estimate{.noise = gnomon::constant_noise{sigma}};
    gnomon::random_stream random(3, 6);
    double nees = 0.0;
    int good = 0;
    constexpr int draws = 2000;
    for (int draw = 0; draw < draws; ++draw) {
        clouds::cloud noisy;
        for (int i = 0; i < 400; ++i) {
            const double half = i == 0 ? 0.02 : 0.3;  // the point itself is near the center
            const Eigen::Vector3d p(random.uniform(-half, half), random.uniform(-half, half), 0.0);
            noisy.push_back(p + sigma * random.gaussian() * (p - viewpoint).normalized());
        }
        const auto nearest = std::span(noisy).subspan(1);
        std::ranges::sort(nearest, {},
                          [&](const Eigen::Vector3d& q) { return (q - noisy[0]).squaredNorm(); });
        const auto belief = estimate(noisy[0], nearest.first(40), viewpoint);
        if (belief.trust != trust::good) continue;
        ++good;
        nees += gnomon::nees(belief, Eigen::Vector3d::UnitZ());
    }
    EXPECT_GT(good, draws * 9 / 10);
    EXPECT_NEAR(nees / good, 2.0, 0.2);
}

/// Points that extend along the rays no farther than their noise do not determine a plane.
TEST(with_covariance, of_noise_alone_is_no_knowledge) {
    const Eigen::Vector3d viewpoint(-1.0, 0.0, 0.02);
    clouds::cloud noise;
    gnomon::random_stream random(4, 6);
    for (int i = 0; i < 40; ++i)
        noise.push_back({0.02 * random.gaussian(), random.uniform(-0.1, 0.1), 0.0});
    const std::span others = std::span(noise).subspan(1);
    // The plane through noise along the rays of one scan line.
    const auto of_noise = with_covariance<plane_pca>{.noise = gnomon::constant_noise{0.02}}(
        noise[0], others, viewpoint);
    EXPECT_EQ(of_noise.trust, trust::weak);
    EXPECT_GT(of_noise.trace(), 1.0);
}

/// Oracle: the derivative of PlanePCA's normal by the range of each point, by differences. All rays
/// are parallel to the normal, so that noise adds nothing to the extent of the points.
TEST(with_covariance, is_the_derivative_of_the_normal) {
    constexpr double sigma = 1e-4;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        gnomon::random_stream random(seed, 8);
        clouds::cloud points;
        for (int i = 0; i < 30; ++i) {
            const Eigen::Vector3d d = clouds::gaussian_vector(random);
            points.push_back({0.1 * d.x(), 0.08 * d.y(), sigma * d.z()});
        }
        const auto normal_of = [](const clouds::cloud& q) {
            return plane_pca{}(q[0], std::span(q).subspan(1)).normal;
        };
        const Eigen::Vector3d n = normal_of(points);
        Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
        for (std::size_t i = 0; i < points.size(); ++i) {
            constexpr double h = 1e-5;
            clouds::cloud farther = points;
            clouds::cloud nearer = points;
            farther[i] += h * n;
            nearer[i] -= h * n;
            const Eigen::Vector3d slope = (normal_of(farther) - normal_of(nearer)) / (2.0 * h);
            expected += sigma * sigma * slope * slope.transpose();
        }
        const auto belief = with_covariance<plane_pca>{.noise = gnomon::constant_noise{sigma}}(
            points[0], std::span(points).subspan(1), points[0] - 1e6 * n);
        EXPECT_LT((belief.covariance - expected).norm(), 1e-5 * expected.norm());
    }
}

/// Whatever the method, its own normal is kept, and gets a covariance.
TEST(with_covariance, accepts_any_estimator) {
    const auto s = laws::sample_neighborhood(1);
    const auto pca = with_covariance<plane_pca>{}(s.p, s.neighbors, s.viewpoint);
    const auto svd = with_covariance<gnomon::plane_svd>{}(s.p, s.neighbors, s.viewpoint);
    const auto area = with_covariance<gnomon::area_weighted>{}(s.p, s.neighbors, s.viewpoint);
    EXPECT_EQ(pca.normal, plane_pca{}(s.p, s.neighbors).normal);
    EXPECT_EQ(pca.aspect_ratio(), plane_pca{}(s.p, s.neighbors).aspect_ratio());
    EXPECT_EQ(svd.normal, gnomon::plane_svd{}(s.p, s.neighbors, s.viewpoint).normal);
    EXPECT_GT(svd.trace(), 0.0);
    EXPECT_GT(area.trace(), 0.0);
    static_assert(gnomon::detail::is_sensitive_to<with_covariance<gnomon::plane_svd>>(
        gnomon::sensitivity::units));
}

TEST(with_covariance, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(2, 0, 0);
    EXPECT_EQ(with_covariance<plane_pca>{}(p, clouds::cloud{{2, 1, 0}}).trust,
              trust::too_few_neighbors);
    EXPECT_EQ(with_covariance<plane_pca>{}(p, clouds::cloud(4, p)).covariance,
              Eigen::Matrix3d::Zero());
    // One scan line and its noise along the rays span a plane that all rays lie in.
    const auto line = with_covariance<plane_pca>{}(
        p, clouds::cloud{{2.1, 1, 0}, {1.9, -1, 0}, {2.2, 0.5, 0}, {1.8, -0.5, 0}});
    EXPECT_EQ(line.trust, trust::weak);
    EXPECT_GT(line.trace(), 1.0);
    EXPECT_THROW((void)(with_covariance<plane_pca>{.noise = gnomon::constant_noise{0.0}}(
                     p, clouds::cloud(4, p))),
                 std::invalid_argument);
}

/// Noise as large as the patch: no normal of it is good.
TEST(with_covariance, of_vague_normals_is_weak) {
    clouds::cloud neighbors;
    for (int i = 0; i < 9; ++i) neighbors.push_back({2.0, 0.02 * (i % 3 - 1), 0.02 * (i / 3 - 1)});
    neighbors.erase(neighbors.begin() + 4);
    const auto belief =
        with_covariance<plane_pca>{.noise = gnomon::constant_noise{0.5}}({2, 0, 0}, neighbors);
    EXPECT_GT(belief.trace(), 1.0);
    EXPECT_EQ(belief.trust, trust::weak);
    EXPECT_EQ(gnomon::plane_eif{.noise = gnomon::constant_noise{0.5}}({2, 0, 0}, neighbors).trust,
              trust::weak);
    EXPECT_EQ(gnomon::plane_eif{.noise = gnomon::constant_noise{0.001}}({2, 0, 0}, neighbors).trust,
              trust::good);
}

TEST(with_covariance, laws_hold) {
    laws::estimator_laws(with_covariance<plane_pca>{});
    laws::covariances_are_bounded(
        with_covariance<gnomon::plane_svd>{.noise = gnomon::constant_noise{10.0}});
    laws::covariances_are_bounded(
        with_covariance<gnomon::area_weighted>{.noise = gnomon::constant_noise{1e-6}});
}

}  // namespace

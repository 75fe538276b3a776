// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/quad_svd.hpp>

namespace {

using gnomon::quad_svd, gnomon::trust;

/// [R 1], k x 10, in the sensor's frame, and the gradient at the point. Eq. (3.7), Tab. 3.1. The
/// gap is that of singular values, as nothing is squared, less what the gradient's length costs.
oracles::answer literal_quad_svd(const laws::neighborhood_sample& sample) {
    const oracles::vector3 origin = sample.viewpoint.cast<long double>();
    const oracles::matrix m = oracles::rows_of(sample, false, 10, [&](const oracles::vector3& q) {
        const oracles::vector3 x = q - origin;
        oracles::vector row(10);
        row << x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[0] * x[2], x[1] * x[2], x[0],
            x[1], x[2], 1.0L;
        return row;
    });
    const Eigen::JacobiSVD<oracles::matrix> svd(m, Eigen::ComputeFullV);
    const oracles::vector c = svd.matrixV().col(9);
    oracles::vector s = oracles::vector::Zero(10);
    s.head(svd.singularValues().size()) = svd.singularValues();
    const oracles::vector3 x = sample.p.cast<long double>() - origin;
    const oracles::vector3 gradient(2 * c[0] * x[0] + c[3] * x[1] + c[4] * x[2] + c[6],
                                    2 * c[1] * x[1] + c[3] * x[0] + c[5] * x[2] + c[7],
                                    2 * c[2] * x[2] + c[4] * x[0] + c[5] * x[1] + c[8]);
    const double gap = static_cast<double>((s[8] - s[9]) / s[0]);
    const double loss = static_cast<double>(gradient.norm() / (1.0L + 2.0L * x.norm()));
    return {gradient.normalized().cast<double>(), gap * std::min(1.0, loss)};
}

/// The QR route does not square: the angle is at most 1e-14 over the gap of singular values.
TEST(quad_svd, agrees_with_a_dense_svd) {
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
        const auto sample = oracles::neighborhood_of_few_digits(seed);
        const auto found = laws::estimate_one(quad_svd{}, sample);
        if (sample.neighbors.size() < 9) {
            ASSERT_EQ(found.trust, trust::too_few_neighbors);
            continue;
        }
        const auto expected = literal_quad_svd(sample);
        if (found.trust != trust::good) {
            ASSERT_LT(expected.gap, 2e-12) << "seed " << seed;
            continue;
        }
        ++compared;
        ASSERT_LE(laws::angle_between(found.normal, expected.normal),
                  oracles::allowed(expected.gap))
            << "seed " << seed << " gap " << expected.gap;
    }
    EXPECT_GT(compared, 7000);
}

/// Points of a quadric near p, without noise, and its normal there.
struct quadric_patch {
    Eigen::Vector3d p, normal;
    clouds::cloud neighbors;
};
quadric_patch patch(int kind, std::uint64_t seed) {
    gnomon::random_stream random(seed, 11);
    const Eigen::Matrix3d r = clouds::random_rotation(seed);
    const Eigen::Vector3d center(random.uniform(1, 3), random.uniform(-1, 1),
                                 random.uniform(-1, 1));
    const Eigen::Vector3d axes(0.5, kind == 1 ? 0.8 : 0.5, kind == 1 ? 0.6 : 0.5);
    const auto surface = [&](double u, double v) -> Eigen::Vector3d {
        switch (kind) {
            case 0:  // sphere
            case 1:  // ellipsoid
                return {axes[0] * std::sin(u) * std::cos(v), axes[1] * std::sin(v),
                        axes[2] * std::cos(u) * std::cos(v)};
            case 2:  // cylinder
                return {0.5 * std::sin(u), v, 0.5 * std::cos(u)};
            default:  // paraboloid
                return {u, v, u * u - 0.5 * v * v};
        }
    };
    quadric_patch s;
    s.p = center + r * surface(0.1, 0.05);
    for (int i = 0; i < 30; ++i)
        s.neighbors.push_back(center + r * surface(0.1 + random.uniform(-0.4, 0.4),
                                                   0.05 + random.uniform(-0.4, 0.4)));
    constexpr double h = 1e-6;
    const Eigen::Vector3d du = surface(0.1 + h, 0.05) - surface(0.1 - h, 0.05);
    const Eigen::Vector3d dv = surface(0.1, 0.05 + h) - surface(0.1, 0.05 - h);
    s.normal = r * du.cross(dv).normalized();
    return s;
}

TEST(quad_svd, is_exact_on_quadrics) {
    for (int kind = 0; kind < 4; ++kind) {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            SCOPED_TRACE(testing::Message() << "kind " << kind << " seed " << seed);
            const auto s = patch(kind, seed);
            for (const bool centred : {false, true}) {
                const auto fit = quad_svd{.centred = centred}(s.p, s.neighbors);
                ASSERT_EQ(fit.trust, trust::good);
                ASSERT_LT(laws::angle_between(fit.normal, s.normal), 1e-6);
            }
            ASSERT_GT(laws::angle_between(gnomon::plane_pca{}(s.p, s.neighbors).normal, s.normal),
                      1e-4);
        }
    }
}

/// Many pairs of planes contain a perfect plane; the normal is then that of PlanePCA, and weak.
TEST(quad_svd, of_a_perfect_plane_is_weak) {
    clouds::cloud neighbors;
    for (int i = 0; i < 20; ++i) neighbors.push_back({0.1 * (i % 5), 0.1 * (i / 5), 1.0});
    const auto fit = quad_svd{}({0.2, 0.2, 1.0}, neighbors);
    EXPECT_EQ(fit.trust, trust::weak);
    EXPECT_LT(laws::angle_between(fit.normal, Eigen::Vector3d::UnitZ()), 1e-12);
    EXPECT_EQ(quad_svd{}({0, 0, 1}, clouds::cloud(9, {0, 0, 1})).trust, trust::degenerate);
    EXPECT_EQ(quad_svd{}({0, 0, 1}, clouds::cloud(8, {0, 0, 1})).trust, trust::too_few_neighbors);
}

TEST(quad_svd, laws_hold) {
    // Ten unknowns lose more digits than three.
    for (const quad_svd& estimate : {quad_svd{}, quad_svd{.centred = true}}) {
        laws::normals_are_unit_or_zero(estimate);
        laws::normal_follows_the_cloud(estimate, 1e-8);
        laws::result_does_not_depend_on_execution(estimate);
    }
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `curvature_estimator` concept as test functions, for the library's models and
/// for user-defined ones. Neighborhoods are sampled from curved, noisy surface patches whose
/// principal curvatures differ clearly.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "features/patches.hpp"
#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/features/curvature.hpp>
#include <gnomon/features/estimate_curvature.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace laws {

/// The smallest surface element.
struct only_normal {
    Eigen::Vector3d normal;
};

/// A point and its neighbors on a curved, noisy surface patch.
struct bent_sample {
    clouds::cloud neighbors;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();

    explicit bent_sample(std::uint64_t seed) {
        const auto all = patches::all();
        neighbors = patches::neighborhood_of(all[2 + seed % 2], 40, 0.2, seed, 1e-3);
        p.z() = 1e-3;
    }
};

inline void expect_no_curvature(const gnomon::curvature& c) {
    EXPECT_FALSE(gnomon::usable(c.trust));
    EXPECT_EQ(c.kappa1, 0.0);
    EXPECT_EQ(c.kappa2, 0.0);
    EXPECT_EQ(c.direction1, patches::zero);
    EXPECT_EQ(c.direction2, patches::zero);
}

inline void expect_same_curvature(const gnomon::curvature& a, const gnomon::curvature& b,
                                  double tolerance) {
    ASSERT_EQ(a.trust, b.trust);
    ASSERT_NEAR(a.kappa1, b.kappa1, tolerance);
    ASSERT_NEAR(a.kappa2, b.kappa2, tolerance);
    ASSERT_LT(angle_between(a.direction1, b.direction1), tolerance);
    ASSERT_LT(angle_between(a.direction2, b.direction2), tolerance);
}

// [curvatures_are_finite_or_zero]
/// For any points and any normals: a usable result is finite, with perpendicular unit directions;
/// an unusable result is zero.
template <gnomon::curvature_estimator C>
void curvatures_are_finite_or_zero(const C& estimate) {
    using gnomon::knn, gnomon::trust;
    auto all = clouds::degenerate();
    all.push_back({"sheet", clouds::sheet(500, 1)});
    for (const auto& [name, points] : all) {
        SCOPED_TRACE(name);
        for (const std::size_t k : {1u, 2u, 3u, 5u, 9u, 50u}) {
            const auto estimated = gnomon::estimate_normals(points, knn{k}, gnomon::plane_pca{});
            std::vector<only_normal> pca;
            for (const auto& s : estimated) pca.push_back({s.normal});
            const std::vector<only_normal> upright(points.size(), {patches::up});
            const std::vector<only_normal> oblique(points.size(), {{0.6, 0.0, -0.8}});
            for (const auto& surface : {pca, upright, oblique}) {
                const auto result = gnomon::estimate_curvature(points, knn{k}, surface, estimate);
                ASSERT_EQ(result.size(), points.size());
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const gnomon::curvature& c = result[i];
                    ASSERT_TRUE(std::isfinite(c.gaussian()) && std::isfinite(c.mean()));
                    ASSERT_GE(c.kappa1, c.kappa2);
                    ASSERT_TRUE(c.trust == trust::not_finite || gnomon::is_finite(points[i]));
                    const double length = gnomon::usable(c.trust) ? 1.0 : 0.0;
                    ASSERT_NEAR(c.direction1.norm(), length, 1e-12);
                    ASSERT_NEAR(c.direction2.norm(), length, 1e-12);
                    ASSERT_NEAR(c.direction1.dot(c.direction2), 0.0, 1e-12);
                    if (!gnomon::usable(c.trust)) {
                        ASSERT_EQ(c.kappa1, 0.0);
                        ASSERT_EQ(c.kappa2, 0.0);
                    }
                }
            }
        }
    }
}
// [curvatures_are_finite_or_zero]

// [curvature_follows_the_cloud]
/// Invariance to order and translation, equivariance under rotation, and the sign rule of the
/// normal.
template <gnomon::curvature_estimator C>
void curvature_follows_the_cloud(const C& estimate) {
    using patches::up, patches::zero;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto [neighbors, p] = bent_sample(seed);
        const gnomon::curvature c = estimate(p, up, neighbors);
        ASSERT_EQ(c.trust, gnomon::trust::good);
        ASSERT_GT(c.kappa1 - c.kappa2, 1.0);

        std::vector<std::size_t> order;
        expect_same_curvature(estimate(p, up, clouds::permuted(neighbors, seed, order)), c, 1e-10);

        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        for (const Eigen::Vector3d& t : {zero, Eigen::Vector3d(6e5, 4.8e6, 100)}) {
            const double tolerance = t == zero ? 1e-10 : 1e-5;  // rounded to 1e-9 m there
            gnomon::curvature expected = c;
            expected.direction1 = r * c.direction1;
            expected.direction2 = r * c.direction2;
            expect_same_curvature(estimate(r * p + t, r * up, clouds::moved(neighbors, r, t)),
                                  expected, tolerance);
        }

        const gnomon::curvature back = estimate(p, -up, neighbors);
        ASSERT_NEAR(back.mean(), -c.mean(), 1e-10);
        ASSERT_NEAR(back.gaussian(), c.gaussian(), 1e-9);
        ASSERT_LT(angle_between(back.direction1, c.direction2), 1e-10);
    }
}
// [curvature_follows_the_cloud]

// [curvature_is_one_over_a_length]
/// Scaling a cloud by s scales its curvatures by 1/s.
template <gnomon::curvature_estimator C>
void curvature_is_one_over_a_length(const C& estimate) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto [neighbors, p] = bent_sample(seed);
        const gnomon::curvature c = estimate(p, patches::up, neighbors);
        for (const double s : {1e-30, 1e-3, 7.0, 1e30}) {
            const Eigen::Matrix3d scaling = s * Eigen::Matrix3d::Identity();
            gnomon::curvature scaled =
                estimate(s * p, patches::up, clouds::moved(neighbors, scaling, patches::zero));
            scaled.kappa1 *= s;
            scaled.kappa2 *= s;
            expect_same_curvature(scaled, c, 1e-10);
        }
    }
}
// [curvature_is_one_over_a_length]

}  // namespace laws

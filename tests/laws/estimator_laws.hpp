// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `estimator` concept, for any model, also user-defined ones. Neighborhoods are
/// random samples of curved sheets with noise, whose normal is well determined; covariances are
/// checked on random neighborhoods of any shape and size.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/estimator.hpp>

namespace laws {

/// The angle between two directions without regard to their signs [rad].
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d cross(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                                a.x() * b.y() - a.y() * b.x());
    return std::atan2(cross.norm(), std::abs(a.dot(b)));
}

/// A point, its neighbors and their view point.
struct neighborhood_sample {
    Eigen::Vector3d p;
    clouds::cloud neighbors;
    Eigen::Vector3d viewpoint = {0.2, 0.4, 2.5};
};

inline neighborhood_sample sample_neighborhood(std::uint64_t seed) {
    const clouds::cloud sheet = clouds::sheet(41, seed);
    return {sheet[0], {sheet.begin() + 1, sheet.end()}};
}

template <gnomon::estimator E>
gnomon::surfel<gnomon::estimate_t<E>> estimate_one(const E& estimate,
                                                   const neighborhood_sample& sample) {
    const auto& [p, neighbors, viewpoint] = sample;
    clouds::cloud points{p};
    points.insert(points.end(), neighbors.begin(), neighbors.end());
    std::vector<std::vector<gnomon::point_index>> graph(points.size());
    for (std::size_t j = 1; j < points.size(); ++j) {
        graph[0].push_back(static_cast<gnomon::point_index>(j));
    }
    return gnomon::estimate_normals(gnomon::with_viewpoint(points, viewpoint), graph, estimate)[0];
}

// [normals_are_unit_or_zero]
/// A usable normal has unit length, an unusable one is zero, and no number is NaN.
template <gnomon::estimator E>
void normals_are_unit_or_zero(const E& estimate) {
    auto all = clouds::degenerate();
    all.push_back({"sheet", clouds::sheet(500, 1)});
    for (const auto& [name, points] : all) {
        SCOPED_TRACE(name);
        for (const std::size_t k : {1u, 2u, 3u, 9u, 50u}) {
            const auto surface = gnomon::estimate_normals(points, gnomon::knn{k}, estimate);
            ASSERT_EQ(surface.size(), points.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto& s = surface[i];
                ASSERT_TRUE(s.normal.allFinite() && std::isfinite(s.mean_distance));
                ASSERT_TRUE(s.trust == gnomon::trust::not_finite || gnomon::is_finite(points[i]));
                ASSERT_NEAR(s.normal.norm(), gnomon::usable(s.trust) ? 1.0 : 0.0, 1e-12);
            }
        }
    }
}
// [normals_are_unit_or_zero]

// [normal_follows_the_cloud]
/// The normal is invariant to permutations of the neighbors, to translation and to scaling of
/// neighbors and view point, and equivariant to their rotation, up to its sign. Invariances that
/// the estimator excludes in `sensitive_to` are not checked.
template <gnomon::estimator E>
void normal_follows_the_cloud(const E& estimate, double tolerance = 1e-11) {
    using gnomon::sensitivity;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        const neighborhood_sample sample = sample_neighborhood(seed);
        const Eigen::Vector3d n = estimate_one(estimate, sample).normal;
        ASSERT_GT(n.norm(), 0.5);
        const auto expect = [&](const Eigen::Matrix3d& r, const Eigen::Vector3d& t,
                                double allowed) {
            const auto moved =
                estimate_one(estimate, {r * sample.p + t, clouds::moved(sample.neighbors, r, t),
                                        r * sample.viewpoint + t});
            ASSERT_LT(angle_between(r.colwise().normalized() * n, moved.normal), allowed);
        };
        const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
        expect(identity, {3, -4, 5}, 10 * tolerance);
        expect(identity, {6e5, 4.8e6, 100}, 1e5 * tolerance);  // rounded to 1e-9 m there
        if (!gnomon::detail::is_sensitive_to<E>(sensitivity::order)) {
            std::vector<std::size_t> order;
            neighborhood_sample other = sample;
            other.neighbors = clouds::permuted(sample.neighbors, seed, order);
            ASSERT_LT(angle_between(n, estimate_one(estimate, other).normal), tolerance);
        }
        if (!gnomon::detail::is_sensitive_to<E>(sensitivity::units)) {
            expect(1e-3 * identity, {0, 0, 0}, tolerance);
            expect(1e3 * identity, {0, 0, 0}, tolerance);
        }
        if (!gnomon::detail::is_sensitive_to<E>(sensitivity::axes))
            expect(clouds::random_rotation(seed), {0, 0, 0}, tolerance);
    }
}
// [normal_follows_the_cloud]

/// A random neighborhood: spread by random amounts in three random directions (a flat patch, a
/// scan line, one place or a ball), of 2 to 40 points, at the scale `scale` [m], with a
/// random view point of the same scale.
inline neighborhood_sample random_neighborhood(std::uint64_t seed, double scale) {
    gnomon::random_stream random(seed, 3);
    const Eigen::Matrix3d rotation = clouds::random_rotation(seed);
    Eigen::Vector3d extent;
    for (int a = 0; a < 3; ++a) extent[a] = std::pow(10.0, random.uniform(-9.0, 0.0));
    if (random.uniform() < 0.5) extent[static_cast<int>(random.below(3))] = 0.0;
    const Eigen::Vector3d center = clouds::gaussian_vector(random);
    const auto draw = [&]() -> Eigen::Vector3d {
        return scale * (center + rotation * extent.cwiseProduct(clouds::gaussian_vector(random)));
    };
    neighborhood_sample sample{.p = draw(), .neighbors = {}};
    const std::size_t k = 2 + random.below(39);
    for (std::size_t j = 0; j < k; ++j) sample.neighbors.push_back(draw());
    sample.viewpoint = scale * clouds::gaussian_vector(random);
    // Every fourth view point is in the plane of the first two directions: grazing rays.
    if (seed % 4 == 0) sample.viewpoint = scale * (center + rotation.col(0) + rotation.col(1));
    return sample;
}

/// An estimator that gives a covariance of its normal.
template <class E>
concept gives_covariance =
    gnomon::estimator<E> && requires(const gnomon::estimate_t<E>& e) { e.covariance; };

/// The covariance [rad^2] of a usable normal is finite, symmetric and zero along the normal; no
/// eigenvalue is negative or above (pi/2)^2, since no two axes are farther apart, and a normal with
/// an eigenvalue there is weak. The covariance of an unusable normal is zero.
template <gnomon::normal_estimate Estimate>
void expect_covariance_of_an_axis(const Estimate& estimate) {
    const Eigen::Matrix3d& c = estimate.covariance;
    if (!gnomon::usable(estimate.trust)) {
        ASSERT_EQ(c, Eigen::Matrix3d::Zero());
        return;
    }
    ASSERT_TRUE(c.allFinite()) << c;
    ASSERT_LT((c - c.transpose()).norm(), 1e-14 * c.norm() + 1e-300);
    ASSERT_LT((c * estimate.normal).norm(), 1e-12 * c.norm() + 1e-300);
    const Eigen::Vector3d eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c, Eigen::EigenvaluesOnly).eigenvalues();
    constexpr double largest = 0.25 * std::numbers::pi * std::numbers::pi;
    ASSERT_LT(eigenvalues[2], largest * (1.0 + 1e-12)) << c;
    ASSERT_GT(eigenvalues[0], -1e-13 * eigenvalues[2] - 1e-300) << c;
    if (eigenvalues[2] > 0.99 * largest) {
        ASSERT_EQ(estimate.trust, gnomon::trust::weak);
    }
}

/// The covariance is that of an axis for neighborhoods of any shape, from 1e-160 to 1e140 m, and
/// for any view point.
template <gives_covariance E>
void covariances_are_bounded(const E& estimate) {
    for (const double scale : {1e-160, 1e-150, 1e-80, 1e-6, 1.0, 1e6, 1e80, 1e140}) {
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", scale " << scale);
            neighborhood_sample sample = random_neighborhood(seed, scale);
            const auto& [p, neighbors, viewpoint] = sample;
            for (const Eigen::Vector3d& v :
                 {viewpoint, p, Eigen::Vector3d(0.2, 0.4, 2.5), Eigen::Vector3d(clouds::nan, 0, 0),
                  Eigen::Vector3d(0, clouds::infinity, 0)}) {
                expect_covariance_of_an_axis(estimate(p, neighbors, v));
                if (testing::Test::HasFatalFailure()) return;
            }
            expect_covariance_of_an_axis(estimate_one(estimate, sample));
            if (testing::Test::HasFatalFailure()) return;
        }
    }
}

// [moments_are_enough]
/// A moment estimator returns the same result from the moments.
template <gnomon::moment_estimator E>
void moments_are_enough(const E& estimate) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto [p, neighbors, viewpoint] = sample_neighborhood(seed);
        const auto from_neighborhood = estimate(p, neighbors);
        const auto from_moments = estimate(gnomon::moments::about(p, neighbors));
        ASSERT_EQ(from_neighborhood.normal, from_moments.normal);
        ASSERT_EQ(from_neighborhood.trust, from_moments.trust);
    }
}
// [moments_are_enough]

// [result_does_not_depend_on_execution]
/// The result has the same bytes on any number of threads, and also from a stored graph. Only for
/// moment estimators a stored graph gives another rounding: sweeps sum the moments in another
/// order.
template <gnomon::estimator E>
void result_does_not_depend_on_execution(const E& estimate) {
    const clouds::cloud points = clouds::sheet(5000, 8);
    const gnomon::knn policy{.k = 12};
    const auto expect_same = [](const auto& surface, const auto& expected) {
        ASSERT_EQ(surface.size(), expected.size());
        for (std::size_t i = 0; i < surface.size(); ++i) {
            ASSERT_EQ(surface[i].normal, expected[i].normal);
            ASSERT_EQ(surface[i].trust, expected[i].trust);
            ASSERT_EQ(surface[i].mean_distance, expected[i].mean_distance);
            ASSERT_EQ(surface[i].neighbors, expected[i].neighbors);
        }
    };
    const auto found = gnomon::estimate_normals(points, policy, estimate);
    const auto stored = gnomon::estimate_normals(points, policy(points), estimate);
    for (const unsigned t : {1u, 2u, 4u}) {
        const gnomon::threads run{t};
        expect_same(gnomon::estimate_normals(points, policy, estimate, run), found);
        expect_same(gnomon::estimate_normals(points, policy(points), estimate, run), stored);
    }
    if constexpr (!gnomon::moment_estimator<E>) {
        expect_same(found, stored);
    } else {
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_LT(angle_between(found[i].normal, stored[i].normal), 1e-12);
            ASSERT_EQ(found[i].trust, stored[i].trust);
            ASSERT_NEAR(found[i].mean_distance, stored[i].mean_distance, 1e-15);
            ASSERT_EQ(found[i].neighbors, stored[i].neighbors);
        }
    }
}
// [result_does_not_depend_on_execution]

template <gnomon::estimator E>
void estimator_laws(const E& estimate) {
    normals_are_unit_or_zero(estimate);
    normal_follows_the_cloud(estimate);
    result_does_not_depend_on_execution(estimate);
    if constexpr (gnomon::moment_estimator<E>) moments_are_enough(estimate);
    if constexpr (gives_covariance<E>) covariances_are_bounded(estimate);
}

}  // namespace laws

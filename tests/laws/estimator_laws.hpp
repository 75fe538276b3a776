// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `estimator` concept, for any model: yours, too. Rings are drawn from noisy
/// curved sheets, with the normal well determined.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/estimator.hpp>

namespace laws {

/// The angle between two directions, whatever their signs [rad].
inline double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const Eigen::Vector3d cross(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                                a.x() * b.y() - a.y() * b.x());
    return std::atan2(cross.norm(), std::abs(a.dot(b)));
}

/// A point, its ring and from where they were seen.
struct neighborhood_sample {
    Eigen::Vector3d p;
    clouds::cloud ring;
    Eigen::Vector3d viewpoint = {0.2, 0.4, 2.5};
};

inline neighborhood_sample sample_neighborhood(std::uint64_t seed) {
    const clouds::cloud sheet = clouds::sheet(41, seed);
    return {sheet[0], {sheet.begin() + 1, sheet.end()}};
}

template <gnomon::estimator E>
gnomon::surfel<gnomon::estimate_t<E>> estimate_one(const E& estimate,
                                                   const neighborhood_sample& sample) {
    const auto& [p, ring, viewpoint] = sample;
    clouds::cloud points{p};
    points.insert(points.end(), ring.begin(), ring.end());
    std::vector<std::vector<gnomon::point_index>> graph(points.size());
    for (std::size_t j = 1; j < points.size(); ++j) {
        graph[0].push_back(static_cast<gnomon::point_index>(j));
    }
    return gnomon::estimate_normals(gnomon::with_viewpoint(points, viewpoint), graph, estimate)[0];
}

/// A usable normal has unit length, an unusable one is zero, and nothing is ever NaN.
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

/// The same ring in another order, at another place, in another size, or turned; with its view
/// point. Laws to which the estimator says that it is an exception are left out.
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
            const auto moved = estimate_one(
                estimate,
                {r * sample.p + t, clouds::moved(sample.ring, r, t), r * sample.viewpoint + t});
            ASSERT_LT(angle_between(r.colwise().normalized() * n, moved.normal), allowed);
        };
        const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
        expect(identity, {3, -4, 5}, 10 * tolerance);
        expect(identity, {6e5, 4.8e6, 100}, 1e5 * tolerance);  // rounded to 1e-9 m there
        if (!gnomon::is_sensitive_to<E>(sensitivity::order)) {
            std::vector<std::size_t> order;
            neighborhood_sample other = sample;
            other.ring = clouds::permuted(sample.ring, seed, order);
            ASSERT_LT(angle_between(n, estimate_one(estimate, other).normal), tolerance);
        }
        if (!gnomon::is_sensitive_to<E>(sensitivity::units)) {
            expect(1e-3 * identity, {0, 0, 0}, tolerance);
            expect(1e3 * identity, {0, 0, 0}, tolerance);
        }
        if (!gnomon::is_sensitive_to<E>(sensitivity::axes))
            expect(clouds::random_rotation(seed), {0, 0, 0}, tolerance);
    }
}

/// A moment estimator finds the same in the moments.
template <gnomon::moment_estimator E>
void moments_are_enough(const E& estimate) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto [p, ring, viewpoint] = sample_neighborhood(seed);
        const auto from_ring = estimate(p, ring);
        const auto from_moments = estimate(gnomon::moments_about(p, ring));
        ASSERT_EQ(from_ring.normal, from_moments.normal);
        ASSERT_EQ(from_ring.trust, from_moments.trust);
    }
}

/// The same bytes on any number of threads. From a stored graph, too, but that a moment estimator's
/// sums are then taken in another order than by a search that lists no neighbors.
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

template <gnomon::estimator E>
void estimator_laws(const E& estimate) {
    normals_are_unit_or_zero(estimate);
    normal_follows_the_cloud(estimate);
    result_does_not_depend_on_execution(estimate);
    if constexpr (gnomon::moment_estimator<E>) moments_are_enough(estimate);
}

}  // namespace laws

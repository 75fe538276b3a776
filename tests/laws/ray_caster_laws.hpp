// SPDX-License-Identifier: BSL-1.0
/// @file
/// The law of the `ray_caster` concept, to be run on every model, yours too: the answer is that of
/// casting the ray at all shapes one by one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/ray_caster.hpp>
#include <gnomon/simulation/scene.hpp>

namespace laws {

namespace sim = gnomon::simulation;

/// Oracle.
inline std::optional<sim::ray_hit> by_asking_all(const sim::scene& world, sim::ray r) {
    std::optional<sim::ray_hit> nearest;
    for (const auto& s : world.shapes()) {
        if (const auto hit = s.first_hit(r)) {
            nearest = hit;
            r.reach = hit->range;
        }
    }
    return nearest;
}

/// A ray from anywhere within the bounds in any direction.
inline sim::ray ray_within(const sim::bounds& extent, gnomon::random_stream& random) {
    Eigen::Vector3d from;
    for (int a = 0; a < 3; ++a) from[a] = random.uniform(extent.low[a], extent.high[a]);
    const Eigen::Vector3d u(random.gaussian(), random.gaussian(), random.gaussian());
    return {from, u.normalized()};
}

/// How a caster compares with the oracle.
struct casting {
    std::size_t hits = 0;      ///< of the oracle
    std::size_t others = 0;    ///< rays for which one hits and the other does not, or elsewhere
    std::size_t ties = 0;      ///< rays that met two surfaces at once: each reported another one
    double worst_range = 0.0;  ///< largest relative difference where both hit the same surface
};

// [compare_casters]
inline casting compare_casters(const sim::scene& world, const sim::ray_caster auto& caster,
                               std::size_t rays, std::uint64_t seed, double precision = 1e-12) {
    casting result;
    gnomon::random_stream random(seed, 31);
    const sim::bounds extent = world.extent();
    for (std::size_t i = 0; i < rays; ++i) {
        sim::ray r = ray_within(extent, random);
        if (i % 4 == 0) r.reach = random.uniform(0.0, 4.0);
        const auto expected = by_asking_all(world, r);
        const auto found = caster(r);
        if (expected) ++result.hits;
        if (expected.has_value() != found.has_value()) ++result.others;
        if (!expected || !found) continue;
        const double difference = std::abs(found->range - expected->range) / expected->range;
        if (expected->surface != found->surface) {
            ++(difference <= precision ? result.ties : result.others);
        } else {
            EXPECT_GT(found->normal.dot(expected->normal), 1 - 1e-5);
            result.worst_range = std::max(result.worst_range, difference);
        }
    }
    return result;
}
// [compare_casters]

/// The same surfaces at the same ranges, for a caster of which single rays may not err.
/// @param precision  of ranges, relative
/// @return how many rays hit
inline std::size_t obeys_ray_caster_laws(const sim::scene& world,
                                         const sim::ray_caster auto& caster, std::uint64_t seed,
                                         double precision = 1e-12) {
    const casting result = compare_casters(world, caster, 20'000, seed, precision);
    EXPECT_EQ(result.others, 0u);
    EXPECT_LE(result.ties, result.hits / 100);  // a cupboard's back at the wall
    EXPECT_LE(result.worst_range, precision);
    return result.hits;
}

}  // namespace laws

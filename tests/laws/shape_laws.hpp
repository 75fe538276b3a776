// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `shape` concept, to be run on every model, yours too; and an oracle for those
/// that know an equation of their surface.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace laws {

namespace sim = gnomon::simulation;

inline Eigen::Vector3d random_direction(gnomon::random_stream& random) {
    return Eigen::Vector3d(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
}

/// Rays towards, past and from within a shape, and along the axes.
inline std::vector<sim::ray> rays_at(const sim::bounds& extent, std::size_t n, std::uint64_t seed) {
    const Eigen::Vector3d middle = 0.5 * (extent.low + extent.high);
    const double size = (extent.high - extent.low).norm();
    gnomon::random_stream random(seed, 21);
    std::vector<sim::ray> rays;
    for (std::size_t i = 0; i < n; ++i) {
        const double distance = i % 3 == 0 ? random.uniform(0.0, 0.3) : random.uniform(0.5, 20.0);
        const Eigen::Vector3d from = middle + size * distance * random_direction(random);
        const Eigen::Vector3d to =
            middle + 0.6 * size * random.uniform() * random_direction(random);
        sim::ray r{from, (to - from).normalized()};
        if (i % 7 == 0) {
            r.direction.setZero();
            r.direction[static_cast<int>(i % 3)] = i % 2 ? 1.0 : -1.0;
        }
        rays.push_back(r);
    }
    return rays;
}

/// The laws, for rays at the shape; see obeys_shape_laws.
template <sim::shape S>
void expect_shape_laws(const S& s, std::uint64_t seed, std::size_t& hits) {
    const sim::bounds extent = s.extent();
    const double slack = 1e-9 * (1.0 + extent.low.norm() + extent.high.norm());
    for (const sim::ray& r : rays_at(extent, 3000, seed)) {
        const auto hit = s.first_hit(r);
        if (!hit) continue;
        ++hits;
        // [hits_are_valid]
        EXPECT_GT(hit->range, 0.0);
        EXPECT_NEAR(hit->normal.norm(), 1.0, 1e-12);
        EXPECT_LE(hit->normal.dot(r.direction), 1e-12);
        EXPECT_GE(hit->surface, 0);
        EXPECT_LT(static_cast<std::size_t>(hit->surface), s.surface_names().size());
        const Eigen::Vector3d p = r.point_at(hit->range);
        for (int a = 0; a < 3; ++a) {
            EXPECT_GE(p[a], extent.low[a] - slack * (1 + hit->range));
            EXPECT_LE(p[a], extent.high[a] + slack * (1 + hit->range));
        }
        // [hits_are_valid]

        sim::ray shorter = r;
        shorter.reach = hit->range;
        const auto same = s.first_hit(shorter);
        EXPECT_TRUE(same && same->range == hit->range && same->surface == hit->surface);
        shorter.reach = hit->range * (1 - 1e-9);
        EXPECT_FALSE(s.first_hit(shorter));

        const double step = hit->range * (1 + 1e-9) + 1e-9;
        const auto next = s.first_hit({r.point_at(step), r.direction});
        if (next && next->range > 1e-6) {
            const double half = 0.5 * next->range;
            const auto from_half_way = s.first_hit({r.point_at(step + half), r.direction});
            ASSERT_TRUE(from_half_way);
            EXPECT_NEAR(from_half_way->range, half, 1e-9 * (1.0 + half));
            EXPECT_EQ(from_half_way->surface, next->surface);
        }
        // Who looks back from far behind the shape sees the last of it, which is the hit itself or
        // lies behind, where the ray that goes on has met it, or something nearer.
        const double behind = hit->range + 2.0 * (extent.high - extent.low).norm() + 1.0;
        const auto last = s.first_hit({r.point_at(behind), -r.direction});
        ASSERT_TRUE(last);
        const double until = behind - last->range;
        EXPECT_GE(until, hit->range - 1e-9 * (1.0 + behind));
        if (until > step + 1e-6) {
            ASSERT_TRUE(next);
            EXPECT_LE(step + next->range, until + 1e-9 * (1.0 + behind));
        }
    }

    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Eigen::Vector3d inside = 0.5 * (extent.low + extent.high);
    for (const sim::ray& broken :
         {sim::ray{inside, {0, 0, 0}}, sim::ray{inside, {nan, 0, 1}},
          sim::ray{{nan, nan, nan}, {0, 0, 1}}, sim::ray{{0, 0, nan}, {0, 0, -1}},
          sim::ray{inside, {1, 0, 0}, nan}, sim::ray{inside, {1, 0, 0}, 0.0},
          sim::ray{inside, {1, 0, 0}, -1.0}}) {
        EXPECT_FALSE(s.first_hit(broken));
    }
}

/// @return how many of the rays hit
template <sim::shape S>
std::size_t obeys_shape_laws(const S& s, std::uint64_t seed) {
    std::size_t hits = 0;
    expect_shape_laws(s, seed, hits);
    return hits;
}

/// The oracle, in long double: f(x, y, z) is negative within the solid and positive without. Ranges
/// are right to 1e-12 relative (a Newton step on f along the ray leads no farther) where
/// |n . u| > 0.01, normals are the gradient, and no sample before the hit lies on the other side.
/// @return how many hits were held against it
template <sim::shape S>
std::size_t agrees_with_equation(const S& s, std::uint64_t seed, auto&& f) {
    using real = long double;
    std::size_t compared = 0;
    for (const sim::ray& r : rays_at(s.extent(), 3000, seed)) {
        const auto at = [&](real t) {
            return f(real(r.origin.x()) + t * real(r.direction.x()),
                     real(r.origin.y()) + t * real(r.direction.y()),
                     real(r.origin.z()) + t * real(r.direction.z()));
        };
        const auto hit = s.first_hit(r);
        const bool starts_inside = at(0) < 0;
        const real until = hit ? real(hit->range) * (1 - 1e-6L)
                               : 50 * real((s.extent().high - s.extent().low).norm());
        for (int k = 1; k < 400; ++k) {
            const real value = at(until * k / 400);
            EXPECT_TRUE(value == 0 || (value < 0) == starts_inside);
        }
        if (!hit || std::abs(hit->normal.dot(r.direction)) < 0.01) continue;
        const real h = 1e-7L * real(hit->range);
        const real t = hit->range;
        const real slope = (at(t + h) - at(t - h)) / (2 * h);
        // On an edge, where two equations meet, the slope is neither's.
        if (std::abs((at(t + h) + at(t - h) - 2 * at(t)) / (h * slope)) > 1e-4L) continue;
        EXPECT_LE(std::abs(at(t) / slope), 1e-12L * t);
        ++compared;

        const Eigen::Vector3d p = r.point_at(hit->range);
        Eigen::Vector3d gradient;
        for (int a = 0; a < 3; ++a) {
            Eigen::Vector3d d = Eigen::Vector3d::Zero();
            d[a] = 1e-6;
            const auto value = [&](const Eigen::Vector3d& q) {
                return f(real(q.x()), real(q.y()), real(q.z()));
            };
            gradient[a] = static_cast<double>((value(p + d) - value(p - d)) / 2e-6L);
        }
        EXPECT_GT(std::abs(gradient.normalized().dot(hit->normal)), 1 - 1e-6);
    }
    return compared;
}

}  // namespace laws

// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/cone.hpp>
#include <gnomon/simulation/surface_of_revolution.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::profile_point;
using sim::surface_of_revolution;
static_assert(sim::shape<surface_of_revolution>);

const std::vector<profile_point> vase_profile{{0.10, 0.00}, {0.18, 0.15}, {0.20, 0.35},
                                              {0.09, 0.50}, {0.07, 0.60}, {0.11, 0.68}};

/// The radius at which a ray from outside meets the mantle at height z.
double radius_at(const surface_of_revolution& s, double z) {
    const auto hit = s.first_hit({{5.0, 0.0, z}, {-1.0, 0.0, 0.0}});
    return hit ? 5.0 - hit->range : -1.0;
}

TEST(surface_of_revolution, obeys_the_laws) {
    for (const bool smooth : {true, false}) {
        const surface_of_revolution vase(vase_profile, {.smooth = smooth, .top = true});
        EXPECT_GT(laws::obeys_shape_laws(vase, 1), 1000u);
    }
}

TEST(surface_of_revolution, interpolates_its_points_monotonically) {
    for (const bool smooth : {true, false}) {
        const surface_of_revolution vase(vase_profile, {.smooth = smooth});
        for (std::size_t i = 0; i + 1 < vase_profile.size(); ++i) {
            const auto [r0, z0] = vase_profile[i];
            const auto [r1, z1] = vase_profile[i + 1];
            EXPECT_NEAR(radius_at(vase, z0), r0, 1e-12);
            double last = r0;
            for (int k = 1; k <= 50; ++k) {
                const double r = radius_at(vase, z0 + (z1 - z0) * k / 50.0);
                EXPECT_GE((r - last) * (r1 - r0), -1e-13);
                last = r;
            }
        }
    }
}

/// The smooth profile has no kink, the straight one has.
TEST(surface_of_revolution, can_be_smooth) {
    for (const bool smooth : {true, false}) {
        const surface_of_revolution vase(vase_profile, {.smooth = smooth});
        double sharpest = 0.0;
        for (double z = 0.01; z < 0.67; z += 1e-4) {
            const auto a = vase.first_hit({{5, 0, z}, {-1, 0, 0}});
            const auto b = vase.first_hit({{5, 0, z + 1e-4}, {-1, 0, 0}});
            sharpest = std::max(sharpest, (a->normal - b->normal).norm());
        }
        EXPECT_EQ(sharpest < 0.02, smooth) << sharpest;
    }
}

TEST(surface_of_revolution, of_two_points_is_a_cone) {
    const sim::cone cone{0.3, 0.8};
    const surface_of_revolution same({{0.3, 0.0}, {0.0, 0.8}}, {.smooth = false});
    std::size_t hits = 0;
    for (const sim::ray& r : laws::rays_at(cone.extent(), 2000, 5)) {
        const auto expected = cone.first_hit(r);
        const auto found = same.first_hit(r);
        ASSERT_EQ(expected.has_value(), found.has_value());
        if (!expected) continue;
        EXPECT_NEAR(found->range, expected->range, 1e-12 * (1.0 + expected->range));
        EXPECT_EQ(found->surface, expected->surface);
        ++hits;
    }
    EXPECT_GT(hits, 500u);
}

/// Rays from anywhere see the radius that level rays see.
TEST(surface_of_revolution, is_rotationally_symmetric) {
    const surface_of_revolution vase(vase_profile);
    std::size_t hits = 0;
    for (const sim::ray& r : laws::rays_at(vase.extent(), 2000, 5)) {
        const auto hit = vase.first_hit(r);
        if (!hit || hit->surface != 0 || hit->range > 5.0) continue;
        const Eigen::Vector3d p = r.point_at(hit->range);
        EXPECT_NEAR(std::hypot(p.x(), p.y()), radius_at(vase, p.z()), 1e-11);
        ++hits;
    }
    EXPECT_GT(hits, 500u);
}

/// The same vase wherever its profile begins, but for the rounding of the heights.
TEST(surface_of_revolution, can_begin_at_any_height) {
    for (const double begin : {1.0, 1e3, 5e6}) {
        std::vector<profile_point> profile = vase_profile;
        for (profile_point& p : profile) p.height += begin;
        for (const bool smooth : {true, false}) {
            const surface_of_revolution at_zero(vase_profile, {.smooth = smooth});
            const surface_of_revolution vase(profile, {.smooth = smooth});
            EXPECT_NEAR(vase.extent().low.z(), begin, 1e-15 * begin);
            for (double z = 0.005; z < 0.68; z += 0.01) {
                EXPECT_NEAR(radius_at(vase, begin + z), radius_at(at_zero, z),
                            1e-13 + 1e-14 * begin);
            }
        }
    }
}

/// Rays from within at the joints of arcs, where two of them could each leave the hit to the other.
TEST(surface_of_revolution, leaves_no_gap_between_arcs) {
    for (const double begin : {0.0, 1.0, 10.0, 1000.0}) {
        std::vector<profile_point> profile;
        for (int i = 0; i < 1000; ++i)
            profile.push_back({1.0 + 0.05 * std::sin(0.007 * i), begin + 0.001 * i});
        for (const bool smooth : {true, false}) {
            const surface_of_revolution pipe(profile, {.smooth = smooth, .top = true});
            gnomon::random_stream random(2);
            for (int i = 0; i < 2000; ++i) {
                const auto [radius, height] = profile[1 + random.below(998)];
                const double a = random.uniform(0.0, 6.28);
                const Eigen::Vector3d joint(radius * std::cos(a), radius * std::sin(a), height);
                const Eigen::Vector3d from(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                                           begin + random.uniform(0.2, 0.8));
                const auto hit = pipe.first_hit({from, (joint - from).normalized()});
                ASSERT_TRUE(hit) << "from " << begin;
                EXPECT_NEAR(hit->range, (joint - from).norm(), 1e-9);
            }
        }
    }
}

TEST(surface_of_revolution, rejects_invalid_profiles) {
    const double nan = std::nan("");
    for (const std::vector<profile_point>& bad : {std::vector<profile_point>{},
                                                  {{1, 0}},
                                                  {{1, 0}, {1, 0}},
                                                  {{1, 1}, {1, 0}},
                                                  {{-1, 0}, {1, 1}},
                                                  {{nan, 0}, {1, 1}},
                                                  {{1, nan}, {1, 1}},
                                                  {{1, 0}, {1, INFINITY}}}) {
        EXPECT_THROW((void)surface_of_revolution(bad), std::invalid_argument);
    }
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/beams.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/detail/instrument.hpp>
#include <gnomon/simulation/ray.hpp>

namespace sim = gnomon::simulation;

namespace {

using beams::ahead, beams::readings, beams::step, beams::wall;
using sim::beam;
using sim::echo;
using sim::echo_rule;

beam wide(echo_rule rule, int sub_rays = 37) {
    return {.footprint = {.divergence = gnomon::radians(2 * std::atan(0.003)),
                          .sub_rays = sub_rays,
                          .rule = rule}};
}

/// What is left of a wide beam on one wall is the wall.
TEST(instrument, a_footprint_on_one_surface_hardly_changes_the_range) {
    for (const auto rule : {echo_rule::first, echo_rule::strongest, echo_rule::averaged}) {
        const auto r = readings(wall{3.0}, wide(rule), 1).front();
        EXPECT_EQ(r.kind, echo::surface);
        EXPECT_NEAR(r.range, 3.0, 3.0 * 0.003 * 0.003);
    }
}

/// Echoes that are farther apart than the pulse length: one of them is reported. Closer echoes: a
/// range between them is.
TEST(instrument, reports_an_echo_by_its_rule) {
    const step far_apart{.near = 3.0, .far = 5.0, .edge = 0.001};
    EXPECT_NEAR(readings(far_apart, wide(echo_rule::first), 1).front().range, 3.0, 1e-3);
    const auto mean = readings(far_apart, wide(echo_rule::averaged), 1).front();
    EXPECT_EQ(mean.kind, echo::mixed);
    EXPECT_GT(mean.range, 3.1);
    EXPECT_LT(mean.range, 4.9);
    const step mostly_far{.near = 3.0, .far = 3.7, .edge = 0.006};
    EXPECT_NEAR(readings(mostly_far, wide(echo_rule::strongest), 1).front().range, 3.7, 1e-3);
    EXPECT_NEAR(readings(mostly_far, wide(echo_rule::first), 1).front().range, 3.0, 1e-3);
    const step near_each_other{.near = 3.0, .far = 3.4};
    const auto between = readings(near_each_other, wide(echo_rule::first), 1).front();
    EXPECT_EQ(between.kind, echo::mixed);
    EXPECT_GT(between.range, 3.05);
    EXPECT_LT(between.range, 3.35);
}

/// r = (f a_1 r_1 + (1 - f) a_2 r_2) / (f a_1 + (1 - f) a_2), f = (1 + erf(sqrt(2) s / w)) / 2,
/// a = 1 / r^2, for an edge at s from the axis of the beam.
double mixed_range(const step& walls, double radius) {
    const double f = 0.5 * (1.0 + std::erf(-std::numbers::sqrt2 * walls.edge / radius));
    const double a = f / (walls.near * walls.near);
    const double b = (1.0 - f) / (walls.far * walls.far);
    return (a * walls.near + b * walls.far) / (a + b);
}

/// The largest error of the mixed range, a mean of n readings, over all places of the edge.
double worst_mixed_range(double depth, int sub_rays, std::size_t n) {
    double worst = 0.0;
    for (double edge = -0.0200001; edge <= 0.02; edge += 0.001) {
        const step walls{.near = 3.0, .far = 3.0 + depth, .edge = edge};
        double sum = 0.0;
        for (const auto& r : readings(walls, wide(echo_rule::averaged, sub_rays), n))
            sum += r.range;
        // The radius of the footprint is that at the near wall, where the edge is.
        const double error = std::abs(sum / static_cast<double>(n) - mixed_range(walls, 0.009));
        worst = std::max(worst, error);
    }
    return worst;
}

TEST(instrument, mixed_ranges_follow_the_closed_form) {
    EXPECT_LT(worst_mixed_range(0.4, 37, 2000), 1e-3);   // on average
    EXPECT_LT(worst_mixed_range(0.01, 37, 1), 1e-3);     // each single one
    EXPECT_LT(worst_mixed_range(0.4, 10'000, 1), 1e-3);  // with 10,000 sub-rays, too
}

TEST(instrument, sub_rays_converge) {
    double last = worst_mixed_range(0.4, 4, 1);
    for (const int n : {40, 400, 4000}) {
        const double error = worst_mixed_range(0.4, n, 1);
        EXPECT_LT(error, 0.5 * last);
        last = error;
    }
}

/// As the edge is swept across the beam, the readings that hold 1 to 99 % of either wall lie within
/// 2.33 w: Phi^-1(0.99) = 2.326 standard deviations of w / 2 to either side.
TEST(instrument, mixed_points_at_a_step_are_as_many_as_the_beam_is_wide) {
    const double radius = 0.009;
    const double spacing = 0.001;  // of beams, at the near wall
    const int lines = 60;
    gnomon::random_stream random(1);
    int mixed = 0;
    const beam b = wide(echo_rule::first, 200);
    for (int line = 0; line < lines; ++line) {
        const double phase = random.uniform(0.0, spacing);
        for (double edge = phase - 0.03; edge < 0.03; edge += spacing) {
            const step walls{.near = 3.0, .far = 3.4, .edge = edge};
            const double from_near = readings(walls, b, 1).front().range - 3.0;
            // Shares of the energy, not of the power that comes back.
            const double share = from_near / 0.4;
            const double energy = share * 3.4 * 3.4 / (share * 3.4 * 3.4 + (1 - share) * 9.0);
            mixed += energy > 0.01 && energy < 0.99;
        }
    }
    const double expected = 2.326 * radius / spacing;
    EXPECT_NEAR(static_cast<double>(mixed) / lines, expected, 0.1 * expected);
}

/// A floor below the ray, seen at a grazing angle.
struct slope {
    Eigen::Vector3d normal;  ///< towards the ray's origin
    double distance;

    std::optional<sim::ray_hit> operator()(const sim::ray& r) const {
        const double t = -(normal.dot(r.origin) + distance) / normal.dot(r.direction);
        if (!(t > 0.0 && t <= r.reach)) return std::nullopt;
        return sim::ray_hit{t, normal, 0};
    }
};

/// The truth of a wide beam is that of its axis, not of the rim that comes first.
TEST(instrument, true_range_is_along_the_axis) {
    for (const double degrees : {90.0, 30.0, 8.0}) {
        const double a = degrees * std::numbers::pi / 180.0;
        const slope floor{{-std::sin(a), 0, std::cos(a)}, 7.3 * std::sin(a)};
        for (const auto rule : {echo_rule::first, echo_rule::strongest, echo_rule::averaged}) {
            for (const auto& r : readings(floor, wide(rule), 50, 30.0)) {
                ASSERT_TRUE(r.hit);
                EXPECT_EQ(r.hit->range, floor(ahead)->range);
                // The reading is a mean by power over the ellipse, whose near end counts more.
                EXPECT_NEAR(r.range, r.hit->range, 0.003 * r.hit->range);
            }
        }
    }
}

/// Near an edge the true range is that of the surface that reflects most power, even where the beam
/// axis misses it.
TEST(instrument, true_range_is_that_of_the_strongest_surface) {
    const step mostly_near{.near = 3.0, .far = 3.4, .edge = -0.006};
    const step mostly_far{.near = 3.0, .far = 3.4, .edge = 0.006};
    const auto near = readings(mostly_near, wide(echo_rule::first), 1).front();
    EXPECT_EQ(near.kind, echo::mixed);
    EXPECT_EQ(near.hit->surface, 0);
    EXPECT_EQ(near.hit->range, 3.0);
    const auto far = readings(mostly_far, wide(echo_rule::first), 1).front();
    EXPECT_EQ(far.kind, echo::mixed);
    EXPECT_EQ(far.hit->surface, 1);
    EXPECT_EQ(far.hit->range, 3.4);
    // The axis misses the near wall by 1 mm, but the near echo is reported.
    const step beside{.near = 3.0, .far = 5.0, .edge = 0.001};
    for (const auto& r : readings(beside, wide(echo_rule::first), 20)) {
        EXPECT_EQ(r.kind, echo::surface);
        EXPECT_EQ(r.hit->surface, 0);
        EXPECT_NEAR(r.hit->range, 3.0, 1e-14);
    }
}

/// The sub-rays at range r, as the caster receives them: 1 - 1/e^2 of the energy lies within the
/// beam radius w(r) = sqrt(waist^2 + (r slope)^2).
TEST(instrument, footprint_has_the_beam_radius) {
    const beam b{.footprint = {.waist = 0.010,
                               .divergence = gnomon::radians(2 * std::atan(0.010)),
                               .sub_rays = 1000}};
    for (const double range : {0.2, 1.0, 5.0}) {
        std::vector<double> off_axis;
        const auto screen = [&](const sim::ray& r) -> std::optional<sim::ray_hit> {
            const Eigen::Vector3d p = r.point_at(range / r.direction.x());
            off_axis.push_back(std::hypot(p.y(), p.z()));
            return sim::ray_hit{range / r.direction.x(), {-1, 0, 0}, 0};
        };
        (void)readings(screen, b, 1);
        std::sort(off_axis.begin(), off_axis.end());
        const auto within =
            static_cast<std::size_t>((1.0 - std::exp(-2.0)) * static_cast<double>(off_axis.size()));
        EXPECT_NEAR(off_axis[within], b.footprint.radius(range), 0.01 * b.footprint.radius(range));
    }
}

}  // namespace

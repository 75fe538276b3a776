// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/detail/instrument.hpp>
#include <gnomon/simulation/ray.hpp>

namespace {

using gnomon::beam;
using gnomon::beam_footprint;
using gnomon::echo;
using gnomon::echo_rule;
using gnomon::detail::instrument;

/// A wall across the x axis.
struct wall {
    double range;
    double cosine = 1.0;  ///< of the incidence, as its normal says

    std::optional<gnomon::ray_hit> operator()(const gnomon::ray& r) const {
        const double t = (range - r.origin.x()) / r.direction.x();
        if (!(t > 0.0 && t <= r.reach)) return std::nullopt;
        return gnomon::ray_hit{t, {-cosine, std::sqrt(1 - cosine * cosine), 0}, 0};
    }
};

/// Two walls: the near one where y > edge.
struct step {
    double near;
    double far;
    double edge = 0.0;

    std::optional<gnomon::ray_hit> operator()(const gnomon::ray& r) const {
        const double t = (near - r.origin.x()) / r.direction.x();
        if (r.origin.y() + t * r.direction.y() > edge) return gnomon::ray_hit{t, {-1, 0, 0}, 0};
        return gnomon::ray_hit{(far - r.origin.x()) / r.direction.x(), {-1, 0, 0}, 1};
    }
};

const gnomon::ray ahead{{0, 0, 0}, {1, 0, 0}};

template <class C>
auto readings(const C& caster, const beam& b, std::size_t n, double max_range = 10.0) {
    const instrument<C> read(caster, b, 0.0, max_range);
    std::vector<typename instrument<C>::reading> all;
    for (std::size_t i = 0; i < n; ++i)
        all.push_back(read(ahead, gnomon::random_stream(b.seed, i)));
    return all;
}

double deviation(const auto& all, double truth) {
    double sum = 0.0;
    for (const auto& r : all) sum += (r.range - truth) * (r.range - truth);
    return std::sqrt(sum / static_cast<double>(all.size()));
}

TEST(instrument, tells_the_truth_by_default) {
    for (const auto& r : readings(wall{3.3}, {}, 100)) {
        EXPECT_EQ(r.range, 3.3);
        EXPECT_EQ(r.kind, echo::surface);
    }
}

TEST(instrument, scatters_by_sigma) {
    for (const double sigma : {0.005, 0.015, 0.030}) {
        EXPECT_NEAR(deviation(readings(wall{3.3}, {.sigma = sigma}, 100'000), 3.3), sigma,
                    0.02 * sigma);
    }
}

TEST(instrument, scatters_more_far_away_and_at_grazing_incidence) {
    const beam with_range{.sigma = 0.003, .sigma_per_meter = 0.002};
    EXPECT_NEAR(deviation(readings(wall{4.0}, with_range, 100'000), 4.0), std::hypot(0.003, 0.008),
                0.02 * 0.0085);
    // w = 4 mm; tan(incidence) = sqrt(3).
    const beam grazing{
        .sigma = 0.001,
        .grazing = 1.0,
        .footprint = {.divergence = gnomon::radians(2 * std::atan(0.001)), .sub_rays = 1}};
    const double expected = std::hypot(0.001, 0.5 * 0.004 * std::sqrt(3.0));
    EXPECT_NEAR(deviation(readings(wall{4.0, 0.5}, grazing, 100'000), 4.0), expected,
                0.02 * expected);
}

/// Fig. 2.13: the histogram of readings against the mixture, by chi-square with 40 bins and one
/// more for the maximum range. With twenty tests one falls below p = 0.01 now and then; none may
/// fall below 0.01 / 20 (76.09 with 40 degrees of freedom), nor the sum of ten below 0.01 (468.7
/// with 400).
TEST(instrument, readings_follow_the_mixture) {
    constexpr double max_range = 10.0;
    constexpr int n = 20'000;
    constexpr int bins = 40;
    for (const double truth : {2.0, 6.5}) {
        double sum = 0.0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const beam b{.sigma = 0.3, .clutter = 0.2, .failure = 0.1, .seed = seed};
            std::vector<double> count(bins + 1, 0.0);
            for (const auto& r : readings(wall{truth}, b, n, max_range)) {
                if (r.kind == echo::none) {
                    EXPECT_EQ(r.range, max_range);
                    ++count[bins];
                } else {
                    const auto cell = static_cast<std::size_t>(r.range / max_range * bins);
                    ++count[std::min<std::size_t>(cell, bins - 1)];
                }
            }
            const auto below = [&](double r) {
                const double gauss = 0.5 * std::erfc((truth - r) / (0.3 * std::numbers::sqrt2));
                return 0.2 * r / max_range + 0.7 * gauss;
            };
            double chi_square = std::pow(count[bins] - 0.1 * n, 2) / (0.1 * n);
            for (int k = 0; k < bins; ++k) {
                const double expected =
                    n * (below(max_range * (k + 1) / bins) - below(max_range * k / bins));
                chi_square += std::pow(count[static_cast<std::size_t>(k)] - expected, 2) / expected;
            }
            EXPECT_LT(chi_square, 76.09) << "seed " << seed << ", range " << truth;
            sum += chi_square;
        }
        EXPECT_LT(sum, 468.7) << "range " << truth;
    }
}

TEST(instrument, fails_where_nothing_is) {
    for (const auto& r : readings(wall{20.0}, {.sigma = 0.01}, 10)) {
        EXPECT_EQ(r.kind, echo::none);
        EXPECT_FALSE(r.hit);
    }
}

beam wide(echo_rule rule, int sub_rays = 37) {
    return {.footprint = {.divergence = gnomon::radians(2 * std::atan(0.003)),
                          .sub_rays = sub_rays,
                          .rule = rule}};
}

/// What is left of a wide beam on one wall is the wall.
TEST(instrument, a_footprint_on_one_surface_changes_next_to_nothing) {
    for (const auto rule : {echo_rule::first, echo_rule::strongest, echo_rule::averaged}) {
        const auto r = readings(wall{3.0}, wide(rule), 1).front();
        EXPECT_EQ(r.kind, echo::surface);
        EXPECT_NEAR(r.range, 3.0, 3.0 * 0.003 * 0.003);
    }
}

/// Echoes farther apart than the pulse is long: one of them is told. Nearer: one between.
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
    EXPECT_LT(worst_mixed_range(0.4, 10'000, 1), 1e-3);  // with so many sub-rays, too
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

    std::optional<gnomon::ray_hit> operator()(const gnomon::ray& r) const {
        const double t = -(normal.dot(r.origin) + distance) / normal.dot(r.direction);
        if (!(t > 0.0 && t <= r.reach)) return std::nullopt;
        return gnomon::ray_hit{t, normal, 0};
    }
};

/// The truth of a wide beam is that of its axis, not of the rim that comes first.
TEST(instrument, tells_the_truth_along_the_axis) {
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

/// Beside an edge: the truth is that of the wall which most power came from, though the axis may
/// pass by it.
TEST(instrument, tells_the_truth_of_the_strongest_surface) {
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
    // The axis passes 1 mm beside the near wall, but the near echo is told.
    const step beside{.near = 3.0, .far = 5.0, .edge = 0.001};
    for (const auto& r : readings(beside, wide(echo_rule::first), 20)) {
        EXPECT_EQ(r.kind, echo::surface);
        EXPECT_EQ(r.hit->surface, 0);
        EXPECT_NEAR(r.hit->range, 3.0, 1e-14);
    }
}

/// Where sub-rays are at a range, as the caster is asked: w(r) = sqrt(waist^2 + (r slope)^2), of
/// which 1 - 1/e^2 of the energy lies within.
TEST(instrument, footprint_is_as_wide_as_it_says) {
    const beam b{.footprint = {.waist = 0.010,
                               .divergence = gnomon::radians(2 * std::atan(0.010)),
                               .sub_rays = 1000}};
    for (const double range : {0.2, 1.0, 5.0}) {
        std::vector<double> off_axis;
        const auto screen = [&](const gnomon::ray& r) -> std::optional<gnomon::ray_hit> {
            const Eigen::Vector3d p = r.point_at(range / r.direction.x());
            off_axis.push_back(std::hypot(p.y(), p.z()));
            return gnomon::ray_hit{range / r.direction.x(), {-1, 0, 0}, 0};
        };
        (void)readings(screen, b, 1);
        std::sort(off_axis.begin(), off_axis.end());
        const auto within =
            static_cast<std::size_t>((1.0 - std::exp(-2.0)) * static_cast<double>(off_axis.size()));
        EXPECT_NEAR(off_axis[within], b.footprint.radius(range), 0.01 * b.footprint.radius(range));
    }
}

/// Noise does not carry a reading beyond what the scanner sees.
TEST(instrument, reports_no_range_that_the_scanner_cannot_see) {
    const wall w{2.0};
    const instrument<wall> read(w, {.sigma = 0.3}, 1.8, 2.1);
    int failed = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const auto r = read(ahead, gnomon::random_stream(1, i));
        if (r.kind == echo::none) {
            ++failed;
            continue;
        }
        EXPECT_GE(r.range, 1.8);
        EXPECT_LE(r.range, 2.1);
    }
    EXPECT_NEAR(failed, 2000 * 0.62, 100);  // Phi(-2/3) + 1 - Phi(1/3)
}

}  // namespace

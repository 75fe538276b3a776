// SPDX-License-Identifier: BSL-1.0
/// @file
/// The measurement model of a beam: converts rays to readings. A footprint is sampled by sub-rays
/// of equal energy; their echoes, sorted by range, give one reading by the echo rule.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/ray_caster.hpp>

namespace gnomon::simulation::detail {

/// Converts rays to readings. Calls are const and thread-safe.
template <ray_caster C>
class instrument {
  public:
    /// @throws std::invalid_argument  unless the beam is valid
    instrument(const C& caster, const beam& b, double min_range, double max_range)
        : caster_(caster), beam_(b), min_range_(min_range), max_range_(max_range) {
        beam_.require_valid();
        if (!beam_.footprint.is_line() && beam_.footprint.sub_rays > 1)
            offsets_ = footprint_offsets(beam_.footprint.sub_rays);
    }

    /// A reading and its ground truth, if a surface was hit.
    struct reading {
        echo kind;
        double range;  ///< reported [m]
        /// For `surface` and `mixed`: the hit on the surface that returned the most power, its
        /// range measured along the ray.
        std::optional<ray_hit> hit;
    };

    [[nodiscard]] reading operator()(ray r, random_stream& random) const {
        r.reach = max_range_;
        const double chance = random.uniform();
        if (chance < beam_.clutter)
            return {echo::clutter, random.uniform(0.0, max_range_), std::nullopt};
        const reading failed{echo::none, max_range_, std::nullopt};
        if (chance < beam_.clutter + beam_.failure) return failed;
        const auto seen = offsets_.empty() ? along_line(r) : over_footprint(r, random.uniform());
        if (!seen || !is_seen(seen->range)) return failed;

        const double sigma = sigma_at(*seen, r);
        const double range = sigma > 0.0 ? seen->range + sigma * random.gaussian() : seen->range;
        if (!is_seen(range)) return failed;
        return {seen->mixed ? echo::mixed : echo::surface, range, seen->hit};
    }

  private:
    /// An echo before noise.
    struct clean_echo {
        ray_hit hit;   ///< the ground truth, see `reading`
        double range;  ///< reported without noise [m]
        bool mixed = false;
    };

    /// The echo of one sub-ray.
    struct contribution {
        ray_hit hit;
        double power;
        std::size_t sub_ray;  ///< by distance from the axis
        double range_along;   ///< of the hit, projected onto the axis [m]
    };

    [[nodiscard]] bool is_seen(double range) const {
        return range > 0.0 && range >= min_range_ && range <= max_range_;
    }

    /// The offsets of n sub-rays of equal energy, in units of w: along a spiral of the golden
    /// angle, the radii being quantiles of the energy 1 - exp(-2 (rho/w)^2) within rho.
    [[nodiscard]] static std::vector<std::array<double, 2>> footprint_offsets(int n) {
        std::vector<std::array<double, 2>> offsets;
        const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
        for (int j = 0; j < n; ++j) {
            const double rho = std::sqrt(-0.5 * std::log(1.0 - (j + 0.5) / n));
            const double a = golden_angle * j;
            offsets.push_back({rho * std::cos(a), rho * std::sin(a)});
        }
        return offsets;
    }

    [[nodiscard]] double sigma_at(const clean_echo& seen, const ray& r) const {
        double variance = beam_.sigma * beam_.sigma;
        const double with_range = beam_.sigma_per_meter * seen.range;
        variance += with_range * with_range;
        if (beam_.grazing > 0.0) {
            const double cosine = std::max(1e-3, std::abs(seen.hit.normal.dot(r.direction)));
            const double tangent = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / cosine;
            const double s = 0.5 * beam_.grazing * beam_.footprint.radius(seen.range) * tangent;
            variance += s * s;
        }
        return std::sqrt(variance);
    }

    [[nodiscard]] std::optional<clean_echo> along_line(const ray& r) const {
        const auto hit = caster_(r);
        if (!hit) return std::nullopt;
        return clean_echo{*hit, hit->range};
    }

    /// The echo over all sub-rays. The power of a sub-ray is proportional to cos(incidence) /
    /// range^2.
    [[nodiscard]] std::optional<clean_echo> over_footprint(const ray& r, double turn) const {
        std::vector<contribution> all = contributions(r, turn);
        if (all.empty()) return std::nullopt;
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.hit.range < b.hit.range; });
        const std::span<contribution> echo = reported(all);

        double power = 0.0;
        double sum = 0.0;
        for (const contribution& c : echo) {
            power += c.power;
            sum += c.power * c.hit.range;
        }
        const double nearest = echo.front().hit.range - beam_.footprint.echo_separation;
        const double farthest = echo.back().hit.range + beam_.footprint.echo_separation;
        const bool mixed = is_mixed(echo);
        const contribution& strongest = strongest_of(echo);
        ray_hit truth = strongest.hit;
        truth.range = strongest.range_along;
        // If the axis meets the same surface, the truth is its hit.
        const auto axis = caster_(r);
        const bool is_same = axis && axis->surface == truth.surface && axis->range > nearest &&
                             axis->range < farthest;
        if (is_same) truth = *axis;
        return clean_echo{truth, power > 0.0 ? sum / power : truth.range, mixed};
    }

    /// The echoes of the sub-rays. Sub-rays are skew lines, rotated a quarter turn between the
    /// waist and the far field: they generate the hyperboloid w(r)^2 = waist^2 + (r slope)^2. The
    /// bundle is rotated by `turn` revolutions about the axis; random rotations make the estimate
    /// unbiased for few sub-rays.
    [[nodiscard]] std::vector<contribution> contributions(const ray& r, double turn) const {
        Eigen::Vector3d across(0.0, 0.0, 0.0);
        int least = 0;
        for (int a = 1; a < 3; ++a) {
            if (std::abs(r.direction[a]) < std::abs(r.direction[least])) least = a;
        }
        across[least] = 1.0;
        across = across - r.direction * r.direction[least];
        across = across * (1.0 / std::sqrt(across.dot(across)));
        const Eigen::Vector3d& u = r.direction;
        const Eigen::Vector3d up(u.y() * across.z() - u.z() * across.y(),
                                 u.z() * across.x() - u.x() * across.z(),
                                 u.x() * across.y() - u.y() * across.x());

        std::vector<contribution> all;
        all.reserve(offsets_.size());
        const angle turned = radians(2.0 * std::numbers::pi * turn);
        const double slope = std::tan(0.5 * beam_.footprint.divergence.radians());
        for (std::size_t j = 0; j < offsets_.size(); ++j) {
            const auto& [x, y] = offsets_[j];
            const double a = cos(turned) * x - sin(turned) * y;
            const double b = sin(turned) * x + cos(turned) * y;
            ray sub = r;
            sub.origin = r.origin + (up * a - across * b) * beam_.footprint.waist;
            sub.direction = r.direction + (across * a + up * b) * slope;
            sub.direction = sub.direction * (1.0 / std::sqrt(sub.direction.dot(sub.direction)));
            if (const auto hit = caster_(sub)) {
                const double cosine = std::abs(hit->normal.dot(sub.direction));
                const double along = r.direction.dot(sub.point_at(hit->range) - r.origin);
                all.push_back({*hit, cosine / (hit->range * hit->range), j, along});
            }
        }
        return all;
    }

    /// The contributions to the reported echo. They are given, and returned, in order of range.
    [[nodiscard]] std::span<contribution> reported(std::span<contribution> all) const {
        if (beam_.footprint.rule == echo_rule::averaged) return all;
        std::span<contribution> best;
        double best_power = -1.0;
        for (std::size_t first = 0; first < all.size();) {
            std::size_t last = first;
            double power = all[last].power;
            while (++last < all.size() && all[last].hit.range - all[last - 1].hit.range <
                                              beam_.footprint.echo_separation) {
                power += all[last].power;
            }
            if (power > best_power) {
                best = all.subspan(first, last - first);
                best_power = power;
            }
            if (beam_.footprint.rule == echo_rule::first) break;
            first = last;
        }
        return best;
    }

    /// The contribution nearest to the axis, of the surface with the most power. Reorders the echo.
    [[nodiscard]] static const contribution& strongest_of(std::span<contribution> echo) {
        const auto nearer = [](const contribution& a, const contribution& b) {
            return a.sub_ray < b.sub_ray;
        };
        if (!is_mixed(echo)) return *std::min_element(echo.begin(), echo.end(), nearer);
        std::sort(echo.begin(), echo.end(), [&](const contribution& a, const contribution& b) {
            return a.hit.surface != b.hit.surface ? a.hit.surface < b.hit.surface : nearer(a, b);
        });
        const contribution* strongest = &echo.front();
        double most = -1.0;
        for (std::size_t first = 0; first < echo.size();) {
            std::size_t last = first;
            double power = 0.0;
            for (; last < echo.size() && echo[last].hit.surface == echo[first].hit.surface; ++last)
                power += echo[last].power;
            if (power > most) {
                strongest = &echo[first];
                most = power;
            }
            first = last;
        }
        return *strongest;
    }

    [[nodiscard]] static bool is_mixed(std::span<const contribution> echo) {
        return std::any_of(echo.begin(), echo.end(), [&](const contribution& c) {
            return c.hit.surface != echo.front().hit.surface;
        });
    }

    const C& caster_;
    beam beam_;
    double min_range_;
    double max_range_;
    std::vector<std::array<double, 2>> offsets_;  // empty for a line
};

}  // namespace gnomon::simulation::detail

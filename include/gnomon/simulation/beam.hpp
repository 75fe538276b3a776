// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a range finder makes of the truth: readings that scatter, fail, or lie.
///
/// Klasing 2010, Sec. 2.4.3, Fig. 2.13: the reading is Gaussian about the true range, or clutter
/// anywhere before the maximum, or the maximum range. That simulated scans were cleaner than real
/// ones the thesis puts down to "skimmed points" (Sec. 5.8), which hang in the air behind edges: a
/// beam is not a line but as wide as a finger, and where it meets two surfaces at once the
/// instrument reports something between. Here the footprint is a Gaussian sampled by sub-rays of
/// equal energy; which of its echoes counts is up to the instrument.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/ray_caster.hpp>

namespace gnomon {

/// Which echo an instrument reports when its beam meets several surfaces.
enum class echo_rule : char {
    first,      ///< the nearest
    strongest,  ///< the one of most energy
    averaged    ///< the mean of all by energy, however far apart
};

/// The width of a beam: w(r) = sqrt(waist^2 + (r tan(half divergence))^2) is the radius at which
/// the intensity has fallen to 1/e^2. All zero, the default, is a line.
struct beam_footprint {
    double waist = 0.0;     ///< w at the sensor [m]
    angle divergence = {};  ///< full angle of the cone, far away
    int sub_rays = 37;      ///< that sample it, where it is no line
    echo_rule rule = echo_rule::first;
    /// Echoes nearer to each other than this are one to the instrument, half the length of its
    /// pulse [m]: 0.45 to 0.75 for pulses of 3 to 5 ns.
    double echo_separation = 0.6;

    /// w(r) [m].
    [[nodiscard]] double radius(double range) const {
        return std::hypot(waist, range * std::tan(0.5 * divergence.radians()));
    }
    [[nodiscard]] bool is_line() const { return waist == 0.0 && divergence == radians(0); }
};

/// How readings deviate from the truth. The default does not.
struct beam {
    double sigma = 0.0;  ///< standard deviation along the ray [m]
    double sigma_per_meter =
        0.0;  ///< grows with the range: adds (this times range)^2 to the variance
    /// Grazing beams scatter more: adds (this times w tan(incidence) / 2)^2 to the variance; 1 for
    /// what the geometry of the footprint says.
    double grazing = 0.0;
    double clutter = 0.0;  ///< probability of a reading anywhere between 0 and the maximum range
    double failure = 0.0;  ///< probability of no reading at all
    beam_footprint footprint = {};
    bool keep_failed = false;  ///< readings that failed are points at the maximum range
    std::uint64_t seed = 1;

    /// @throws std::invalid_argument  unless standard deviations and lengths are finite and not
    ///                                negative, probabilities add up to 1 at most, the divergence
    ///                                is less than 180 degrees, and there are 1 to 10,000 sub-rays
    void require_valid() const {
        using detail::require;
        for (const double x :
             {sigma, sigma_per_meter, grazing, footprint.waist, footprint.echo_separation}) {
            require(x >= 0.0 && x < 1e6, "beam: lengths and factors must be from 0 to 1e6");
        }
        require(clutter >= 0.0 && failure >= 0.0 && clutter + failure <= 1.0,
                "beam: clutter and failure must be probabilities that add up to 1 at most");
        require(footprint.divergence >= radians(0) && footprint.divergence < degrees(180),
                "beam: the divergence must be from 0 to less than 180 degrees");
        require(footprint.sub_rays >= 1 && footprint.sub_rays <= 10'000,
                "beam: there must be 1 to 10,000 sub-rays");
    }
};

/// What became of a reading.
enum class echo : std::uint8_t {
    surface,  ///< of one surface, with noise
    mixed,    ///< a mean over several surfaces: a skimmed point
    clutter,  ///< of nothing in particular
    none      ///< failed; stands at the maximum range
};

namespace detail {

/// What the beam of a ray sees before noise: the truth about its strongest contribution.
struct beam_echo {
    ray_hit hit;
    double range;  ///< that an instrument without noise would report [m]
    bool mixed = false;
};

/// Turns rays into readings. Const calls, thread-safe.
template <ray_caster C>
class instrument {
  public:
    instrument(const C& caster, const beam& b, double min_range, double max_range)
        : caster_(caster), beam_(b), min_range_(min_range), max_range_(max_range) {
        beam_.require_valid();
        if (!beam_.footprint.is_line() && beam_.footprint.sub_rays > 1)
            offsets_ = footprint_offsets(beam_.footprint.sub_rays);
    }

    /// A reading, and the truth behind it unless there is none.
    struct reading {
        echo kind;
        double range;                ///< reported [m]
        std::optional<ray_hit> hit;  ///< for `surface` and `mixed`
    };

    [[nodiscard]] reading operator()(ray r, random_stream random) const {
        r.reach = max_range_;
        const double chance = random.uniform();
        if (chance < beam_.clutter)
            return {echo::clutter, random.uniform(0.0, max_range_), std::nullopt};
        const reading failed{echo::none, max_range_, std::nullopt};
        if (chance < beam_.clutter + beam_.failure) return failed;
        const auto seen = offsets_.empty() ? along_line(r) : over_footprint(r, random.uniform());
        if (!seen || seen->range < min_range_) return failed;

        const double sigma = sigma_at(*seen, r);
        const double range = sigma > 0.0 ? seen->range + sigma * random.gaussian() : seen->range;
        if (!(range > 0.0)) return failed;
        return {seen->mixed ? echo::mixed : echo::surface, range, seen->hit};
    }

  private:
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

    [[nodiscard]] double sigma_at(const beam_echo& seen, const ray& r) const {
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

    [[nodiscard]] std::optional<beam_echo> along_line(const ray& r) const {
        const auto hit = caster_(r);
        if (!hit) return std::nullopt;
        return beam_echo{*hit, hit->range};
    }

    /// Sub-rays leave the waist towards their places in the far footprint. The power that comes
    /// back along one is proportional to cos(incidence) / range^2. The whole bundle is turned about
    /// the axis by a share of a full turn, at random: few sub-rays then are right on average.
    [[nodiscard]] std::optional<beam_echo> over_footprint(const ray& r, double turn) const {
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
        for (const auto& [x, y] : offsets_) {
            const Eigen::Vector3d offset = across * (cos(turned) * x - sin(turned) * y) +
                                           up * (sin(turned) * x + cos(turned) * y);
            ray sub = r;
            sub.origin = r.origin + offset * beam_.footprint.waist;
            sub.direction = r.direction + offset * slope;
            sub.direction = sub.direction * (1.0 / std::sqrt(sub.direction.dot(sub.direction)));
            if (const auto hit = caster_(sub)) {
                const double cosine = std::abs(hit->normal.dot(sub.direction));
                all.push_back({*hit, cosine / (hit->range * hit->range)});
            }
        }
        if (all.empty()) return std::nullopt;
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.hit.range < b.hit.range; });
        return mean_of(reported(all));
    }

    struct contribution {
        ray_hit hit;
        double power;
    };
    using span = std::pair<const contribution*, const contribution*>;

    /// The contributions, in order of range, that make up the echo reported.
    [[nodiscard]] span reported(const std::vector<contribution>& all) const {
        const contribution* const end = all.data() + all.size();
        if (beam_.footprint.rule == echo_rule::averaged) return {all.data(), end};
        span best{nullptr, nullptr};
        double best_power = -1.0;
        for (const contribution* first = all.data(); first != end;) {
            const contribution* last = first;
            double power = last->power;
            while (++last != end &&
                   last->hit.range - last[-1].hit.range < beam_.footprint.echo_separation) {
                power += last->power;
            }
            if (power > best_power) {
                best = {first, last};
                best_power = power;
            }
            if (beam_.footprint.rule == echo_rule::first) break;
            first = last;
        }
        return best;
    }

    /// The mean range by power, and the truth about the surface that most of it came from.
    [[nodiscard]] static beam_echo mean_of(span echo) {
        double power = 0.0;
        double sum = 0.0;
        const contribution* strongest = echo.first;
        double strongest_power = 0.0;
        bool mixed = false;
        for (const contribution* c = echo.first; c != echo.second; ++c) {
            power += c->power;
            sum += c->power * c->hit.range;
            mixed = mixed || c->hit.surface != echo.first->hit.surface;
        }
        for (const contribution* c = echo.first; mixed && c != echo.second; ++c) {
            double of_surface = 0.0;
            for (const contribution* d = echo.first; d != echo.second; ++d) {
                if (d->hit.surface == c->hit.surface) of_surface += d->power;
            }
            if (of_surface > strongest_power) {
                strongest = c;
                strongest_power = of_surface;
            }
        }
        const double range = power > 0.0 ? sum / power : strongest->hit.range;
        return {strongest->hit, range, mixed};
    }

    const C& caster_;
    beam beam_;
    double min_range_;
    double max_range_;
    std::vector<std::array<double, 2>> offsets_;  // none for a line
};

}  // namespace detail
}  // namespace gnomon

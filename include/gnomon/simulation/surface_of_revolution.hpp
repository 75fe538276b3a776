// SPDX-License-Identifier: BSL-1.0
/// @file
/// Surfaces of revolution: a profile rotated about the z axis, interpolated smoothly or piecewise
/// linearly.
///
/// The squared radius of the smooth profile is a monotonicity-preserving quadratic spline of the
/// height (Schumaker 1983, with the slopes of Butland 1980: the harmonic means of the adjacent
/// secants, at most twice the smaller one). Its pieces are quadrics, so that the intersection with
/// a ray has a closed form.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/simulation/detail/revolved_arc.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// A point of a profile.
struct profile_point {
    double radius;  ///< [m]
    double height;  ///< [m]
};

/// The interpolation of a profile, and which of its ends are closed.
struct revolution_options {
    bool smooth = true;  ///< else by straight lines
    bool bottom = true;  ///< a disc at the first point
    bool top = false;    ///< a disc at the last point
};

/// A profile rotated about the z axis. Surfaces: 0 the mantle, 1 the bottom, 2 the top.
class surface_of_revolution {
  public:
    /// @throws std::invalid_argument  unless there are two points or more, all finite, with radii
    ///                                that are not negative and heights that grow
    explicit surface_of_revolution(const std::vector<profile_point>& profile,
                                   const revolution_options& options = {}) {
        gnomon::detail::require(profile.size() >= 2,
                                "surface_of_revolution: needs two points or more");
        for (std::size_t i = 0; i < profile.size(); ++i) {
            gnomon::detail::require(profile[i].radius >= 0.0 && std::isfinite(profile[i].radius),
                                    "surface_of_revolution: radii must be finite and not negative");
            gnomon::detail::require(std::isfinite(profile[i].height) &&
                                        (i == 0 || profile[i].height > profile[i - 1].height),
                                    "surface_of_revolution: heights must be finite and grow");
            widest_ = std::max(widest_, profile[i].radius);
        }
        if (options.bottom) discs_.bottom = profile.front().radius * profile.front().radius;
        if (options.top) discs_.top = profile.back().radius * profile.back().radius;
        base_ = profile.front().height;
        if (options.smooth)
            join_smoothly(profile);
        else
            join_straight(profile);
    }

    [[nodiscard]] bounds extent() const {
        return {{-widest_, -widest_, base_ + arcs_.front().low},
                {widest_, widest_, base_ + arcs_.back().high}};
    }

    [[nodiscard]] static std::span<const std::string_view> surface_names() {
        static constexpr std::array<std::string_view, 3> names{"mantle", "bottom", "top"};
        return names;
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        ray from_base = r;
        from_base.origin.z() -= base_;
        return detail::first_hit_of(arcs_, discs_, from_base);
    }

  private:
    /// Appends an arc between the profile heights `from` and `to`: the squared radius begins with
    /// `value` and `slope` and ends with `last_slope`. Returns its last value.
    double append(double from, double to, double value, double slope, double last_slope) {
        const double low = from - base_;
        const double high = to - base_;
        // value + slope (z - low) + curvature (z - low)^2, written out in powers of z
        const double curvature = (last_slope - slope) / (2.0 * (high - low));
        arcs_.push_back({low, high, curvature, slope - 2.0 * curvature * low,
                         value + (curvature * low - slope) * low});
        return value + 0.5 * (slope + last_slope) * (high - low);
    }

    void join_straight(const std::vector<profile_point>& profile) {
        for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
            const auto [r, low] = profile[i];
            const auto [last_r, high] = profile[i + 1];
            const double rise = (last_r - r) / (high - low);
            append(low, high, r * r, 2.0 * r * rise, 2.0 * last_r * rise);
        }
    }

    void join_smoothly(const std::vector<profile_point>& profile) {
        const std::size_t n = profile.size();
        std::vector<double> secants;  // of the squared radius
        for (std::size_t i = 0; i + 1 < n; ++i) {
            const auto [r, low] = profile[i];
            const auto [last_r, high] = profile[i + 1];
            secants.push_back((last_r - r) * (last_r + r) / (high - low));
        }
        std::vector<double> slopes{secants.front()};
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const double d0 = secants[i - 1];
            const double d1 = secants[i];
            slopes.push_back(d0 * d1 > 0.0 ? 2.0 * d0 * d1 / (d0 + d1) : 0.0);
        }
        slopes.push_back(secants.back());

        for (std::size_t i = 0; i + 1 < n; ++i) {
            const auto [r, low] = profile[i];
            const double high = profile[i + 1].height;
            const double middle = 0.5 * (low + high);
            // The slope at the middle for which the second half ends at the next point.
            const double half_way = 2.0 * secants[i] - 0.5 * (slopes[i] + slopes[i + 1]);
            const double value = append(low, middle, r * r, slopes[i], half_way);
            append(middle, high, value, half_way, slopes[i + 1]);
        }
    }

    /// Height of the profile's first point. The arcs' heights are relative to it: polynomials in a
    /// height far from 0 would suffer cancellation.
    double base_ = 0.0;
    std::vector<detail::revolved_arc> arcs_;  // lowest first
    detail::end_discs discs_;
    double widest_ = 0.0;
};

}  // namespace gnomon::simulation

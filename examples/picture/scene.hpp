// SPDX-License-Identifier: BSL-1.0
/// @file
/// From where should one look? Two views that let a stranger understand a scan: as the sensor saw
/// it, and obliquely from above; for a sensor that stood in the middle, obliquely and from above.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "camera.hpp"
#include "splat.hpp"

namespace picture {

/// A camera, and what to write above its picture.
struct view {
    camera from;
    std::string caption;
    backs back = backs::shown;
};

/// The properties of a scan that the choice of a view depends on.
class scene {
  public:
    /// @param viewpoint  where the sensor stood [m]
    /// @param up         against gravity, if known
    scene(const std::vector<splat>& splats, const Eigen::Vector3d& viewpoint,
          const std::optional<Eigen::Vector3d>& up)
        : splats_(splats), viewpoint_(viewpoint) {
        std::vector<double> numbers(splats.size());
        const auto percentile_of = [&](double p, auto&& number) {
            std::transform(splats.begin(), splats.end(), numbers.begin(), number);
            return percentile(numbers, p);
        };
        for (int a = 0; a < 3; ++a) {
            middle_[a] = percentile_of(0.5, [a](const splat& s) { return s.position[a]; });
        }
        size_ = percentile_of(
            0.95, [this](const splat& s) { return (s.position - middle_).stableNorm(); });
        size_ = std::max(size_, 1e-3 + 1e-9 * middle_.stableNorm());

        forward_ = middle_ - viewpoint;
        const double distance = forward_.stableNorm();
        forward_ = distance > 1e-9 ? Eigen::Vector3d(forward_ / distance)
                                   : Eigen::Vector3d(Eigen::Vector3d::UnitX());
        // Outside, if nearly all points lie in a cone of half angle 50 degrees before the sensor.
        const double edge = percentile_of(0.05, [this](const splat& s) {
            return forward_.dot((s.position - viewpoint_).stableNormalized());
        });
        sensor_is_outside_ = distance > 1e-3 * size_ && edge > 0.64;
        up_ = up ? *up : likely_up();
    }

    /// The two views.
    [[nodiscard]] std::array<view, 2> views() const {
        if (sensor_is_outside_) {
            return {{{looking(viewpoint_, forward_, up_), "as the sensor sees it"},
                     {from_outside(35.0, clearer_side(30.0)), "from the side"}}};
        }
        return {{{from_outside(45.0, 30.0), "from outside, near walls left out", backs::hidden},
                 {from_outside(89.0, 0.0), "from above, ceiling left out", backs::hidden}}};
    }

  private:
    /// Up is z for robots, -y for cameras that look along z, y for those that look along -z. Floors
    /// and table tops, whose normals face the sensor, know better.
    [[nodiscard]] Eigen::Vector3d likely_up() const {
        const bool along_z = sensor_is_outside_ && std::abs(forward_.z()) > 0.7;
        const bool down = along_z && forward_.z() < 0.0;
        const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
        const Eigen::Vector3d y = (down ? 1.0 : -1.0) * Eigen::Vector3d::UnitY();
        const auto level_z = largest_flat_segment(z, 20.0);
        if (!along_z || (down && level_z)) return level_z.value_or(z);
        return largest_flat_segment(y, 55.0).value_or(y);
    }

    /// The normal of the largest flat segment whose normal is within some degrees of `direction`,
    /// if that holds a twentieth of all points.
    [[nodiscard]] std::optional<Eigen::Vector3d> largest_flat_segment(
        const Eigen::Vector3d& direction, double degrees) const {
        std::vector<Eigen::Vector3d> sums;
        std::vector<double> counts;
        for (const splat& s : splats_) {
            if (s.label < 0) continue;
            const auto label = static_cast<std::size_t>(s.label);
            if (label >= sums.size()) {
                sums.resize(label + 1, Eigen::Vector3d::Zero());
                counts.resize(label + 1, 0.0);
            }
            sums[label] += s.normal;
            ++counts[label];
        }
        double most = 0.05 * static_cast<double>(splats_.size());
        std::optional<Eigen::Vector3d> found;
        for (std::size_t label = 0; label < sums.size(); ++label) {
            const double length = sums[label].norm();
            const bool flat = length > 0.95 * counts[label];
            const bool alike = sums[label].dot(direction) > std::cos(degrees * degree) * length;
            if (flat && alike && counts[label] > most) {
                most = counts[label];
                found = sums[label] / length;
            }
        }
        return found;
    }

    /// Looks at the middle from `elevation` above the horizon, turned by `azimuth` [deg] from where
    /// the sensor stands.
    [[nodiscard]] camera from_outside(double elevation, double azimuth) const {
        const Eigen::Vector3d ahead = across(up_, horizontal());
        const Eigen::Vector3d level = Eigen::AngleAxisd(azimuth * degree, up_) * ahead;
        const Eigen::Vector3d forward =
            std::cos(elevation * degree) * level - std::sin(elevation * degree) * up_;
        return looking(middle_ - 4.0 * size_ * forward, forward, up_);
    }

    /// The azimuth or its opposite, whichever shows more of the surfaces from the front.
    [[nodiscard]] double clearer_side(double azimuth) const {
        double gain = 0.0;
        for (const double side : {1.0, -1.0}) {
            const Eigen::Vector3d forward = from_outside(35.0, side * azimuth).axes.row(2);
            for (const splat& s : splats_) gain -= side * std::max(0.0, -s.normal.dot(forward));
        }
        return gain > 0.0 ? -azimuth : azimuth;
    }

    /// Where the sensor looked; if it stood in the middle or above, across the longer side.
    [[nodiscard]] Eigen::Vector3d horizontal() const {
        if (sensor_is_outside_ && std::abs(forward_.dot(up_)) < 0.9) return forward_;
        const Eigen::Vector3d e = up_.unitOrthogonal();
        const Eigen::Vector3d f = up_.cross(e);
        double sin2 = 0.0;
        double cos2 = 0.0;
        for (const splat& s : splats_) {  // the mean direction of all, doubled: axes have no sign
            const Eigen::Vector3d d = (s.position - middle_) / size_;
            if (!(d.squaredNorm() < 9.0)) continue;
            cos2 += d.dot(e) * d.dot(e) - d.dot(f) * d.dot(f);
            sin2 += 2.0 * d.dot(e) * d.dot(f);
        }
        const double angle = 0.5 * std::atan2(sin2, cos2) + 0.5 * std::numbers::pi;
        return std::cos(angle) * e + std::sin(angle) * f;
    }

    static constexpr double degree = std::numbers::pi / 180.0;  // [rad]

    const std::vector<splat>& splats_;
    Eigen::Vector3d viewpoint_;
    Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
    double size_ = 0.0;
    Eigen::Vector3d forward_;
    bool sensor_is_outside_ = true;
    Eigen::Vector3d up_;
};

}  // namespace picture

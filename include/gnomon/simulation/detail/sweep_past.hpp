// SPDX-License-Identifier: BSL-1.0
/// @file
/// The part of a vertical scan whose lines can meet a scene. A line lies in the plane through the
/// y axis of the mount at its pitch, so that the pitches of the corners of a box bound those of the
/// lines that meet it. Around a single object this leaves out most lines.
#pragma once

#include <algorithm>
#include <numbers>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace gnomon::simulation::detail {

/// The pitches of points in a box that are before the mount, widened by twice the radius of the
/// beam; all pitches if a corner is not in front.
[[nodiscard]] inline std::pair<double, double> pitches_of(const bounds& box, const pose& mount,
                                                          const beam_footprint& width) {
    double lowest = std::numbers::pi;
    double highest = -std::numbers::pi;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d p = mount.point_in({corner & 1 ? box.high.x() : box.low.x(),
                                                  corner & 2 ? box.high.y() : box.low.y(),
                                                  corner & 4 ? box.high.z() : box.low.z()});
        if (!(p.x() > 0.0)) return {-std::numbers::pi, std::numbers::pi};
        const double range = std::sqrt(p.dot(p));
        const double across = 2.0 * width.radius(range);
        if (!(p.x() > across)) return {-std::numbers::pi, std::numbers::pi};
        // Of a beam that meets the corner, the axis is at most `across` from it.
        lowest = std::min(lowest, std::atan2(-p.z() - across, p.x() + across));
        lowest = std::min(lowest, std::atan2(-p.z() - across, p.x() - across));
        highest = std::max(highest, std::atan2(-p.z() + across, p.x() + across));
        highest = std::max(highest, std::atan2(-p.z() + across, p.x() - across));
    }
    return {lowest, highest};
}

/// The lines of a scan that can meet a box, as a trajectory of its own, to the last
/// bit; all lines if rays that meet
/// nothing give points as well, or if the duration is one that simulate() refuses.
[[nodiscard]] inline auto sweep_past(const bounds& box, const vertical& scan, const scanner& finder,
                                     const beam& b) {
    const double duration = scan.duration;
    const double sweep = scan.sweep.radians();
    const double rate = finder.frequency;
    double first = 0.0;  // line
    double left_out = 0.0;
    const bool only_hits = b.clutter == 0.0 && !b.keep_failed;
    if (only_hits && duration > 0.0 && sweep > 0.0 && rate > 0.0) {
        const auto [lowest, highest] = pitches_of(box, scan.mount, b.footprint);
        // Inverse of swept(), and a line more at either end for rounding.
        const auto line_at = [&](double pitch) {
            return std::clamp(pitch / sweep + 0.5, 0.0, 1.0) * duration * rate;
        };
        first = std::max(0.0, std::floor(line_at(lowest)) - 1.0);
        const double end = std::min(duration * rate, std::ceil(line_at(highest)) + 1.0);
        left_out = duration * rate - (end - first);
    }
    // The lines at the very times of the whole scan.
    return along(duration - left_out / rate, [scan, first, rate](double seconds) {
        return scan((first + std::round(seconds * rate - 0.5) + 0.5) / rate);
    });
}

}  // namespace gnomon::simulation::detail

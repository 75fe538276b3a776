// SPDX-License-Identifier: BSL-1.0
/// @file
/// Points that span a set: two that differ, three that are not collinear, four that are not
/// coplanar, as far as the set has them. They are far from each other, so that the hull of the four
/// holds many points; whether a set is degenerate is decided exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/detail/orientation.hpp>

namespace gnomon::detail {

struct hull_simplex {
    std::array<std::uint32_t, 4> corners{};
    std::size_t count = 0;  ///< of the corners: the dimension of the set and one
    int dropped = 2;        ///< the coordinate without which the first three are not collinear

    /// O(n) for n points with coordinates up to 1 in magnitude. Of equal points the first is taken.
    explicit hull_simplex(std::span<const Eigen::Vector3d> points) : points_(points) {
        if (points.empty()) return;
        for (std::uint32_t i = 1; i < points.size(); ++i)
            if (precedes(points[i], points[corners[0]])) corners[0] = i;
        count = 1;
        const Eigen::Vector3d& a = points[corners[0]];
        extend(
            [&](const Eigen::Vector3d& p) { return squared_length(difference(p, a)); },
            [&](const Eigen::Vector3d& p) { return p[0] != a[0] || p[1] != a[1] || p[2] != a[2]; });
        if (count < 2) return;
        const Eigen::Vector3d& b = points[corners[1]];
        const Eigen::Vector3d ab = difference(b, a);
        extend(
            [&](const Eigen::Vector3d& p) { return squared_length(cross(ab, difference(p, a))); },
            [&](const Eigen::Vector3d& p) { return leaves_line(a, b, p); });
        if (count < 3) return;
        const Eigen::Vector3d& c = points[corners[2]];
        const Eigen::Vector3d normal = cross(ab, difference(c, a));
        extend([&](const Eigen::Vector3d& p) { return std::abs(dot(normal, difference(p, a))); },
               [&](const Eigen::Vector3d& p) { return signed_volume(a, b, c, p) != 0.0; });
    }

    /// The lexicographic order of positions.
    [[nodiscard]] static bool precedes(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
        if (p[0] != q[0]) return p[0] < q[0];
        return p[1] != q[1] ? p[1] < q[1] : p[2] < q[2];
    }

  private:
    [[nodiscard]] static double squared_length(const Eigen::Vector3d& v) { return dot(v, v); }

    /// Whether p is not on the line through a and b; notes the coordinate that is not needed.
    bool leaves_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p) {
        for (dropped = 2; dropped >= 0; --dropped) {
            const int x = dropped == 0 ? 1 : 0;
            const int y = dropped == 2 ? 1 : 2;
            if (signed_area(a[x], a[y], b[x], b[y], p[x], p[y]) != 0.0) return true;
        }
        return false;
    }

    /// Adds the point of largest measure, if it is independent of the corners, or else the first
    /// that is.
    template <class Measure, class Independent>
    void extend(const Measure& measure, const Independent& is_independent) {
        std::uint32_t best = corners[0];
        double largest = 0.0;
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            const double m = measure(points_[i]);
            if (m > largest) {
                largest = m;
                best = i;
            }
        }
        for (std::uint32_t i = 0; i < points_.size() && !is_independent(points_[best]); ++i)
            best = i;
        if (is_independent(points_[best])) corners[count++] = best;
    }

    std::span<const Eigen::Vector3d> points_;
};

}  // namespace gnomon::detail

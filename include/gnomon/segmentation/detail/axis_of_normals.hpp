// SPDX-License-Identifier: BSL-1.0
/// @file
/// The axis of a surface of revolution: the line that its normals meet. Lines that meet one are a
/// linear complex, so that the axis is an eigenvector (Pottmann and Randrup 1998, Rotational and
/// helical surface approximation for reverse engineering).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>

namespace gnomon::detail {

/// The line through `place` [m] along a normal of either sign. Places are relative to some point
/// among them.
struct normal_line {
    Eigen::Vector3d place, normal;
};

/// The axis that some lines meet best, in the least-squares sense.
class axis_of_normals {
  public:
    /// Precondition: there are lines, and all of them are finite. O(n).
    explicit axis_of_normals(std::span<const normal_line> lines) {
        const double each = 1.0 / static_cast<double>(lines.size());
        Eigen::Vector3d mean(0.0, 0.0, 0.0);
        for (const normal_line& l : lines) mean = combined(1.0, mean, each, l.place);
        Eigen::Matrix3d nn = diagonal(0.0, 0.0, 0.0), nx = nn, xx = nn;
        double squared_size = 0.0;
        for (const normal_line& l : lines) {
            const Eigen::Vector3d p = difference(l.place, mean), x = cross(p, l.normal);
            add_outer(nn, each, l.normal, l.normal);
            add_outer(nx, each, l.normal, x);
            add_outer(xx, each, x, x);
            squared_size += each * dot(p, p);
        }
        // The moment of a line about the axis (a, m) is a . x + m . n: for a given a, the best m
        // leaves a^T rest a of its square. A cylinder leaves open where along its axis m begins:
        // by a slight pull, at the mean. A ball leaves the axis undetermined; for its visible
        // half, the viewing direction is slightly better: normals pull the axis across them.
        constexpr double pull = 0.01, turn = 0.1;
        Eigen::Matrix3d pulled = nn;
        for (int i = 0; i < 3; ++i) pulled(i, i) += pull;
        const Eigen::Matrix3d inverse = inverse_of_symmetric(pulled);
        Eigen::Matrix3d rest;
        for (int j = 0; j < 3; ++j) {
            const Eigen::Vector3d solved = product(inverse, column(nx, j));
            for (int i = 0; i < 3; ++i)
                rest(i, j) = xx(i, j) - dot(column(nx, i), solved) + turn * squared_size * nn(i, j);
        }
        direction_ = column(symmetric_eigen(rest).vectors, 2);
        const Eigen::Vector3d moment = scaled(-1.0, product(inverse, product(nx, direction_)));
        through_ = combined(1.0, mean, 1.0, cross(direction_, moment));
        measure(lines);
    }

    /// By how much a line passes the axis, as seen along it, times the part of the normal across
    /// it [m].
    [[nodiscard]] double missed_by(const normal_line& l) const {
        return std::abs(dot(cross(direction_, difference(l.place, through_)), l.normal));
    }
    /// The square of the part of a normal across the axis, 0 to 1.
    [[nodiscard]] double across(const normal_line& l) const {
        const double along = dot(direction_, l.normal);
        return 1.0 - along * along;
    }
    /// The root mean square of what lines miss the axis by [m].
    [[nodiscard]] double rms() const { return rms_; }
    /// The mean distance of the places [m].
    [[nodiscard]] double radius() const { return radius_; }
    /// The mean square of the parts of normals across the axis, 0 to 1.
    [[nodiscard]] double across() const { return across_; }
    /// And of these the one way that it is less: 0 for a plane, 1/2 all round a cylinder.
    [[nodiscard]] double turning() const { return turning_; }

  private:
    void measure(std::span<const normal_line> lines) {
        const double each = 1.0 / static_cast<double>(lines.size());
        Eigen::Matrix3d spread = diagonal(0.0, 0.0, 0.0);
        double squares = 0.0;
        for (const normal_line& l : lines) {
            const Eigen::Vector3d across =
                combined(1.0, l.normal, -dot(direction_, l.normal), direction_);
            add_outer(spread, each, across, across);
            squares += each * missed_by(l) * missed_by(l);
            radius_ += each * length(cross(direction_, difference(l.place, through_)));
        }
        rms_ = std::sqrt(squares);
        const Eigen::Vector3d values = symmetric_eigen(spread).values;
        across_ = values[0] + values[1];
        turning_ = values[1];
    }

    Eigen::Vector3d direction_, through_;
    double rms_ = 0.0, radius_ = 0.0, across_ = 0.0, turning_ = 0.0;
};

/// The axis of the lines that miss it by at most 2.5 times the root mean square, or by a fifth of
/// the radius.
/// @param lines  a span of `normal_line`: the others are removed from it, and their content is
/// unspecified
[[nodiscard]] axis_of_normals robust_axis_of(auto& lines) {
    constexpr double at_most = 2.5, near = 0.2;  // times the root mean square, times the radius
    constexpr int passes = 5;
    axis_of_normals axis(lines);
    for (int pass = 0; pass < passes; ++pass) {
        const double limit = std::max(at_most * axis.rms(), near * axis.radius());
        const auto missing = std::remove_if(lines.begin(), lines.end(), [&](const normal_line& l) {
            return !(axis.missed_by(l) <= limit);
        });
        if (missing == lines.end()) break;
        lines = lines.first(static_cast<std::size_t>(missing - lines.begin()));
        axis = axis_of_normals(lines);
    }
    return axis;
}

}  // namespace gnomon::detail

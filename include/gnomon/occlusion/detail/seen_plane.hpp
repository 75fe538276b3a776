// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane of a segment, as ranges tell of it. Noise lies along the rays, not across the surface:
/// so planes are found by regression of the depth along a ray on the place across it. Of what is
/// narrower than noise, or seen at a grazing angle, the direction of least spread is that of
/// nothing; the regression still knows how little it knows.
///
/// The rays to one segment count as parallel: those of a segment too wide for that tell so much
/// that it does not matter.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// A direction of sight and two axes across it, all of unit length.
struct sight_axes {
    Eigen::Vector3d along, x, y;

    /// Towards d, of any length but zero.
    explicit sight_axes(const Eigen::Vector3d& d)
        : along(direction_of(d)), x(orthogonal(along)), y(cross(along, x)) {}
};

/// Two coordinates across a sight.
using place_across = std::array<double, 2>;

/// A symmetric matrix over them.
struct matrix_across {
    double xx, xy, yy;

    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
    /// The inverse, times v.
    [[nodiscard]] place_across solved(const place_across& v) const {
        return {(yy * v[0] - xy * v[1]) / determinant(), (xx * v[1] - xy * v[0]) / determinant()};
    }
    [[nodiscard]] place_across operator*(const place_across& v) const {
        return {xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]};
    }
    [[nodiscard]] double largest_eigenvalue() const {
        return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
    }
    [[nodiscard]] matrix_across inverse() const {
        return {yy / determinant(), -xy / determinant(), xx / determinant()};
    }
    friend matrix_across operator+(const matrix_across& a, const matrix_across& b) {
        return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
    }
    friend matrix_across operator*(double s, const matrix_across& a) {
        return {s * a.xx, s * a.xy, s * a.yy};
    }
};

[[nodiscard]] inline double dot(const place_across& a, const place_across& b) {
    return a[0] * b[0] + a[1] * b[1];
}

/// Points of one plane.
struct plane_sample {
    std::size_t count = 0;
    Eigen::Vector3d mean{0.0, 0.0, 0.0};                   ///< [m]
    Eigen::Matrix3d covariance = diagonal(0.0, 0.0, 0.0);  ///< [m^2]
    Eigen::Vector3d viewpoint{0.0, 0.0, 0.0};              ///< the mean of theirs [m]
};

/// The sight of a sample; of one about its own view point, that across its plane.
[[nodiscard]] inline sight_axes axes_towards(const plane_sample& sample) {
    const Eigen::Vector3d d = difference(sample.mean, sample.viewpoint);
    const double size = length(d);
    return sight_axes(size > 0.0 && std::isfinite(size)
                          ? d
                          : column(symmetric_eigen(sample.covariance).vectors, 2));
}

/// depth = slope . place + constant, through the mean of a sample.
struct depth_regression {
    place_across slope;
    matrix_across spread;  ///< covariance of the places [m^2]

    depth_regression(const plane_sample& sample, const sight_axes& axes) {
        const Eigen::Vector3d x = product(sample.covariance, axes.x);
        const Eigen::Vector3d y = product(sample.covariance, axes.y);
        // No place is known better than this: that of a single ray, or row of rays, neither.
        constexpr double exact = 1e-9;  // [m^2]
        spread = {dot(axes.x, x) + exact, dot(axes.x, y), dot(axes.y, y) + exact};
        slope = spread.solved({dot(axes.along, x), dot(axes.along, y)});
    }

    /// Times a way from the mean, how much deeper than the plane that ends. Not of unit length.
    [[nodiscard]] Eigen::Vector3d normal(const sight_axes& axes) const {
        return combined(1.0, axes.along, -slope[0], axes.x, -slope[1], axes.y);
    }

    /// How well the slope is known by `count` points: the inverse of its covariance.
    [[nodiscard]] matrix_across information(std::size_t count, double sigma) const {
        return (static_cast<double>(count) / (sigma * sigma)) * spread;
    }
};

/// What a sample tells of its plane by itself.
struct plane_knowledge {
    double squared_width;    ///< variance of the places across the sight, the way it is wider [m^2]
    angle uncertainty;       ///< of the direction of the plane, three standard deviations
    Eigen::Vector3d normal;  ///< towards the view point, not of unit length
};

/// @param sigma  the standard deviation of ranges [m]
[[nodiscard]] inline plane_knowledge knowledge_of(const plane_sample& sample, double sigma) {
    const sight_axes axes = axes_towards(sample);
    const depth_regression plane(sample, axes);
    const matrix_across of_slope = plane.information(sample.count, sigma).inverse();
    return {plane.spread.largest_eigenvalue(),
            radians(std::atan(3.0 * std::sqrt(of_slope.largest_eigenvalue()))),
            scaled(-1.0, plane.normal(axes))};
}

/// Tells of an offset [m] from `origin` whether the point there is on the plane of a sample, as far
/// as noise lets it be.
[[nodiscard]] inline auto is_on_plane_of(const plane_sample& sample, double sigma,
                                         const Eigen::Vector3d& origin) {
    constexpr double at_most = 2.5;  // standard deviations of a range
    const sight_axes axes = axes_towards(sample);
    const Eigen::Vector3d deeper = depth_regression(sample, axes).normal(axes);
    return [deeper, at_mean = dot(deeper, difference(sample.mean, origin)),
            depth = at_most * sigma](const Eigen::Vector3d& offset) {
        return std::abs(dot(deeper, offset) - at_mean) <= depth;
    };
}

/// Those of some points that are on the plane of a sample of them.
/// @param points   a position_view of the cloud
/// @param members  indices of points of it
/// Complexity: O(n).
[[nodiscard]] std::vector<point_index> points_on_plane(const auto& points,
                                                       std::span<const point_index> members,
                                                       const plane_sample& sample, double sigma) {
    const auto is_on_plane = is_on_plane_of(sample, sigma, sample.mean);
    std::vector<point_index> on;
    for (const point_index i : members)
        if (is_on_plane(difference(points[i], sample.mean))) on.push_back(i);
    return on;
}

/// The points of a segment that are of its plane. What adjoins it may have lent it some of its own
/// at the edges: what is off the plane is left out, again and again, unless that is most of what
/// was left. Of none if no point is finite.
/// @param points   a position_view of the cloud
/// @param members  indices of the points of the segment
/// Complexity: O(n).
[[nodiscard]] plane_sample plane_sample_of(const auto& points, std::span<const point_index> members,
                                           const viewpoint_table& viewpoints, double sigma) {
    plane_sample sample;
    moments seen_from;
    for (const point_index i : members)
        if (is_finite(viewpoints[i])) seen_from.add(viewpoints[i]);
    if (seen_from.count > 0)
        sample.viewpoint = scaled(1.0 / static_cast<double>(seen_from.count), seen_from.sum);
    const auto first = std::find_if(members.begin(), members.end(),
                                    [&](point_index i) { return is_finite(points[i]); });
    if (first == members.end()) return sample;
    const Eigen::Vector3d origin = points[*first];
    std::vector<Eigen::Vector3d> offsets;
    offsets.reserve(members.size());
    moments all;
    for (const point_index i : members) {
        const Eigen::Vector3d p = points[i];
        if (!is_finite(p)) continue;
        offsets.push_back(difference(p, origin));
        all.add(offsets.back());
    }
    const auto take = [&](const moments& m) {
        sample.count = m.count;
        sample.mean = combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
        sample.covariance = m.covariance_of_neighbors();
    };
    take(all);
    for (int pass = 0; pass < 4; ++pass) {
        const auto is_on_plane = is_on_plane_of(sample, sigma, origin);
        moments on = all;  // less what is off, which is little
        for (const Eigen::Vector3d& d : offsets)
            if (!is_on_plane(d)) on.remove(d);
        if (2 * on.count >= sample.count) take(on);
    }
    return sample;
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane of a segment from its ranges. The noise is along the rays, not across the surface: the
/// plane is the regression of the depth along a mean ray on the position across it. For segments
/// narrower than the noise, or seen at a grazing angle, the direction of least variance is
/// meaningless; the regression has a large covariance there.
///
/// The rays to one segment are taken as parallel. Segments too wide for that have enough points
/// that the error does not matter.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>

namespace gnomon::detail {

/// A viewing direction and two axes across it, all of unit length.
struct sight_axes {
    Eigen::Vector3d along, x, y;

    /// Towards d, of any length but zero.
    explicit sight_axes(const Eigen::Vector3d& d)
        : along(direction_of(d)), x(orthogonal(along)), y(cross(along, x)) {}
};

/// Two coordinates across a viewing direction.
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

/// The viewing direction of a sample; for a sample around its own view point, the normal of its
/// plane.
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
    double squared_width;    ///< larger variance of the positions across the direction [m^2]
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

/// The indices of the points that are on the plane of a sample of them. O(n).
/// @param positions  of the points [m]
/// @param members    their indices
[[nodiscard]] inline scratch<point_index> points_on_plane(
    std::span<const Eigen::Vector3d> positions, std::span<const point_index> members,
    const plane_sample& sample, double sigma) {
    const auto is_on_plane = is_on_plane_of(sample, sigma, sample.mean);
    scratch<point_index> on;
    on.reserve(members.size());
    for (std::size_t k = 0; k < members.size(); ++k)
        if (is_on_plane(difference(positions[k], sample.mean))) on.push_back(members[k]);
    return on;
}

/// The mean of the known view points of some points [m]; the origin if none is known.
[[nodiscard]] inline Eigen::Vector3d mean_viewpoint(std::span<const point_index> members,
                                                    const viewpoint_table& viewpoints) {
    Eigen::Vector3d sum(0.0, 0.0, 0.0);
    std::size_t count = 0;
    for (const point_index i : members) {
        const Eigen::Vector3d v = viewpoints[i];
        if (!is_finite(v)) continue;
        sum = combined(1.0, sum, 1.0, v);
        ++count;
    }
    return count > 0 ? scaled(1.0 / static_cast<double>(count), sum) : sum;
}

/// The points of a segment that are on its plane. The segment may contain points of adjacent
/// surfaces at its edges: points off the plane are removed repeatedly, unless they are more than
/// half of the points that were left. Of no points if none is finite. O(n).
/// @param positions  of the points of the segment [m]
/// @param all        of these
/// @param viewpoint  the mean of their view points [m]
[[nodiscard]] inline plane_sample plane_sample_of(std::span<const Eigen::Vector3d> positions,
                                                  const moments_about_first& all,
                                                  const Eigen::Vector3d& viewpoint, double sigma) {
    plane_sample sample;
    sample.viewpoint = viewpoint;
    if (all.of_points.count == 0) return sample;
    const Eigen::Vector3d origin = all.origin;
    const auto take = [&](const moments& m) {
        sample.count = m.count;
        sample.mean = combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
        sample.covariance = m.covariance_of_neighbors();
    };
    take(all.of_points);
    for (int pass = 0; pass < 4; ++pass) {
        const auto is_on_plane = is_on_plane_of(sample, sigma, origin);
        moments on = all.of_points;  // less the points off the plane, which are few
        for (const Eigen::Vector3d& p : positions) {
            const Eigen::Vector3d offset = difference(p, origin);
            if (!is_on_plane(offset) && is_finite(p)) on.remove(offset);
        }
        if (2 * on.count >= sample.count) take(on);
    }
    return sample;
}

}  // namespace gnomon::detail

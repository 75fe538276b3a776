// SPDX-License-Identifier: BSL-1.0
/// @file
/// Position, orientation and size of a segment: centroid, principal axes, variances along them, and
/// the bounding box aligned with them.
///
/// Klasing 2010, Sec. 3.5.1; Sec. 4.5 and Fig. 4.14 for the boxes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/spectrum.hpp>

namespace gnomon {

/// The principal axes of a point set as a right-handed frame, and the bounding box in it. The signs
/// of the axes are arbitrary but deterministic.
struct principal_frame {
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};  ///< mean of the points [m]
    Eigen::Matrix3d axes =
        detail::diagonal(1.0, 1.0, 1.0);        ///< unit columns, by descending variance
    gnomon::spectrum spectrum;                  ///< variances along the axes [m^2]
    Eigen::Vector3d box_center{0.0, 0.0, 0.0};  ///< center of the box [m]
    Eigen::Vector3d box_size{0.0, 0.0, 0.0};    ///< edge lengths along the axes [m]

    /// The axis of smallest variance, a unit vector of arbitrary sign: the normal of a planar
    /// segment.
    [[nodiscard]] Eigen::Vector3d normal() const { return detail::column(axes, 2); }

    /// The box by itself.
    [[nodiscard]] oriented_box box() const { return {box_center, axes, box_size}; }

    /// The principal frame of the finite points of a range, by the eigenvectors of their
    /// covariance.
    /// @param points      any point range of n points [m]
    /// @param projection  maps an element of the range to a point
    /// @return the frame; with all members at their defaults if no point is finite
    /// @throws std::invalid_argument  if n is 2^32 - 1 or more
    /// Complexity: O(n). Source: Klasing 2010, Sec. 3.5.1.
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] static principal_frame of(const R& points, Proj projection = {});
};

namespace detail {

/// The moments of the finite points about the first of them, which keeps their digits far from the
/// origin.
struct moments_about_first {
    moments of_points;                      ///< [m], [m^2]
    Eigen::Vector3d origin{0.0, 0.0, 0.0};  ///< the first finite point [m]

    /// @param p  a position_view, or anything with size() and positions by index
    template <class Points>
    explicit moments_about_first(const Points& p) {
        std::size_t first = 0;
        while (first < p.size() && !is_finite(p[first])) ++first;
        if (first == p.size()) return;
        origin = p[first];
        for (std::size_t i = first; i < p.size(); ++i) {
            if (is_finite(p[i])) of_points.add(difference(p[i], origin));
        }
    }
};

/// Centroid, axes and spectrum of points; the box is the centroid. With all members at their
/// defaults if no point is finite.
[[nodiscard]] inline principal_frame principal_axes_of(const moments_about_first& m) {
    principal_frame frame;
    if (m.of_points.count == 0) return frame;
    const eigen_decomposition e = symmetric_eigen(m.of_points.covariance_of_neighbors());
    frame.centroid =
        combined(1.0, m.origin, 1.0 / static_cast<double>(m.of_points.count), m.of_points.sum);
    frame.box_center = frame.centroid;
    frame.axes = e.vectors;
    const Eigen::Vector3d second = cross(column(e.vectors, 2), column(e.vectors, 0));
    for (int i = 0; i < 3; ++i) frame.axes(i, 1) = second[i];  // right-handed
    frame.spectrum = spectrum(e.values);
    return frame;
}

}  // namespace detail

template <class R, class Proj>
    requires point_range<R, Proj>
principal_frame principal_frame::of(const R& points, Proj projection) {
    const position_view<R, Proj> p(points, std::move(projection));
    principal_frame frame = detail::principal_axes_of(detail::moments_about_first(p));
    std::size_t first = 0;
    while (first < p.size() && !is_finite(p[first])) ++first;
    if (first == p.size()) return frame;
    constexpr double inf = std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
        const Eigen::Vector3d axis = detail::column(frame.axes, a);
        double low = inf;
        double high = -inf;
        for (std::size_t i = first; i < p.size(); ++i) {
            if (!is_finite(p[i])) continue;
            const double along = detail::dot(axis, detail::difference(p[i], frame.centroid));
            low = std::min(low, along);
            high = std::max(high, along);
        }
        frame.box_size[a] = high - low;
        frame.box_center = detail::combined(1.0, frame.box_center, 0.5 * (low + high), axis);
    }
    return frame;
}

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where a segment lies, how it is turned and how large it is: centroid, principal axes, spectrum
/// and the object-oriented bounding box in their frame.
///
/// Klasing 2010, Sec. 3.5.1 (and Sec. 4.5, Fig. 4.14 for the boxes).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/spectrum.hpp>
#include <gnomon/core/symmetric_eigen.hpp>

namespace gnomon {

/// A right-handed frame along the principal axes of a point set, and the box that fits it there.
struct principal_frame {
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};                 ///< mean of the points [m]
    Eigen::Matrix3d axes = detail::diagonal(1.0, 1.0, 1.0);  ///< columns: largest spread first
    gnomon::spectrum spectrum;                               ///< variances along the axes [m^2]
    Eigen::Vector3d box_center{0.0, 0.0, 0.0};               ///< [m]
    Eigen::Vector3d box_size{0.0, 0.0, 0.0};                 ///< edge lengths along the axes [m]

    /// The direction of least spread: of a flat segment, its normal (sign arbitrary).
    [[nodiscard]] Eigen::Vector3d normal() const { return detail::column(axes, 2); }
};

/// The principal frame of all finite points of a range; at the origin and of size zero if there are
/// none. O(n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] principal_frame principal_frame_of(const R& points, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    // Moments about one of the points, so that nothing is lost far from the origin.
    std::size_t first = 0;
    while (first < p.size() && !is_finite(p[first])) ++first;
    principal_frame frame;
    if (first == p.size()) return frame;
    const Eigen::Vector3d origin = p[first];
    moments m;
    for (std::size_t i = first; i < p.size(); ++i) {
        if (is_finite(p[i])) m.add(detail::difference(p[i], origin));
    }
    const eigen_decomposition e = symmetric_eigen(m.covariance_of_neighbors());
    frame.centroid = detail::combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
    frame.box_center = frame.centroid;
    frame.axes = e.vectors;
    const Eigen::Vector3d second =  // right-handed
        detail::cross(detail::column(e.vectors, 2), detail::column(e.vectors, 0));
    for (int i = 0; i < 3; ++i) frame.axes(i, 1) = second[i];
    frame.spectrum = spectrum(e.values);

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

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The features of a segment that follow from its moments and from the normals of its points, as
/// one value (Klasing 2010, Sec. 3.5.1). In no umbrella: include it by name.
///
///     const auto shape = gnomon::segment_shape::of(scan, surface, parts[s]);
///     if (shape.is_surface()) use(shape.frame.centroid, shape.normal, shape.surface_variation());
///     const auto shapes = gnomon::segment_shapes(scan, surface, parts, gnomon::threads{});
///
/// The mean surface variation of the points of a segment is not that of the segment: on a cylinder
/// the first is near zero, as every neighborhood is nearly flat, and the second is large.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/principal_frame.hpp>

namespace gnomon {

/// Position, orientation and shape of a segment. All members are at their defaults if no point is
/// finite.
struct segment_shape {
    /// How far the points are spread: by more than the rounding of their coordinates.
    enum class extent : std::uint8_t {
        none,   ///< no point is finite
        point,  ///< all are at one place
        line,   ///< they are collinear: there is no normal
        plane,  ///< they are coplanar
        volume
    };

    extent spread = extent::none;  ///< dimension of the set of points
    std::size_t points = 0;        ///< that are finite
    principal_frame frame;         ///< centroid, principal axes, variances along them, and box
    /// The axis of smallest variance, towards the view points; where none is known on the side of
    /// the mean normal. The zero vector without a surface.
    Eigen::Vector3d normal{0.0, 0.0, 0.0};
    /// The direction of the sum of the normals of the points, each towards its view point, or as it
    /// is where that is not known. The zero vector if there are none, or if the sum is zero.
    Eigen::Vector3d mean_normal{0.0, 0.0, 0.0};
    /// Of the points with a normal; zero if there are none, or if the surface has no spectra.
    double mean_surface_variation = 0.0;

    /// Whether the points determine a normal, at least as well as rounding does.
    [[nodiscard]] bool is_surface() const { return spread >= extent::plane; }
    /// The surface variation of all points, Eq. (3.28): 0 for a plane, 1 for a ball.
    [[nodiscard]] double surface_variation() const { return frame.spectrum.surface_variation(); }
    /// The aspect ratio of all points, Eq. (3.19).
    [[nodiscard]] double aspect_ratio() const { return frame.spectrum.aspect_ratio(); }

    /// The shape of a segment.
    /// @param points      any point range of n points [m], or the `spatial_index` of them
    /// @param surface     n surface elements with normals, such as the result of
    ///                    `estimate_normals`; their mean surface variation is known if they have a
    ///                    member surface_variation(). Normals that are missing or not finite are
    ///                    left out, their points are not.
    /// @param members     the indices of the points of the segment
    /// @param projection  maps an element of the range to a point
    /// @throws std::invalid_argument  if points, surface or view points differ in number, or an
    ///                                index is not below n
    /// Complexity: O(members). The signs of the axes of the frame are arbitrary but deterministic.
    template <class R, normal_range Surface, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] static segment_shape of(const R& points, const Surface& surface,
                                          std::span<const point_index> members,
                                          Proj projection = {});
};

namespace detail {

/// The number of dimensions in which points with a spectrum are spread, as the extent of a segment.
/// @param rounding  of the coordinates [m]
[[nodiscard]] inline segment_shape::extent extent_of(const spectrum& s, double rounding) {
    constexpr double flat = 1e-14;  // numerical: rounding errors of eigenvalues
    const double least = std::max(flat * s.lambda[0], rounding * rounding);
    int dimensions = 0;
    while (dimensions < 3 && s.lambda[dimensions] > least) ++dimensions;
    return static_cast<segment_shape::extent>(dimensions + 1);
}

/// The sums over the points of a segment from which its signs and means follow.
struct oriented_sums {
    Eigen::Vector3d towards{0.0, 0.0, 0.0};  ///< view points, where they are known
    Eigen::Vector3d normals{0.0, 0.0, 0.0};
    double variations = 0.0;
    std::size_t with_normal = 0;

    /// @param element  of the surface
    /// @param way      unit vector to the view point, zero where that is not known
    void add(const auto& element, const Eigen::Vector3d& way) {
        towards = combined(1.0, towards, 1.0, way);
        const Eigen::Vector3d n = element.normal;
        if (is_missing(n) || !all_finite(n)) return;
        normals = combined(1.0, normals, dot(n, way) < 0.0 ? -1.0 : 1.0, n);
        ++with_normal;
        if constexpr (requires {
                          { element.surface_variation() } -> std::convertible_to<double>;
                      })
            variations += element.surface_variation();
    }
};

}  // namespace detail

template <class R, normal_range Surface, class Proj>
    requires point_range<R, Proj>
segment_shape segment_shape::of(const R& points, const Surface& surface,
                                std::span<const point_index> members, Proj projection) {
    detail::require(std::ranges::size(surface) == std::ranges::size(points),
                    "segment_shape: points and normals differ in number");
    const subset_view<R, Proj> chosen(points, members, std::move(projection));
    segment_shape shape;
    shape.frame = principal_frame::of(chosen);
    detail::oriented_sums sums;
    double largest = 0.0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const Eigen::Vector3d x = chosen[i];
        if (!is_finite(x)) continue;
        ++shape.points;
        for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(x[a]));
        Eigen::Vector3d way(0.0, 0.0, 0.0);
        if (!chosen.viewpoints.empty()) way = detail::difference(chosen.viewpoints[i], x);
        const bool is_known = detail::all_finite(way) && detail::has_length(way);
        sums.add(surface[members[i]],
                 is_known ? detail::direction_of(way) : Eigen::Vector3d(0.0, 0.0, 0.0));
    }
    if (shape.points == 0) return shape;
    constexpr double operations = 4.0;  // numerical: that rounded a coordinate
    shape.spread = detail::extent_of(shape.frame.spectrum, operations * chosen.epsilon() * largest);
    if (detail::has_length(sums.normals)) shape.mean_normal = detail::direction_of(sums.normals);
    if (sums.with_normal > 0)
        shape.mean_surface_variation = sums.variations / static_cast<double>(sums.with_normal);
    if (!shape.is_surface()) return shape;
    const Eigen::Vector3d n = shape.frame.normal();
    const double seen = detail::dot(n, sums.towards);
    const bool is_away = seen != 0.0 ? seen < 0.0 : detail::dot(n, sums.normals) < 0.0;
    shape.normal = detail::scaled(is_away ? -1.0 : 1.0, n);
    return shape;
}

/// The shapes of all segments, in their order.
/// @param parts  groups of indices of points, such as `segments`: parts.size() and parts[s]
/// @param run    `sequential{}` or `threads{n}`; the result does not depend on it
/// The other parameters and errors are those of `segment_shape::of`. Complexity: O(n).
template <class R, normal_range Surface, class Parts, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj> && requires(const Parts& parts, std::size_t s) {
        { parts.size() } -> std::convertible_to<std::size_t>;
        { parts[s] } -> std::convertible_to<std::span<const point_index>>;
    }
[[nodiscard]] std::vector<segment_shape> segment_shapes(const R& points, const Surface& surface,
                                                        const Parts& parts, const X& run = {},
                                                        Proj projection = {}) {
    std::vector<segment_shape> shapes(parts.size());
    run(parts.size(), [&](std::size_t s) {
        shapes[s] = segment_shape::of(points, surface, parts[s], projection);
    });
    return shapes;
}

}  // namespace gnomon

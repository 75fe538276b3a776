// SPDX-License-Identifier: BSL-1.0
/// @file
/// Alg. 4.1 with normals: the first step from groups of points to surfaces, by one of two measures
/// of dissimilarity with a fixed radius. Steps are separated by distance, corners by angle; smooth
/// surfaces stay whole.
///
/// Klasing 2010, Sec. 4.2.4 and Fig. 4.2.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/link_within.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// A measure of dissimilarity of oriented points: `radius` bounds the distance of points that can
/// be alike, and criterion(), which is called once and may refuse its parameters, gives what
/// decides of (squared distance, n_i, n_j). Must be symmetric. Models: `two_thresholds`,
/// `joint_distance`.
template <class D>
concept oriented_dissimilarity = requires(const D& d, const Eigen::Vector3d& n) {
    { d.radius } -> std::convertible_to<double>;
    { d.criterion()(double{}, n, n) } -> std::same_as<bool>;
};

/// rho_e <= r and rho_a <= alpha_max, rho_a = acos |<n_i, n_j>|.
struct two_thresholds {
    double radius;                 ///< r [m]: a few times the distance between neighbors
    angle max_angle = degrees(5);  ///< alpha_max, Sec. 4.4.1

    /// @throws std::invalid_argument  for an angle outside [0, 90] degrees
    [[nodiscard]] auto criterion() const {
        const double cosine = detail::min_cosine(max_angle);
        return [cosine](double, const Eigen::Vector3d& n_i, const Eigen::Vector3d& n_j) {
            return std::abs(detail::dot(n_i, n_j)) >= cosine;
        };
    }
};

/// The Euclidean distance of the six features [p n] is at most r. Mixes metres with unit vectors,
/// as the thesis points out; needs oriented normals.
struct joint_distance {
    double radius = 0.14;  ///< r, of no unit, Sec. 4.2.4

    /// Whether two points are in one segment, by their squared distance and normals.
    [[nodiscard]] auto criterion() const {
        const double limit = radius * radius;
        return [limit](double squared_distance, const Eigen::Vector3d& n_i,
                       const Eigen::Vector3d& n_j) {
            return squared_distance + gnomon::squared_distance(n_i, n_j) <= limit;
        };
    }
};

/// What remains to choose, with the values of Fig. 4.2.
struct segment_oriented_points_options {
    std::size_t min_points = 40;  ///< n_min, Sec. 4.2.4; smaller groups are noise
    /// As in `euclidean_clusters_options`. Twice as fast at best, where many points are within the
    /// radius.
    bool greedy = false;
};

/// The groups that chains of similar oriented points connect.
///
/// @param surface  a normal for each point; missing ones join nothing
/// @return the segments of at least `min_points` points, largest first
/// @throws std::invalid_argument  if surface and points differ in size, for a radius that is
///                                negative, infinite or NaN, or an angle outside [0, 90] degrees
/// Complexity: O(n (log n + k_r)) for k_r points within the radius; greedy as well.
template <class R, normal_range Surface, oriented_dissimilarity D, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments segment_oriented_points(const R& points, const Surface& surface,
                                               const D& dissimilarity,
                                               const segment_oriented_points_options& options = {},
                                               const X& run = {}, Proj projection = {}) {
    detail::require(dissimilarity.radius >= 0.0 && std::isfinite(dissimilarity.radius),
                    "segment_oriented_points: the radius must be finite and not negative");
    detail::require(std::ranges::size(surface) == position_view<R, Proj>(points, projection).size(),
                    "segment_oriented_points: surface and points differ in size");
    const auto alike = dissimilarity.criterion();
    const auto radius_of = [&](std::size_t i) {
        return is_missing(surface[i].normal) ? detail::no_search : double{dissimilarity.radius};
    };
    const auto similar = [&](std::size_t i, const neighbor& q) {
        const Eigen::Vector3d& n_j = surface[q.index].normal;
        return !is_missing(n_j) && alike(q.squared_distance, surface[i].normal, n_j);
    };
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    detail::linker linker(index);
    if (options.greedy) {
        linker.link_greedily(radius_of, similar);
    } else {
        linker.link_all(radius_of, similar, team);
    }
    return detail::segments_of(linker.labels(options.min_points));
}

}  // namespace gnomon

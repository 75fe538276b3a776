// SPDX-License-Identifier: BSL-1.0
/// @file
/// Finds floor and ceiling, levels the scan, and removes both: they are often more than half of an
/// indoor scan and connect all objects on them. Klasing 2010, Sec. 4.2.2, which leaves the widths
/// of the bands open; the floor is refitted to its band until it converges, so that tilts are
/// found.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/segmentation/detail/height_histogram.hpp>

namespace gnomon {

/// What counts as the floor.
struct find_floor_options {
    double band = 0.1;  ///< half the height [m] of the band about the plane
};

/// Where to look for the ceiling, in heights above the floor.
struct find_ceiling_options {
    double min_height = 1.8;  ///< [m]
    double bin = 0.02;        ///< of the histogram of heights [m]
    double min_share = 0.01;  ///< of all points that the ceiling's bin must hold to be one
};

/// Which heights above the floor to leave out.
struct crop_height_options {
    double floor = 0.05;    ///< up to this height [m]
    double ceiling = 0.05;  ///< down to this far below the ceiling [m]
};

/// A rigid motion after which the floor is the plane z = 0.
struct leveling {
    Eigen::Matrix3d rotation = detail::diagonal(1.0, 1.0, 1.0);
    double lift = 0.0;  ///< added to z after the rotation [m]

    [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& p) const {
        Eigen::Vector3d q(0.0, 0.0, lift);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) q[i] += rotation(i, j) * p[j];
        return q;
    }

    /// Turns the floor's normal to z by the smallest rotation and lays the floor into z = 0.
    [[nodiscard]] static leveling of(const plane& floor);
};

namespace detail {

/// @throws std::invalid_argument  unless the plane is in Hesse normal form
inline void require_hesse(const plane& p) {
    require(std::abs(dot(p.normal, p.normal) - 1.0) < 1e-6 && std::isfinite(p.offset),
            "the normal of a plane, or the direction upwards, must be of unit length");
}

inline void require_valid(const find_floor_options& search) {
    require(search.band > 0.0, "find_floor: the band must be positive");
}

inline void require_valid(const find_ceiling_options& search) {
    require(search.bin > 0.0, "find_ceiling: the bin must be positive");
    require(search.min_share >= 0.0, "find_ceiling: min_share must not be negative or NaN");
}

}  // namespace detail

/// A first guess for scans whose floor is not at z = 0: the lowest height at which a good part of
/// the points lies (a quarter of those at the most frequent height, in bins of 10 cm).
///
/// @param up  unit vector against gravity
/// @return nothing without finite points
/// @throws std::invalid_argument  unless `up` is of unit length
/// Complexity: O(n log n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::optional<plane> guess_floor(const R& points,
                                               const Eigen::Vector3d& up = {0.0, 0.0, 1.0},
                                               Proj projection = {}) {
    detail::require_hesse({up, 0.0});
    const position_view<R, Proj> p(points, std::move(projection));
    const detail::height_histogram histogram(p, plane{up, 0.0}, 0.1);
    if (histogram.bins().empty()) return std::nullopt;
    const std::size_t most = detail::fullest(histogram).count;
    const auto lowest = std::find_if(histogram.bins().begin(), histogram.bins().end(),
                                     [most](const auto& bin) { return 4 * bin.count >= most; });
    return plane{up, lowest->height};
}

/// The floor: the plane through the points in a band about itself.
///
/// @param guess  z = 0 as in the thesis, or what guess_floor says; within about 3 degrees
/// @return the plane, its normal on the side of the guess's; nothing where the points of the
///         band do not determine one
/// @throws std::invalid_argument  unless the band is positive and the guess's normal of unit length
/// Complexity: O(n) per refit, a handful of them, at most 50.
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::optional<plane> find_floor(const R& points, const plane& guess = {},
                                              const find_floor_options& search = {},
                                              Proj projection = {}) {
    detail::require_valid(search);
    detail::require_hesse(guess);
    const position_view<R, Proj> p(points, std::move(projection));
    plane floor = guess;
    double band = search.band;
    detail::scratch<double> distances;
    for (int refit = 0; refit < 50; ++refit) {
        // Moments about a point of the band, so that nothing is lost far from the origin.
        std::optional<Eigen::Vector3d> origin;
        moments m;
        distances.clear();
        for (std::size_t i = 0; i < p.size(); ++i) {
            if (!is_finite(p[i])) continue;
            const double d = std::abs(floor.signed_distance(p[i]));
            if (!(d <= band)) continue;
            if (!origin) origin = p[i];
            m.add(p[i] - *origin);
            distances.push_back(d);
        }
        if (m.count < 3) return std::nullopt;
        const detail::eigen_decomposition e = detail::symmetric_eigen(m.covariance_of_neighbors());
        if (e.values[1] <= 1e-12 * e.values[0]) return std::nullopt;

        plane next{detail::column(e.vectors, 2), 0.0};
        if (detail::dot(next.normal, floor.normal) < 0.0)
            next.normal = detail::scaled(-1.0, next.normal);
        Eigen::Vector3d centroid = *origin;
        for (int a = 0; a < 3; ++a) centroid[a] += m.sum[a] / static_cast<double>(m.count);
        next.offset = detail::dot(next.normal, centroid);

        // Feet of furniture and walls stand in the band: narrow it to three robust standard
        // deviations of the points of the floor (1.4826 times the median for a normal
        // distribution).
        const auto median = distances.begin() + static_cast<std::ptrdiff_t>(m.count / 2);
        std::nth_element(distances.begin(), median, distances.end());
        const double narrower = std::clamp(3.0 * 1.4826 * *median, 0.1 * search.band, search.band);

        const bool rests = detail::length(detail::difference(next.normal, floor.normal)) < 1e-9 &&
                           std::abs(floor.signed_distance(centroid)) < 1e-8 &&
                           std::abs(narrower - band) < 1e-9;
        floor = next;
        band = narrower;
        if (rests) break;
    }
    return floor;
}

/// The height of the ceiling above the floor [m]: the most frequent one above `min_height`.
///
/// @return nothing if no height holds `min_share` of the points (an open sky, a low view)
/// @throws std::invalid_argument  unless the bin is positive, the share is not negative, and the
///                                floor's normal of unit length
/// Complexity: O(n log n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::optional<double> find_ceiling(const R& points, const plane& floor,
                                                 const find_ceiling_options& search = {},
                                                 Proj projection = {}) {
    detail::require_valid(search);
    detail::require_hesse(floor);
    const position_view<R, Proj> p(points, std::move(projection));
    const detail::height_histogram histogram(p, floor, search.bin, search.min_height);
    if (histogram.bins().empty()) return std::nullopt;
    const auto [peak, count] = detail::fullest(histogram);
    if (static_cast<double>(count) < search.min_share * static_cast<double>(histogram.points())) {
        return std::nullopt;
    }
    // The mean over the peak and its neighbors is finer than the bin and free of its phase.
    double sum = 0.0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!is_finite(p[i])) continue;
        const double height = floor.signed_distance(p[i]);
        if (std::abs(height - peak) > 1.5 * search.bin) continue;
        sum += height;
        ++near;
    }
    if (near == 0) return std::nullopt;
    return sum / static_cast<double>(near);
}

inline leveling leveling::of(const plane& floor) {
    const Eigen::Vector3d& n = floor.normal;
    leveling level;
    level.lift = -floor.offset;
    // 1 + n_z, without cancellation where the scan is nearly upside down.
    const double across = n.x() * n.x() + n.y() * n.y();
    const double h = n.z() >= 0.0 ? 1.0 + n.z() : across / (1.0 - n.z());
    if (h > 0.0) {
        // Rodrigues' formula for the rotation about n x z, row by row. (Not by Eigen's commas,
        // which take compilers long.)
        const double rows[3][3] = {{1.0 - n.x() * n.x() / h, -n.x() * n.y() / h, -n.x()},
                                   {-n.x() * n.y() / h, 1.0 - n.y() * n.y() / h, -n.y()},
                                   {n.x(), n.y(), n.z()}};
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) level.rotation(i, j) = rows[i][j];
        }
    } else {
        // Upside down: half a turn about x.
        level.rotation(1, 1) = -1.0;
        level.rotation(2, 2) = -1.0;
    }
    return level;
}

namespace detail {

/// crop_height(), over a position_view and in the memory of `kept`.
void crop_height_into(std::vector<point_index>& kept, const auto& p, const plane& floor,
                      std::optional<double> ceiling, const crop_height_options& bands) {
    require_hesse(floor);
    kept.clear();
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!is_finite(p[i])) continue;
        const double height = floor.signed_distance(p[i]);
        if (height > bands.floor && !(ceiling && height >= *ceiling - bands.ceiling))
            kept.push_back(static_cast<point_index>(i));
    }
}

}  // namespace detail

/// The indices of the points between the bands of floor and ceiling, ascending; see subset_view.
/// Points that are not finite are left out.
///
/// @param ceiling  its height above the floor [m], or nothing to keep all that is above the floor
/// @throws std::invalid_argument  unless the floor's normal is of unit length
/// Complexity: O(n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> crop_height(const R& points, const plane& floor,
                                                   std::optional<double> ceiling,
                                                   const crop_height_options& bands = {},
                                                   Proj projection = {}) {
    std::vector<point_index> kept;
    detail::crop_height_into(kept, position_view<R, Proj>(points, std::move(projection)), floor,
                             ceiling, bands);
    return kept;
}

}  // namespace gnomon

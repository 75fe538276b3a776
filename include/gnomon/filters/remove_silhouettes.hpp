// SPDX-License-Identifier: BSL-1.0
/// @file
/// Removes the points at silhouettes that wide beams return wrongly: next to an edge, where a part
/// of the beam still hits the surface, which makes the leg of a chair seem wider; and between two
/// surfaces, at a mean of their ranges (mixed pixels; skimmed points in Klasing 2010, Sec. 5.8.4).
/// What is left of each surface is about as wide as the surface truly is.
///
///     auto kept = gnomon::remove_silhouettes(scan, {.divergence = gnomon::radians(0.010)});
///     gnomon::scan seen = gnomon::subset(scan, kept);
///
/// Neighbors of a point are here the points whose rays are next to its own, at whatever range: no
/// raster is needed, only view points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/filters/detail/flagged.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// What a silhouette is, and how much of a surface next to it is lost.
struct silhouette_options {
    angle divergence = radians(0.010);  ///< full angle of the beams; that of wide laser beams
    /// Neighboring rays whose ranges differ by more [m] have hit two surfaces; chosen on
    /// simulation::furniture_models(), seeds 1 to 3.
    double max_jump = 0.30;

    /// @throws std::invalid_argument  unless divergence is from 0 to 90 degrees and max_jump >= 0
    void require_valid() const {
        detail::require(divergence >= degrees(0.0) && divergence <= degrees(90.0),
                        "remove_silhouettes: the divergence must be from 0 to 90 degrees");
        detail::require(max_jump >= 0.0,
                        "remove_silhouettes: max_jump must not be negative or NaN");
    }
};

namespace detail {

/// The rays of a scan as points at 1 m from their view points, where near ones are seen side by
/// side. Distances [m] there are about angles [rad].
class ray_sphere {
  public:
    template <class R, execution X, class Proj>
    ray_sphere(const R& points, double max_jump, const X& run, Proj projection)
        : max_jump_(max_jump) {
        const position_view<R, Proj> position(points, projection);
        const std::size_t n = position.size();
        std::vector<Eigen::Vector3d> ends(n);
        rays_.resize(n);
        ranges_.resize(n);
        with_table_of(points, [&](const viewpoint_table& from) {
            const Eigen::Vector3d origin = n > 0 ? from[0] : Eigen::Vector3d(0.0, 0.0, 0.0);
            for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    const Eigen::Vector3d ray = difference(position[i], from[i]);
                    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
                    ranges_[i] = length(ray);
                    rays_[i] = scaled(has_length(ray) ? 1.0 / ranges_[i] : nan, ray);
                    // Points without a direction are not finite here, so in no index.
                    ends[i] = combined(1.0, difference(from[i], origin), 1.0, rays_[i]);
                }
            });
        });
        index_.rebuild(ends, run);
    }

    [[nodiscard]] std::size_t size() const { return index_.size(); }
    [[nodiscard]] bool has_ray(std::size_t i) const { return index_.is_finite(i); }

    /// The points at most this far from point i on the sphere, itself among them.
    [[nodiscard]] auto within(std::size_t i, double reach) const {
        return index_.within(index_[i], reach);
    }

    /// The distance to the k-th other ray; infinite where there are fewer.
    [[nodiscard]] double distance_of(std::size_t i, std::size_t k) const {
        const auto nearest = index_.nearest(index_[i], k + 1);
        return nearest.size() > k ? std::sqrt(nearest[k].squared_distance)
                                  : std::numeric_limits<double>::infinity();
    }

    /// Whether the surface of point i goes on around it: no sector without one of its points is
    /// wider than `widest_sector`.
    [[nodiscard]] bool is_surrounded(std::size_t i, double reach) const {
        const Eigen::Vector3d u = orthogonal(rays_[i]), v = cross(rays_[i], u);
        scratch<double> azimuths;
        for (const neighbor& q : within(i, reach)) {
            // Other echoes of the same ray have no direction from it.
            if (q.squared_distance < same_ray * same_ray) continue;
            if (std::abs(ranges_[q.index] - ranges_[i]) > max_jump_) continue;
            azimuths.push_back(std::atan2(dot(rays_[q.index], v), dot(rays_[q.index], u)));
        }
        if (azimuths.empty()) return false;
        std::sort(azimuths.begin(), azimuths.end());
        double widest = azimuths.front() + 2.0 * std::numbers::pi - azimuths.back();
        for (std::size_t k = 1; k < azimuths.size(); ++k)
            widest = std::max(widest, azimuths[k] - azimuths[k - 1]);
        return widest <= widest_sector.radians();
    }

    static constexpr double same_ray = 1e-6;  ///< rays closer together are one [rad]; rounding

  private:
    // A ray of a raster has neighbors in four directions, 90 degrees apart; and rounding and
    // jitter.
    static constexpr angle widest_sector = degrees(100.0);

    double max_jump_;
    scratch<Eigen::Vector3d> rays_;  // unit vectors
    scratch<double> ranges_;         // [m]
    spatial_index index_;
};

/// How far apart rays are in the wider direction of a scan [rad]: most rays are surrounded by
/// others within this distance. Zero if there is no such distance, as in a single scan line.
[[nodiscard]] inline double reach_of_raster(const ray_sphere& rays) {
    constexpr std::size_t about = 1000;  // rays looked at; performance
    const std::size_t thinning = std::max<std::size_t>(1, rays.size() / about);
    scratch<std::size_t> some;
    scratch<double> nearest;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        // At random: regular steps may always hit the border of a raster.
        if (!rays.has_ray(i) || random_stream(i).bits() % thinning != 0) continue;
        some.push_back(i);
        nearest.push_back(rays.distance_of(i, 4));  // formula: as many as directions of a raster
    }
    if (some.empty()) return 0.0;
    const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
    std::nth_element(nearest.begin(), middle, nearest.end());
    constexpr double widest = 0.2, growth = 1.25;  // rad: coarser than any scanner; performance
    for (double reach = growth * std::max(*middle, ray_sphere::same_ray); reach < widest;
         reach *= growth) {
        const auto surrounded = std::count_if(
            some.begin(), some.end(), [&](std::size_t i) { return rays.is_surrounded(i, reach); });
        if (2 * static_cast<std::size_t>(surrounded) >= some.size()) return reach;
    }
    return 0.0;
}

}  // namespace detail

/// The indices of the points that are at no silhouette, ascending; see subset.
///
/// A point is at a silhouette if the surface ends at it: against nothing, or against a surface
/// whose range differs by more than max_jump. Points whose rays are nearer to such a ray than half
/// the divergence, less the distance to their nearest ray, are removed too: the ray at the
/// silhouette is itself part of the half beam. So any beam, even one of zero width, costs at least
/// one ray at each side of a leg: only use it for beams that are wider than rays are apart.
///
/// Rays should be about equally dense: where they are much farther apart than most, points are
/// removed. So are those of surfaces at grazing incidence, where neighboring ranges differ by more
/// than max_jump. Points without a ray, not finite or at their view point, are left out. If rays
/// are not next to each other in two directions, as in a single scan line, no silhouette is found,
/// and all points with a ray are kept.
///
/// @param points      any point range of n points [m]; seen from the origin without view points.
///                    Scans from view points farther apart than 2 m do not count as neighbors;
///                    those from nearer ones mix: use one call per scan
/// @param options     divergence of the beams, and what a jump is
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the indices of the points to keep, for `subset`
/// @throws std::invalid_argument  if an option is out of range
/// Complexity: O(n (log n + m log m)) for m rays within the wider spacing of rays or half a beam.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> remove_silhouettes(const R& points,
                                                          const silhouette_options& options = {},
                                                          const X& run = {}, Proj projection = {}) {
    options.require_valid();
    const auto& team = detail::staying(run);
    const detail::ray_sphere rays(points, options.max_jump, team, projection);
    const std::size_t n = rays.size();
    const double reach = detail::reach_of_raster(rays);
    detail::scratch<std::uint8_t> is_end(n, 0), is_kept(n, 0);
    detail::for_each_chunk(team, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (rays.has_ray(i) && reach > 0.0) is_end[i] = rays.is_surrounded(i, reach) ? 0 : 1;
    });
    const double half_beam = 0.5 * options.divergence.radians();
    detail::for_each_chunk(team, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!rays.has_ray(i) || is_end[i] != 0) continue;
            // The silhouette itself has lost a ray already.
            const double rest = reach > 0.0 ? half_beam - rays.distance_of(i, 1) : 0.0;
            const auto at_end = [&](const neighbor& q) { return is_end[q.index] != 0; };
            is_kept[i] = rest > 0.0 && std::ranges::any_of(rays.within(i, rest), at_end) ? 0 : 1;
        }
    });
    return detail::flagged(is_kept);
}

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Removes mixed points (mixed pixels, flying pixels; the skimmed points of Klasing 2010, Sec.
/// 5.8.4): a beam that hits two surfaces at once returns a range between them, where nothing is.
/// Chains of such points connect an object to what is behind it, so grouping by distance requires
/// scans without them:
///
///     auto kept = gnomon::remove_mixed_points(scan, {.divergence = gnomon::radians(0.010)});
///     gnomon::scan seen = gnomon::subset(scan, kept);
///
/// A surface that is seen at grazing incidence has neighboring ranges as different as those of two
/// surfaces, but inverse ranges of a plane are linear in the direction of the ray: points on a
/// plane are kept at any incidence. Most true points at edges are kept as well, those that make
/// surfaces look too wide among them: remove_silhouettes() removes these.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/filters/detail/flagged.hpp>
#include <gnomon/filters/detail/raster_reach.hpp>
#include <gnomon/filters/detail/ray_sphere.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon {

/// Between which surfaces points are mixed.
struct mixed_point_options {
    angle divergence = radians(0.010);  ///< full angle of the beams; that of wide laser beams
    noise_curve noise = constant_noise{0.005};  ///< along the rays
    /// Ranges that differ by less [m], or by less than six standard deviations of the noise, belong
    /// to one surface. Chosen on rooms of simulation::scenes::furnished_room(), seeds 1 to 30.
    double min_step = 0.03;

    /// @throws std::invalid_argument  unless divergence is from 0 to 90 degrees and min_step >= 0
    void require_valid() const {
        detail::require(divergence >= degrees(0.0) && divergence <= degrees(90.0),
                        "remove_mixed_points: the divergence must be from 0 to 90 degrees");
        detail::require(min_step >= 0.0,
                        "remove_mixed_points: min_step must not be negative or NaN");
    }
};

namespace detail {

/// The root mean square of ranges about the plane that fits them best [m], of rays that are next to
/// ray i. On a plane, the inverse range is linear in the direction of the ray.
/// @param nearby  neighbors in `rays`, ray i among them
[[nodiscard]] inline double rms_about_plane(const ray_sphere& rays, std::size_t i,
                                            const auto& nearby) {
    const Eigen::Vector3d ray = rays.ray_of(i), u = orthogonal(ray), v = cross(ray, u);
    Eigen::Matrix4d sums = Eigen::Matrix4d::Zero();  // of products of 1, u, v and inverse range
    for (const neighbor& q : nearby) {
        const Eigen::Vector3d way = rays.ray_of(q.index);
        const Eigen::Vector4d row(1.0, dot(way, u), dot(way, v), 1.0 / rays.range_of(q.index));
        sums += row * row.transpose();
    }
    sums /= sums(0, 0);
    const Eigen::Vector3d mean = sums.block<3, 1>(1, 0);
    const Eigen::Matrix3d scatter = sums.block<3, 3>(1, 1) - mean * mean.transpose();
    Eigen::Matrix2d directions = scatter.block<2, 2>(0, 0);
    constexpr double along_line = 1e-9;  // share: directions on a line have a slope, too
    directions += along_line * directions.trace() * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d to_range = scatter.block<2, 1>(0, 2);
    const double variance = scatter(2, 2) - to_range.dot(directions.llt().solve(to_range));
    const double own = rays.range_of(i);
    return std::sqrt(std::max(0.0, variance)) * own * own;
}

/// Whether points of a scan are mixed, one at a time.
class mixed_point_test {
  public:
    template <class R, execution X, class Proj>
    mixed_point_test(const R& points, const mixed_point_options& options, const X& run,
                     Proj projection)
        : options_(options),
          rays_(points, ray_sphere::usual_jump, run, projection),
          reach_(rays_, run) {}

    [[nodiscard]] std::size_t size() const { return rays_.size(); }
    [[nodiscard]] bool has_ray(std::size_t i) const { return rays_.has_ray(i); }

    /// Whether point i is mixed; not without a ray.
    [[nodiscard]] bool operator()(std::size_t i) const {
        if (!reach_.is_known() || !has_ray(i)) return false;
        constexpr double deviations = 6.0;  // of one range: 4.2 of the difference of two
        constexpr double uneven = 0.5;      // share of a step; chosen on the rooms of min_step
        const double own = rays_.range_of(i);
        const double sigma = options_.noise.along(scaled(own, rays_.ray_of(i)));
        const double step = std::max(options_.min_step, deviations * sigma);
        const double reach = 0.5 * options_.divergence.radians() + reach_.around(rays_, i);
        scratch<neighbor> nearby;
        rays_.within_into(nearby, i, reach);
        double nearest = own, farthest = own;
        for (const neighbor& q : nearby) {
            nearest = std::min(nearest, rays_.range_of(q.index));
            farthest = std::max(farthest, rays_.range_of(q.index));
        }
        if (!(nearest < own - step && farthest > own + step)) return false;
        std::sort(nearby.begin(), nearby.end());  // sums depend on the order
        return rms_about_plane(rays_, i, nearby) > uneven * step;
    }

  private:
    mixed_point_options options_;
    ray_sphere rays_;
    raster_reach reach_;
};

}  // namespace detail

/// The indices of the points that are not mixed, ascending; see subset.
///
/// The neighbors of a point are here the points whose rays are at most half the divergence and the
/// spacing of rays from its own, as far as both surfaces are seen. A point is mixed if one of them
/// is nearer than it by a step, another one farther by a step, and the root mean square of their
/// ranges about the plane that fits them best is more than half a step.
///
/// Points without a ray, not finite or at their view point, are left out. If rays are not next to
/// each other in two directions, as in a single scan line, all points with a ray are kept.
///
/// @param points      any point range of n points [m]; seen from the origin without view points.
///                    Scans from view points nearer to each other than 2 m mix: use one call per
///                    scan
/// @param options     divergence of the beams, noise, and what a step is
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the indices of the points to keep, for `subset`
/// @throws std::invalid_argument  if an option is out of range
/// Complexity: O(n (log n + m)) for m neighbors.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> remove_mixed_points(const R& points,
                                                           const mixed_point_options& options = {},
                                                           const X& run = {},
                                                           Proj projection = {}) {
    options.require_valid();
    const auto& team = detail::staying(run);
    const detail::mixed_point_test is_mixed(points, options, team, projection);
    detail::scratch<std::uint8_t> is_kept(is_mixed.size(), 0);
    detail::for_each_chunk(team, is_kept.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            is_kept[i] = is_mixed.has_ray(i) && !is_mixed(i) ? 1 : 0;
    });
    return detail::flagged(is_kept);
}

}  // namespace gnomon

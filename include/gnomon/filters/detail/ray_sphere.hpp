// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which rays of a scan are next to each other, at whatever range, and where surfaces end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

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

    /// The end of the ray of point i at 1 m from its view point, from some origin.
    [[nodiscard]] Eigen::Vector3d end_of(std::size_t i) const { return index_[i]; }

    /// The direction of the ray of point i, of length 1, and its range [m].
    [[nodiscard]] const Eigen::Vector3d& ray_of(std::size_t i) const { return rays_[i]; }
    [[nodiscard]] double range_of(std::size_t i) const { return ranges_[i]; }

    /// The points at most this far from point i on the sphere, itself among them.
    [[nodiscard]] auto within(std::size_t i, double reach) const {
        return index_.within(index_[i], reach);
    }

    /// The same in no order, in the memory of `found`.
    void within_into(scratch<neighbor>& found, std::size_t i, double reach) const {
        search_tree_unsorted(index_.tree(), index_[i], {.squared_radius = reach * reach}, found);
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
        scratch<neighbor> nearby;
        within_into(nearby, i, reach);
        for (const neighbor& q : nearby) {
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

    /// Neighboring rays whose ranges differ by more [m] have hit two surfaces; chosen on
    /// simulation::furniture_models(), seeds 1 to 3.
    static constexpr double usual_jump = 0.30;  // [m]; chosen, as above
    static constexpr double same_ray = 1e-6;    ///< rays closer together are one [rad]; rounding

  private:
    // A ray of a raster has neighbors in four directions, 90 degrees apart; and rounding and
    // jitter.
    static constexpr angle widest_sector = degrees(100.0);

    double max_jump_;
    scratch<Eigen::Vector3d> rays_;  // unit vectors
    scratch<double> ranges_;         // [m]
    spatial_index index_;
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals that are sharp at edges and steady under noise, with one set of parameters for clean and
/// noisy clouds, dense and thin ones. Estimators see one neighborhood; this method sees the cloud,
/// in three sweeps over it:
///
///  1. fit     PlanePCA of the fewest neighbors with which the noise tilts the normal by no more
///             than `tilt` (Mitra, Nguyen and Guibas 2004).
///  2. shift   Each point selects, among its own plane and those of its neighbors, the plane that
///             fits the point and its neighbors best; near an edge, that of a neighbor whose
///             neighborhood does not cross the edge (shifted neighborhoods, Cao et al. 2018). The
///             plane is then fitted again to its inliers.
///  3. filter  A bilateral filter of the normals, weighted by the angle between them and by the
///             distances of the points to each other's planes (Zheng et al. 2011, for meshes).
///
/// Not suitable for smooth surfaces without noise, where planes are biased and jets are not, and
/// for clouds whose noise varies strongly, since one `noise` is used for all points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/shifted_plane.hpp>
#include <gnomon/normals/detail/surfel_maker.hpp>
#include <gnomon/normals/noise_level.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// No `estimator`, which would see one neighborhood at a time, but called like one, without a
/// graph: `estimate_normals(points, feature_preserving{})`.
struct feature_preserving {
    std::optional<double> noise = {};  ///< across the surface [m]; else what `noise_level` finds
    double tilt = 0.05;             ///< standard deviation of a first normal that is allowed [rad]
    std::size_t min_k = 8;          ///< fewest neighbors of a first fit
    std::size_t max_k = 255;        ///< most neighbors, for the sake of time
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak
};

namespace detail {

/// The three sweeps over the points of an index. (A template, so that only its users compile a
/// search.)
template <class Index>
class feature_preserving_sweeps {
  public:
    feature_preserving_sweeps(const feature_preserving& options, const Index& points, double noise)
        : options_(options), points_(points), noise_(noise) {}

    /// Sweep 1, for point i. Searches as many neighbors as were enough for the last point first.
    local_plane fitted(std::size_t i, std::vector<neighbor>& neighbors, std::size_t& enough) const {
        const Eigen::Vector3d p = points_[i];
        std::size_t k = options_.min_k;
        enough = std::max(enough, k);
        knn{.k = enough}.find(points_, i, neighbors);
        // A plane over a disc of radius r: its slopes have the deviation 2 noise / (r sqrt(k)).
        const auto too_tilted = [&] {
            const double r2 = neighbors[k - 1].squared_distance;
            return 2.0 * noise_ > options_.tilt * std::sqrt(r2 * static_cast<double>(k));
        };
        while (k <= neighbors.size() && k < options_.max_k && too_tilted()) {
            k = std::min(options_.max_k, k + std::max<std::size_t>(1, k / 6));
            if (k <= enough) continue;
            enough = std::min(options_.max_k, k + k / 2);
            knn{.k = enough}.find(points_, i, neighbors);
        }
        enough = k + k / 4;
        k = std::min(k, neighbors.size());
        local_plane plane;
        plane.neighbors = static_cast<point_index>(k);
        if (k < 2) return plane;
        for (std::size_t l = 0; l < k; ++l)
            plane.mean_distance += std::sqrt(neighbors[l].squared_distance);
        plane.mean_distance /= static_cast<double>(k);
        const moments m = moments_of_first(k, neighbors, points_, p);
        plane.fit = plane_of_least_spread(m.covariance_with_point(), options_.min_aspect_ratio);
        plane.offset = dot(plane.fit.normal, m.mean_with_point());
        return plane;
    }

    /// Sweep 2, for point i with the planes of sweep 1.
    local_plane shifted(std::size_t i, const std::vector<local_plane>& planes,
                        std::vector<neighbor>& found, surroundings& neighbors) const {
        constexpr std::size_t sight = 32;  // neighbors, to see beyond an edge
        constexpr double honest = 2.4;     // noise deviations that a point may be off its plane,
        constexpr double bend = 0.004;  // and radii of the neighbors, for curvature that is no edge
        constexpr double wider = 2.5;   // once the side is decided, more points make less noise
        if (!usable(planes[i].fit.trust)) return planes[i];
        look_around(i, std::max<std::size_t>(sight, planes[i].neighbors), found, neighbors);
        const double deviation = std::hypot(honest * noise_, bend * neighbors.radius());
        local_plane plane = planes[i];
        const local_plane best = refitted(neighbors, best_plane(neighbors, planes, deviation),
                                          wider * deviation, options_.min_aspect_ratio);
        plane.fit = best.fit;
        plane.offset = best.offset;
        return plane;
    }

    /// Sweep 3, for point i with the planes of sweep 2.
    surfel<plane_fit> filtered(std::size_t i, const std::vector<local_plane>& planes,
                               std::vector<neighbor>& found, surroundings& neighbors) const {
        constexpr std::size_t fewest = 16, most = 128;
        constexpr double honest = 2.0, bend = 0.05;
        surfel<plane_fit> s;
        static_cast<plane_fit&>(s) = planes[i].fit;
        s.neighbors = planes[i].neighbors;
        s.mean_distance = planes[i].mean_distance;
        if (!usable(s.trust)) return s;
        look_around(i, std::clamp<std::size_t>(s.neighbors, fewest, most), found, neighbors);
        s.normal = filtered_normal(neighbors, planes,
                                   std::hypot(honest * noise_, bend * neighbors.radius()));
        const bool coarse = is_coarse(points_.epsilon(), points_[i], s.mean_distance);
        if (coarse && s.trust == trust::good) s.trust = trust::weak;
        return s;
    }

  private:
    void look_around(std::size_t i, std::size_t k, std::vector<neighbor>& found,
                     surroundings& neighbors) const {
        const Eigen::Vector3d p = points_[i];
        knn{.k = k}.find(points_, i, found);
        neighbors.index.assign(1, static_cast<point_index>(i));
        neighbors.way.assign(1, {0.0, 0.0, 0.0});
        for (const neighbor& q : found) {
            neighbors.index.push_back(q.index);
            neighbors.way.push_back(difference(points_[q.index], p));
        }
    }

    const feature_preserving& options_;
    const Index& points_;
    double noise_;
};

}  // namespace detail

/// The surface elements of all points, in their order. The normals have no consistent sign:
/// `orient_normals` or `propagate_orientation` gives them one.
///
/// @param points      any point range of n points [m]
/// @param options     a `feature_preserving`
/// @param run         `sequential{}` or `threads{n}`; the result is the same bytes
/// @param projection  makes a point of an element of the range
/// @return n surface elements, as an estimator that returns `plane_fit` gives them; the spectrum is
///         that of the weighted neighbors after the last sweep, `neighbors` the k of the first
/// @throws std::invalid_argument  unless 2 <= min_k <= max_k, tilt > 0 and noise >= 0, both finite
/// Complexity: three searches and about 2,000 exponentials per point; 250 bytes per point.
/// Accuracy and limits: docs/normals.md.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] auto estimate_normals(const R& points, const feature_preserving& options,
                                    const X& run = {}, Proj projection = {})
    -> std::vector<surfel<plane_fit>> {
    detail::require(options.min_k >= 2 && options.min_k <= options.max_k,
                    "feature_preserving: needs 2 <= min_k <= max_k");
    detail::require(options.tilt > 0.0 && std::isfinite(options.tilt),
                    "feature_preserving: the tilt must be positive");
    detail::require(!options.noise || (*options.noise >= 0.0 && std::isfinite(*options.noise)),
                    "feature_preserving: the noise must not be negative");
    const auto& team = detail::staying(run);
    const auto& p = detail::index_of(points, team, projection);
    const double noise = options.noise ? *options.noise : detail::noise_level_in(p, options.max_k);
    const detail::feature_preserving_sweeps sweeps(options, p, noise);

    std::vector<detail::local_plane> first(p.size()), second(p.size());
    std::vector<surfel<plane_fit>> surface(p.size());
    detail::for_each_chunk(team, p.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<neighbor> found;
        std::size_t enough = 0;
        for (std::size_t i = begin; i < end; ++i) {
            if (p.is_finite(i))
                first[i] = sweeps.fitted(i, found, enough);
            else
                first[i].fit.trust = trust::not_finite;
        }
    });
    detail::for_each_chunk(team, p.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<neighbor> found;
        detail::surroundings neighbors;
        for (std::size_t i = begin; i < end; ++i)
            second[i] = sweeps.shifted(i, first, found, neighbors);
    });
    detail::for_each_chunk(team, p.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<neighbor> found;
        detail::surroundings neighbors;
        for (std::size_t i = begin; i < end; ++i)
            surface[i] = sweeps.filtered(i, second, found, neighbors);
    });
    return surface;
}

}  // namespace gnomon

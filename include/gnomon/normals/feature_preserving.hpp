// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals that are sharp at edges and steady under noise, with one set of parameters for clean and
/// noisy clouds, dense and thin ones. Estimators see one neighborhood; this method sees the cloud,
/// in three sweeps over it:
///
///  1. fit     How many neighbors a point gets, noise decides: the fewest with which it tilts the
///             normal by no more than `tilt` (Mitra, Nguyen and Guibas 2004). PlanePCA of those.
///  2. lend    Each point tries its neighbors' planes as well and takes the one on which it and
///             most of its neighbors lie; beside an edge, that of a neighbor whose own neighbors
///             do not cross it (shifted neighborhoods, Cao et al. 2018). Then the plane is fitted
///             again to those that lie on it.
///  3. filter  The mean of the neighbors' normals as far as they agree and the points lie on each
///             other's planes (a bilateral filter, as of Zheng et al. 2011 for meshes).
///
/// What it is not good at: smooth, clean surfaces, on which a plane is biased and a jet is not; and
/// clouds whose noise differs much from place to place, since it takes one `noise` for all.
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
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/normals/detail/lent_plane.hpp>
#include <gnomon/normals/estimate_normals.hpp>
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

/// The three sweeps over the points of a position_view.
template <class Points>
class feature_preserving_sweeps {
  public:
    feature_preserving_sweeps(const feature_preserving& options, const Points& points,
                              const kd_tree& tree, double noise)
        : options_(options), points_(points), tree_(tree), noise_(noise) {}

    /// Sweep 1, for point i. Searches as many neighbors as were enough for the last point first.
    local_plane fitted(std::size_t i, std::vector<neighbor>& ring, std::size_t& enough) const {
        const Eigen::Vector3d p = points_[i];
        std::size_t k = options_.min_k;
        enough = std::max(enough, k);
        tree_.nearest(p, enough, i, ring);
        // A plane over a disc of radius r: its slopes have the deviation 2 noise / (r sqrt(k)).
        const auto too_tilted = [&] {
            const double r2 = ring[k - 1].squared_distance;
            return 2.0 * noise_ > options_.tilt * std::sqrt(r2 * static_cast<double>(k));
        };
        while (k <= ring.size() && k < options_.max_k && too_tilted()) {
            k = std::min(options_.max_k, k + std::max<std::size_t>(1, k / 6));
            if (k <= enough) continue;
            enough = std::min(options_.max_k, k + k / 2);
            tree_.nearest(p, enough, i, ring);
        }
        enough = k + k / 4;
        k = std::min(k, ring.size());
        local_plane plane;
        plane.neighbors = static_cast<point_index>(k);
        if (k < 2) return plane;
        for (std::size_t l = 0; l < k; ++l)
            plane.mean_distance += std::sqrt(ring[l].squared_distance);
        plane.mean_distance /= static_cast<double>(k);
        const moments m = moments_of_first(k, ring, points_, p);
        plane.fit = plane_of_least_spread(m.covariance_with_point(), options_.min_aspect_ratio);
        plane.offset = dot(plane.fit.normal, m.mean_with_point());
        return plane;
    }

    /// Sweep 2, for point i with the planes of sweep 1.
    local_plane lent(std::size_t i, const std::vector<local_plane>& planes,
                     std::vector<neighbor>& found, surroundings& ring) const {
        constexpr std::size_t sight = 32;  // neighbors, to see beyond an edge
        constexpr double honest = 2.4;     // noise deviations that a point may be off its plane,
        constexpr double bend = 0.004;     // and radii of the ring, for curvature that is no edge
        constexpr double wider = 2.5;      // once the side is decided, more points make less noise
        if (!usable(planes[i].fit.trust)) return planes[i];
        look_around(i, std::max<std::size_t>(sight, planes[i].neighbors), found, ring);
        const double deviation = std::hypot(honest * noise_, bend * ring.radius());
        local_plane plane = planes[i];
        const local_plane best = refitted(ring, best_plane(ring, planes, deviation),
                                          wider * deviation, options_.min_aspect_ratio);
        plane.fit = best.fit;
        plane.offset = best.offset;
        return plane;
    }

    /// Sweep 3, for point i with the planes of sweep 2.
    surfel<plane_fit> filtered(std::size_t i, const std::vector<local_plane>& planes,
                               std::vector<neighbor>& found, surroundings& ring) const {
        constexpr std::size_t fewest = 16, most = 128;
        constexpr double honest = 2.0, bend = 0.05;
        surfel<plane_fit> s;
        static_cast<plane_fit&>(s) = planes[i].fit;
        s.neighbors = planes[i].neighbors;
        s.mean_distance = planes[i].mean_distance;
        if (!usable(s.trust)) return s;
        look_around(i, std::clamp<std::size_t>(s.neighbors, fewest, most), found, ring);
        s.normal = filtered_normal(ring, planes, std::hypot(honest * noise_, bend * ring.radius()));
        const bool coarse = is_coarse<typename Points::scalar>(points_[i], s.mean_distance);
        if (coarse && s.trust == trust::good) s.trust = trust::weak;
        return s;
    }

  private:
    void look_around(std::size_t i, std::size_t k, std::vector<neighbor>& found,
                     surroundings& ring) const {
        const Eigen::Vector3d p = points_[i];
        tree_.nearest(p, k, i, found);
        ring.index.assign(1, static_cast<point_index>(i));
        ring.way.assign(1, {0.0, 0.0, 0.0});
        for (const neighbor& q : found) {
            ring.index.push_back(q.index);
            ring.way.push_back(difference(points_[q.index], p));
        }
    }

    const feature_preserving& options_;
    const Points& points_;
    const kd_tree& tree_;
    double noise_;
};

}  // namespace detail

/// The surface elements of all points, in their order. The normals have no consistent sign:
/// `orient` or `propagate_orientation` gives them one.
///
/// @param points      any point range of n points [m]
/// @param options     a `feature_preserving`
/// @param run         `sequential{}` or `threads{n}`; the result is the same bytes
/// @param projection  makes a point of an element of the range
/// @return n surface elements, as of an estimator that gives `plane_fit`; the spectrum is that of
///         the weighted neighbors at the end, `neighbors` the k that noise asked for
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
    const position_view<R, Proj> p(points, projection);
    const kd_tree tree(points, std::move(projection));
    const double noise =
        options.noise ? *options.noise : detail::noise_level_in(p, tree, options.max_k);
    const detail::feature_preserving_sweeps sweeps(options, p, tree, noise);

    std::vector<detail::local_plane> first(p.size()), second(p.size());
    std::vector<surfel<plane_fit>> surface(p.size());
    for_each_chunk(run, p.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<neighbor> found;
        std::size_t enough = 0;
        for (std::size_t i = begin; i < end; ++i) {
            if (is_finite(p[i]))
                first[i] = sweeps.fitted(i, found, enough);
            else
                first[i].fit.trust = trust::not_finite;
        }
    });
    for_each_chunk(run, p.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<neighbor> found;
        detail::surroundings ring;
        for (std::size_t i = begin; i < end; ++i) second[i] = sweeps.lent(i, first, found, ring);
    });
    for_each_chunk(run, p.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<neighbor> found;
        detail::surroundings ring;
        for (std::size_t i = begin; i < end; ++i)
            surface[i] = sweeps.filtered(i, second, found, ring);
    });
    return surface;
}

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals that are sharp at edges and steady under noise, with one set of parameters for clean and
/// noisy clouds, dense and thin ones. Estimators see one neighborhood; this method sees the cloud,
/// in three sweeps over it:
///
///  1. fit     The simplest surface, a plane or else a quadric, that the noise does not reject, of
///             the fewest neighbors with which the noise tilts the normal by no more than `tilt`
///             (Mitra, Nguyen and Guibas 2004). Where the noise hardly tilts it, as on clean smooth
///             surfaces, that is all.
///  2. shift   Each point selects, among its own surface and those of its neighbors, the one that
///             fits the point and its neighbors best; near an edge, that of a neighbor whose
///             neighborhood does not cross the edge (shifted neighborhoods, Cao et al. 2018). The
///             surface is then fitted again to its inliers.
///  3. filter  A bilateral filter of the normals that the surfaces of the neighbors have at the
///             point, weighted by the angle between them and by the distances of the points from
///             each other's surfaces (Zheng et al. 2011, for meshes).
///
/// Not suitable for clouds whose noise varies strongly, since one `noise` is used for all points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/local_surface.hpp>
#include <gnomon/normals/detail/shifted_surface.hpp>
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
    std::size_t max_k = 128;        ///< most neighbors, for the sake of time
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

    /// The surfaces of sweep 1.
    [[nodiscard]] auto fitted(const auto& run) const {
        return made_by(run, [&](const surroundings& around) {
            std::size_t k = std::min(options_.min_k, around.last());
            const std::size_t most = std::min(options_.max_k, around.last());
            const auto too_tilted = [&] {
                return !(deviation_of_slope(noise_, around.radius(k), k) <= options_.tilt);
            };
            while (k < most && too_tilted())
                k = std::min(most, k + std::max<std::size_t>(1, k / 6));
            local_surface s;
            if (k >= 2) s = simplest_surface(around, k, noise_, options_.min_aspect_ratio);
            s.neighbors = static_cast<point_index>(k);
            s.mean_distance = around.mean_distance(k);
            return s;
        });
    }

    /// The surfaces of sweep 2, from those of sweep 1.
    [[nodiscard]] auto shifted(const auto& surfaces, const auto& run) const {
        // Chosen on the tuning half of known_normals.
        constexpr double inlier_deviations = 2.4;  // of a point from its surface, in noise
        constexpr double relative_bend = 0.004;    // of a plane, in radii of the neighborhood
        constexpr double refit_widening = 2.0;     // of both, as more inliers average more noise
        return made_by(run, [&](const surroundings& around) {
            local_surface s = surfaces[around.index[0]];
            if (!usable(s.fit.trust) || s.settled) return s;
            const std::size_t k =
                std::min(std::max<std::size_t>(sight, s.neighbors), around.last());
            const double deviation =
                std::hypot(inlier_deviations * noise_, relative_bend * around.radius(k));
            const local_surface best =
                refitted(around, k, best_surface(around, k, surfaces, deviation),
                         refit_widening * deviation, options_.min_aspect_ratio);
            s.fit = best.fit;
            s.base = best.base;
            s.height = best.height;
            s.curved = best.curved;
            return s;
        });
    }

    /// The normals of sweep 3, from the surfaces of sweep 2.
    [[nodiscard]] std::vector<surfel<plane_fit>> filtered(const auto& surfaces,
                                                          const auto& run) const {
        constexpr std::size_t fewest = 16;
        constexpr double inlier_deviations = 2.0, relative_bend = 0.05;  // as in sweep 2
        std::vector<surfel<plane_fit>> result(points_.size());
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (!points_.is_finite(i)) result[i].trust = trust::not_finite;
        for_each_point(run, [&](std::size_t i, const surroundings& around) {
            const local_surface& own = surfaces[i];
            surfel<plane_fit>& s = result[i];
            static_cast<plane_fit&>(s) = own.fit;
            s.neighbors = own.neighbors;
            s.mean_distance = own.mean_distance;
            if (!usable(s.trust)) return;
            if (!own.settled) {
                const std::size_t k =
                    std::min(std::max<std::size_t>(fewest, own.neighbors), around.last());
                s.normal = filtered_normal(
                    around, k, surfaces,
                    std::hypot(inlier_deviations * noise_, relative_bend * around.radius(k)));
            }
            const bool coarse = is_coarse(points_.epsilon(), points_[i], s.mean_distance);
            if (coarse && s.trust == trust::good) s.trust = trust::weak;
        });
        return result;
    }

  private:
    static constexpr std::size_t sight = 32;  // neighbors, to see beyond an edge

    /// each(i, around) for every finite point.
    void for_each_point(const auto& run, const auto& each) const {
        const auto make_visitor = [&] {
            return [this, &each, sorted = scratch<neighbor>(), around = surroundings()](
                       std::size_t i, const auto& found) mutable {
                found.sort_into(sorted);
                around.assign(points_, i, sorted);
                each(i, around);
            };
        };
        knn{.k = std::max(sight, options_.max_k)}.sweep(points_, run, make_visitor);
    }

    [[nodiscard]] auto made_by(const auto& run, const auto& make) const {
        using made = std::invoke_result_t<decltype(make), const surroundings&>;
        std::vector<made> surfaces(points_.size());
        for_each_point(
            run, [&](std::size_t i, const surroundings& around) { surfaces[i] = make(around); });
        return surfaces;
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
///         that of the points that the surface was last fitted to, `neighbors` the k of the first
/// @throws std::invalid_argument  unless 2 <= min_k <= max_k, tilt > 0 and noise >= 0, both finite
/// Complexity: three searches of max_k neighbors per point and, near edges and where there is
/// noise, about 1,500 weights; 500 bytes per point. Accuracy and limits: docs/normals.md.
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

    return sweeps.filtered(sweeps.shifted(sweeps.fitted(team), team), team);
}

}  // namespace gnomon

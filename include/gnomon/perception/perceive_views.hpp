// SPDX-License-Identifier: BSL-1.0
/// @file
/// From a scan to the views of the objects in it: removal of floor and ceiling, normals, smooth
/// surfaces, and their grouping by distance. Views to learn and views to recognize are comparable
/// only if the same steps made both, so this is one function:
///
///     namespace rec = gnomon::recognition;
///     // Of a room, the floor is searched for:
///     const auto seen = rec::perceive_views(scan, {}, gnomon::threads{});
///     for (const rec::view& v : seen.views) use(model.explain(v));
///     // Of a single object on a floor that is not in the scan:
///     const auto alone = rec::perceive_views(
///         scan, {.ground = gnomon::plane{}, .noise = gnomon::constant_noise{0.005},
///                .gap = rec::infinite_gap});
///
/// In no umbrella: include it by name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/filters/subset.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/perception/perception.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// How views are perceived. Klasing 2010, Secs. 4.2 and 5.5.1.
struct perceive_views_options {
    /// The plane below the objects, with its normal upwards. Without it floor and ceiling are
    /// searched for.
    std::optional<plane> ground = std::nullopt;
    Eigen::Vector3d up{0.0, 0.0, 1.0};  ///< of unit length; used only without `ground`
    /// Heights that are left out. Legs without floor are cut as those on a floor.
    crop_height_options bands{};
    std::optional<noise_curve> noise = std::nullopt;  ///< along the rays; else it is measured
    double gap = 0.10;          ///< largest distance of nearest points within a view [m]
    std::size_t min_parts = 1;  ///< views of fewer parts are dropped
    /// Most neighbors of a point; 50 span several surfaces of a chair at 4 m. Half as many points
    /// are the least of a segment. Chosen on furniture_models(), seed 7.
    std::size_t k = 20;
    /// In sparse scans a point has as many neighbors as are within this distance in the median [m],
    /// but at least 10. Chosen on furniture_models(), seed 7.
    double reach = 0.05;
    /// Segments that are longer [m] are walls and left out, since all that is close to a wall would
    /// be one view; chosen: the longest of furniture_models() is a bench of 1.8 m.
    double max_length = 2.2;
};

/// The views in a scan of n points.
struct perceived_views {
    std::optional<plane> ground;  ///< as given, or the floor if it was found
    segments parts;               ///< of the n points, with walls
    std::vector<view> views;      ///< part::segment is a number of `parts`

    /// The number of the view of each of the n points, that of its part; `unlabeled` of others.
    /// O(n).
    [[nodiscard]] std::vector<std::int32_t> labels() const {
        std::vector<std::int32_t> view_of_part(parts.size(), unlabeled);
        for (std::size_t v = 0; v < views.size(); ++v)
            for (const part& p : views[v].parts)
                view_of_part[static_cast<std::size_t>(p.segment)] = static_cast<std::int32_t>(v);
        std::vector<std::int32_t> labels = parts.labels();
        for (std::int32_t& l : labels)
            if (l != unlabeled) l = view_of_part[static_cast<std::size_t>(l)];
        return labels;
    }
};

namespace detail {

/// The neighbors of a point that the density of a scan allows.
[[nodiscard]] inline std::size_t neighbors_by_density(const auto& points,
                                                      const perceive_views_options& options,
                                                      const auto& run) {
    constexpr std::size_t near = 4, least = 10;  // chosen on furniture_models(), seed 7
    const adjacency nearest = knn{.k = near}(points, run);
    std::vector<double> squared;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        if (nearest[i].size() == near)
            squared.push_back(squared_distance(points[i], points[nearest[i].back()]));
    }
    if (squared.empty()) return std::min(least, options.k);
    const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
    std::nth_element(squared.begin(), middle, squared.end());
    // As many as the disc of this radius has, of the density of the disc of the nearest ones.
    const double k = static_cast<double>(near) * options.reach * options.reach / *middle;
    if (!(k < static_cast<double>(options.k))) return options.k;  // also for points at one place
    return std::min(options.k, std::max(least, static_cast<std::size_t>(k)));
}

/// The indices of points that are not in a segment longer than `max_length`.
[[nodiscard]] inline std::vector<point_index> without_long(const auto& points, const auto& surface,
                                                           const segments& parts,
                                                           double max_length) {
    std::vector<char> is_long(parts.size(), 0);
    for (std::size_t s = 0; s < parts.size(); ++s) {
        const auto shape = segment_shape::of(points, surface, parts[s]);
        is_long[s] = shape.is_surface() && shape.frame.box_size.maxCoeff() > max_length;
    }
    std::vector<point_index> left;
    for (std::size_t i = 0; i < parts.labels().size(); ++i) {
        const std::int32_t label = parts.labels()[i];
        if (label == unlabeled || is_long[static_cast<std::size_t>(label)] == 0)
            left.push_back(static_cast<point_index>(i));
    }
    return left;
}

}  // namespace detail

/// Perceives the views of objects in a scan.
///
/// Without a ground the views have none if no floor is found: features of heights then refuse them.
/// @param points   any point range of n points [m]; seen from the origin without view points
/// @param options  ground, noise, density, gap
/// @param run      the result does not depend on it
/// @return the views, by their largest parts; none if fewer than 10 points are left
/// @throws std::invalid_argument  if k is below 3, reach not positive, max_length or gap negative or
///                                NaN, or what the steps throw for options out of range
/// Complexity: O(n log n).
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] perceived_views perceive_views(const R& points,
                                             const perceive_views_options& options = {},
                                             const X& run = {}, Proj projection = {}) {
    using gnomon::detail::require;
    require(options.k >= 3, "perceive_views: a normal requires 3 neighbors");
    require(options.reach > 0.0, "perceive_views: the reach must be positive");
    require(options.max_length >= 0.0, "perceive_views: max_length must not be negative or NaN");
    require(options.gap >= 0.0, "perceive_views: the gap must not be negative or NaN");
    const auto& team = gnomon::detail::staying(run);
    perceived_views result;
    result.ground = options.ground;
    std::optional<double> ceiling;
    if (!result.ground) {
        result.ground = find_floor(points, options.up, {}, projection);
        if (result.ground) ceiling = find_ceiling(points, *result.ground, {}, projection);
    }
    const position_view<R, Proj> position(points, projection);
    std::vector<point_index> kept;
    if (result.ground) {
        kept = crop_height(points, *result.ground, ceiling, options.bands, projection);
    } else {
        for (std::size_t i = 0; i < position.size(); ++i)
            if (is_finite(position[i])) kept.push_back(static_cast<point_index>(i));
    }
    std::vector<std::int32_t> labels(position.size(), unlabeled);
    constexpr std::size_t fewest = 10;  // points: fewer are no object; chosen
    if (kept.size() >= fewest) {
        const subset_view<R, Proj> scene(points, kept, projection);
        const std::size_t k = detail::neighbors_by_density(scene, options, team);
        perception<knn, plane_pca, conservative, smooth_surfaces> chain{
            .neighborhood = {.k = k}, .noise = options.noise};
        chain.segmentation.surfaces.min_points = k / 2;
        const auto seen = chain(scene, team);
        for (std::size_t i = 0; i < kept.size(); ++i) labels[kept[i]] = seen.surfaces.labels()[i];

        const auto left =
            detail::without_long(scene, seen.surface, seen.surfaces, options.max_length);
        const std::vector<point_index> furniture = subset(kept, left);
        result.views = views_of(
            subset_view<R, Proj>(points, furniture, projection),
            subset(seen.surface, left), segments(subset(labels, furniture)),
            {.gap = options.gap, .min_parts = options.min_parts, .ground = result.ground}, team);
    }
    result.parts = segments(std::move(labels));
    return result;
}

}  // namespace gnomon::recognition

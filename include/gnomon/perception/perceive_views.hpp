// SPDX-License-Identifier: BSL-1.0
/// @file
/// From a scan to the views of the objects in it: removal of floor, ceiling and walls, grouping by
/// distance, and the smooth surfaces of each group. Views to learn and views to recognize are
/// comparable only if the same steps made both, so this is one function:
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
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/filters/remove_mixed_points.hpp>
#include <gnomon/filters/remove_silhouettes.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/normals/measure_noise.hpp>
#include <gnomon/perception/detail/object_groups.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/recognition/wall.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// How views are perceived. Klasing 2010, Secs. 4.2 and 5.5.1.
struct perceive_views_options {
    /// The plane below the objects, with its normal upwards. Without it floor and ceiling are
    /// searched for.
    std::optional<plane> ground = std::nullopt;
    Eigen::Vector3d up{0.0, 0.0, 1.0};  ///< of unit length; used only without `ground`
    /// Heights that are left out. Legs without a floor are cut as those on a floor.
    crop_height_options bands{};
    std::optional<noise_curve> noise = std::nullopt;  ///< along the rays; else it is measured
    /// Full angle of the beams; 0 for narrow ones. If not 0, what they return wrongly is removed
    /// first: mixed points, by remove_mixed_points(), or, of a single object, for which the gap is
    /// infinite, points at silhouettes, by remove_silhouettes().
    angle divergence = degrees(0.0);
    double gap = 0.10;          ///< between nearest points of a view, at most [m]; Sec. 5.5.1
    std::size_t min_parts = 1;  ///< views of fewer parts are dropped
    /// Cells [m] to whose means dense scans are thinned first; chosen: finer than the parts of
    /// furniture, and 20 cells are wider than a noise of 1 cm.
    double cell = 0.01;
    std::size_t min_points = 60;  ///< least cells of a view; chosen on rooms, seeds 1 to 8
    /// Most neighbors of a cell: 50 span several surfaces of a chair at 4 m. Half as many cells are
    /// the least of a part; chosen on furniture_models(), seed 7.
    std::size_t k = 20;
    /// In sparse scans a cell has as many neighbors as are within this distance in the median [m],
    /// but at least 10; chosen on furniture_models(), seed 7.
    double reach = 0.05;
    /// Surfaces that are longer [m] and not level are walls. Points in their planes, within three
    /// deviations of the noise, belong to no view; chosen: the longest of furniture_models() is
    /// 1.8 m.
    double max_length = 2.2;

    /// @throws std::invalid_argument  if k is below 3, reach not positive, gap or max_length
    ///                                negative or NaN, or divergence not from 0 to 90 degrees
    void require_valid() const {
        using gnomon::detail::require;
        silhouette_options{.divergence = divergence}.require_valid();
        require(k >= 3, "perceive_views: a normal requires 3 neighbors");
        require(reach > 0.0, "perceive_views: the reach must be positive");
        require(gap >= 0.0, "perceive_views: the gap must not be negative or NaN");
        require(max_length >= 0.0, "perceive_views: max_length must not be negative or NaN");
    }
};

/// The views in a scan of n points.
struct perceived_views {
    std::optional<plane> ground;  ///< as given, or the floor if it was found
    std::vector<view> views;      ///< the one of most cells first
    segments parts;               ///< of the n points; part::segment refers to these
    segments groups;              ///< of the n points: those of each view, with points of no part
    std::vector<wall> walls;      ///< that were removed; none where the gap is infinite
};

namespace detail {

/// The finite points above the given ground, or between floor and ceiling if these are found.
template <class R, class Proj>
[[nodiscard]] std::vector<point_index> between_floor_and_ceiling(
    const R& points, const perceive_views_options& options, std::optional<plane>& ground,
    Proj projection) {
    ground = options.ground;
    std::optional<double> ceiling;
    if (!ground) {
        ground = find_floor(points, options.up, {}, projection);
        if (ground) ceiling = find_ceiling(points, *ground, {}, projection);
    }
    if (ground) return crop_height(points, *ground, ceiling, options.bands, projection);
    const position_view<R, Proj> position(points, projection);
    std::vector<point_index> finite;
    for (std::size_t i = 0; i < position.size(); ++i)
        if (is_finite(position[i])) finite.push_back(static_cast<point_index>(i));
    return finite;
}

/// The noise along the rays: as given, or measured, or where it cannot be, that of
/// constant_noise{}.
template <class R, class X, class Proj>
[[nodiscard]] noise_curve noise_of(const R& points, const std::optional<noise_curve>& given,
                                   const X& run, Proj projection) {
    if (given) return *given;
    const auto measured = measure_noise(points, run, projection);
    return measured.curve ? *measured.curve : constant_noise{};
}

/// Those of these points that wide beams return where a surface is. Objects among others are
/// connected by mixed points; one that is alone has hardly any, but looks wider than it is.
template <class R, execution X, class Proj>
[[nodiscard]] std::vector<point_index> seen_by_wide_beams(const R& points,
                                                          std::vector<point_index> chosen,
                                                          const perceive_views_options& options,
                                                          const X& run, Proj projection) {
    const angle divergence = options.divergence;
    if (divergence == degrees(0.0)) return chosen;
    std::vector<point_index> seen, both;
    if (options.gap < infinite_gap) {
        seen = remove_mixed_points(
            points,
            {.divergence = divergence, .noise = noise_of(points, options.noise, run, projection)},
            run, projection);
    } else {
        seen = remove_silhouettes(points, {.divergence = divergence}, run, projection);
    }
    std::ranges::set_intersection(chosen, seen, std::back_inserter(both));
    return both;
}

}  // namespace detail

/// Perceives the views of objects in a scan.
///
/// Objects are groups of points of which chains of steps of at most `gap` connect the cells, those
/// of no part among them, as the legs of a chair often are. Without a ground the views have none if
/// no floor is found: features of heights then refuse them.
/// @param points   any point range of n points [m]; seen from the origin without view points
/// @param options  ground, noise, density, gap
/// @param run      the result does not depend on it
/// @throws std::invalid_argument  for options that are not valid, or what the steps throw for them
/// Complexity: O(n log n).
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] perceived_views perceive_views(const R& points, perceive_views_options options = {},
                                             const X& run = {}, Proj projection = {}) {
    options.require_valid();
    const auto& team = gnomon::detail::staying(run);
    perceived_views result;
    const auto kept = detail::seen_by_wide_beams(
        points, detail::between_floor_and_ceiling(points, options, result.ground, projection),
        options, team, projection);
    const auto cells = average_voxels(subset_view<R, Proj>(points, kept, projection),
                                      {.edge = options.cell}, team);
    constexpr std::size_t fewest = 4;  // formula: a plane and a residual
    const std::size_t least = std::max(fewest, options.min_points);
    std::vector<std::int32_t> part_of_cell(cells.size(), unlabeled), view_of_cell = part_of_cell;
    if (cells.size() >= least) {
        auto found = detail::object_groups(
            cells, options, result.ground ? result.ground->normal : options.up, team);
        const segments& groups = found.groups;
        result.walls = std::move(found.walls);
        auto seen = detail::seen_groups(cells, groups, least, options, result.ground, team);
        std::int32_t parts = 0;
        for (std::size_t g = 0; g < seen.size(); ++g) {
            if (!seen[g].as_view) continue;
            result.views.push_back(*std::move(seen[g].as_view));
            for (part& p : result.views.back().parts) p.segment += parts;
            for (std::size_t i = 0; i < groups[g].size(); ++i) {
                const point_index c = groups[g][i];
                const std::int32_t label = seen[g].surfaces.labels()[i];
                if (label != unlabeled) part_of_cell[c] = parts + label;
                view_of_cell[c] = static_cast<std::int32_t>(result.views.size() - 1);
            }
            parts += static_cast<std::int32_t>(seen[g].surfaces.size());
        }
    }
    const auto of_points = [&](const std::vector<std::int32_t>& of_cells) {
        std::vector<std::int32_t> labels(std::ranges::size(points), unlabeled);
        for (std::size_t i = 0; i < kept.size(); ++i) labels[kept[i]] = of_cells[cells.of_point[i]];
        return segments(std::move(labels));
    };
    result.parts = of_points(part_of_cell);
    result.groups = of_points(view_of_cell);
    return result;
}

}  // namespace gnomon::recognition

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Thins a cloud to one point for each cube of a grid: the measured point that is nearest to the
/// mean of the cube's points (`thin_voxels`), or this mean (`average_voxels`).
///
///     const auto kept = gnomon::thin_voxels(scan, {.edge = 0.02});
///     const gnomon::scan part = gnomon::subset(scan, kept);
///
///     const auto means = gnomon::average_voxels(scan, {.edge = 0.02});       // a point range
///     auto surface = gnomon::estimate_normals(means, gnomon::knn{});
///     const auto intensities = gnomon::subset(intensity, means.nearest);     // of measured points
///     labels[i] = labels_of_means[means.of_point[i]];                        // back to all points
///
/// Cubes begin at multiples of their edge, whatever the cloud: the clouds of neighboring tiles
/// share a grid. Kept positions do not depend on the order of the points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/filters/detail/flagged.hpp>
#include <gnomon/filters/detail/voxels.hpp>

namespace gnomon {

/// The grid, and which of its cells count.
struct voxel_grid {
    double edge = 0.05;          ///< length of the edges of a cell [m], 1e-150 to 1e150; chosen
    std::size_t min_points = 1;  ///< cells with fewer points are dropped

    /// The means of the cells; models `point_range` and `has_viewpoints`.
    struct means {
        /// The cell of points that have none: not finite, or in a cell that was dropped.
        static constexpr point_index no_cell = std::numeric_limits<point_index>::max();

        std::vector<Eigen::Vector3d> points;  ///< the means [m]
        viewpoint_table viewpoints;           ///< those of `nearest`
        std::vector<point_index> nearest;     ///< the point nearest to each mean: thin_voxels()
        std::vector<point_index> counts;      ///< the number of points of each cell
        std::vector<point_index> of_point;    ///< the cell of each point of the cloud, or no_cell

        [[nodiscard]] auto begin() const { return points.begin(); }
        [[nodiscard]] auto end() const { return points.end(); }
        [[nodiscard]] std::size_t size() const { return points.size(); }
    };
};

namespace detail {

inline void require_valid(const voxel_grid& grid) {
    constexpr double least = 1e-150, most = 1e150;  // numerical: of numbers with finite squares
    require(grid.edge >= least && grid.edge <= most,
            "voxel_grid: the edge must be within 1e-150 and 1e150");
}

/// The points nearest to the means of the cells that count, of n points, ascending.
[[nodiscard]] inline std::vector<point_index> nearest_to_means(const voxel_parts& cells,
                                                               const voxel_grid& grid,
                                                               std::size_t n) {
    scratch<std::uint8_t> kept(n, 0);
    cells.for_each_cell([&](const voxel_entry& c) {
        if (c.number >= grid.min_points) kept[c.index] = 1;
    });
    return flagged(kept);
}

}  // namespace detail

/// The indices of the points that are nearest to the means of their cells, ascending. Of points
/// that are equally near, the one of least coordinates is kept, of duplicates the first. Points
/// that are not finite are left out.
///
/// @param points      any point range of n points [m]
/// @param grid        the edge of its cells, and how many points they must have
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return indices for `subset`, one for each cell that is not dropped
/// @throws std::invalid_argument  if the edge is out of range, or so small that a point is 2^50
///                                cells or more from the origin
/// Complexity: O(n + m log m) for m cells. The same bytes for every execution.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> thin_voxels(const R& points, const voxel_grid& grid = {},
                                                   const X& run = {}, Proj projection = {}) {
    detail::require_valid(grid);
    const position_view<R, Proj> p(points, std::move(projection));
    const auto& team = detail::staying(run);
    detail::voxel_parts cells(p, grid.edge, team);
    cells.find(team, [](auto, auto, auto) {});
    return detail::nearest_to_means(cells, grid, p.size());
}

/// The means of the points of each cell, exact to the rounding of the result and the edge over
/// 2^61 / n, in the order of the points nearest to them, whose view points they have.
///
/// @param points      any point range of n points [m]
/// @param grid        the edge of its cells, and how many points they must have
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return a mean for each cell that is not dropped, and the cell of each point
/// @throws std::invalid_argument  as thin_voxels(), or if the view points are for another number of
///                                points
/// Complexity: O(n + m log m) for m cells. The same bytes for every execution.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] voxel_grid::means average_voxels(const R& points, const voxel_grid& grid = {},
                                               const X& run = {}, Proj projection = {}) {
    detail::require_valid(grid);
    const position_view<R, Proj> p(points, std::move(projection));
    const auto& team = detail::staying(run);
    voxel_grid::means r;
    r.of_point.assign(p.size(), voxel_grid::means::no_cell);
    detail::voxel_parts cells(p, grid.edge, team);
    cells.find(team, [&](point_index i, point_index nearest, point_index count) {
        if (count >= grid.min_points) r.of_point[i] = nearest;
    });
    r.nearest = detail::nearest_to_means(cells, grid, p.size());
    r.viewpoints = detail::viewpoints_of(points, r.nearest);
    detail::scratch<point_index> number(p.size());
    for (std::size_t c = 0; c < r.nearest.size(); ++c)
        number[r.nearest[c]] = static_cast<point_index>(c);
    r.points.resize(r.nearest.size());
    r.counts.resize(r.nearest.size());
    cells.for_each_cell([&](const detail::voxel_entry& c) {
        if (c.number < grid.min_points) return;
        r.points[number[c.index]] = c.position();
        r.counts[number[c.index]] = c.number;
    });
    for (point_index& c : r.of_point)
        if (c != voxel_grid::means::no_cell) c = number[c];
    return r;
}

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The neighbors of a pixel in an organized image, as depth cameras and many lidars deliver it: one
/// point per pixel, row by row, NaN where there was no return. They are found in the image, without
/// a tree.
///
///     const gnomon::raster pixels{.noise = {noises::structured_light(), optical_axis}};
///     auto surface = gnomon::estimate_normals(scan, pixels, plane_pca{}, threads{});
///     auto parts = gnomon::segment_surfaces(scan, pixels, surface, {}, threads{});
///
/// In no umbrella: include it by name; the last line needs gnomon/segmentation/segment_image.hpp.
///
/// They are the pixels of a window around it, as far as these are on one surface: a jump in range
/// that neither the noise nor a steep surface explains ends the window (detail/image_links.hpp).
/// Where the noise would turn the normal of the window by more than `precision`, it is wider, as at
/// the far end of the range of a depth camera (detail/image_windows.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/image_links.hpp>
#include <gnomon/neighborhoods/detail/image_windows.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// Models `sweeping_neighborhood`, and sweeps over points that have no index, too. Neighbors come
/// in the order of their pixels. Rays are those from the view points, or else from the origin.
struct raster {
    std::size_t width = 0;                 ///< of the image [pixels]; 0: that of the range
    noise_curve noise = constant_noise{};  ///< along the rays
    std::size_t radius = 3;                ///< of a window [pixels], at least 1
    std::size_t max_radius = 16;           ///< to which windows grow [pixels]; if less, none grows
    /// The standard deviation of a normal that is enough: half of the angle at which
    /// `segment_surfaces` separates surfaces.
    angle precision = degrees(2.5);

    static constexpr bool needs_no_index = true;  ///< the pixels are the index

    /// The stored graph of the points of an image. O(n m) for windows of m pixels, in memory too.
    /// @throws std::invalid_argument  if the width is not known, or the number of points is not a
    ///                                multiple of it; if the radius is 0; if the precision is
    ///                                negative or NaN; or if the view points are for another number
    ///                                of points
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        const auto& team = detail::staying(run);
        return with_windows(points, team, std::move(projection), [&](const auto& windows) {
            return detail::collected_graph<false>(windows.links().part().size(), team,
                                                  [&](std::size_t i, auto& found) {
                                                      found.clear();
                                                      if (windows.links().has_return(i))
                                                          windows.neighbors_of(i).sort_into(found);
                                                      return neighborhood_note{};
                                                  });
        });
    }

    /// Replaces the content of `found` by the neighbors of the finite point i of an image.
    /// O(r^2) for the largest radius r.
    /// Errors: those of operator().
    template <class Allocator>
    void find(const spatial_index& index, std::size_t i,
              std::vector<neighbor, Allocator>& found) const {
        const detail::pixel_rectangle image = image_of(index);
        const std::size_t reach = largest_radius(), x = i % width, y = i / width;
        const std::size_t left = std::min(reach, x), above = std::min(reach, y);
        const detail::pixel_rectangle around{width, i - above * width - left,
                                             left + 1 + std::min(reach, width - 1 - x),
                                             above + 1 + std::min(reach, image.height - 1 - y)};
        const auto windows = windows_of(index, index.viewpoints, around, sequential{});
        windows.neighbors_of(above * around.width + left).sort_into(found);
    }

    /// Calls visit(i, found) for each finite point; see `sweeping_neighborhood`.
    /// Errors: those of operator().
    template <class R, execution X, class Proj = std::identity>
        requires point_range<R, Proj>
    void sweep(const R& points, const X& run, auto&& make_visitor, Proj projection = {}) const {
        with_windows(points, run, std::move(projection), [&](const auto& windows) {
            const std::size_t n = windows.links().part().size();
            detail::for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
                auto visit = make_visitor();
                for (std::size_t i = begin; i < end; ++i)
                    if (windows.links().has_return(i)) visit(i, windows.neighbors_of(i));
                if constexpr (requires { visit.finish(); }) visit.finish();
            });
        });
    }

    /// @throws std::invalid_argument  if the radius is 0, or the precision negative or NaN
    void require_valid() const {
        detail::require(radius > 0, "raster: radius must be at least 1");
        detail::require(precision >= radians(0), "raster: precision must not be negative or NaN");
    }

    /// The image of all points, row by row. A range that has a height, as those of PCL, is an image
    /// if that is more than 1.
    /// @throws std::invalid_argument  as operator()
    template <detail::indexed_range R>
    [[nodiscard]] detail::pixel_rectangle image_of(const R& points) const {
        require_valid();
        std::size_t columns = width;
        if constexpr (requires { points.width; })
            if (columns == 0) columns = width_of(points);
        detail::require(columns > 0, "raster: the width of the image is not known");
        const auto n = static_cast<std::size_t>(std::ranges::size(points));
        detail::require(n % columns == 0,
                        "raster: the number of points is not a multiple of the width");
        return {columns, 0, columns, n / columns};
    }

    /// The largest radius of a window, and the largest distance of linked pixels in it [pixels].
    [[nodiscard]] std::size_t largest_radius() const { return std::max(radius, max_radius); }

  private:
    [[nodiscard]] static std::size_t width_of(const auto& points) {
        if constexpr (requires { points.height; })
            if (points.height <= 1) return 0;
        return points.width;
    }

    /// (A template of numbers for compile time only.)
    template <class Number = double>
    [[nodiscard]] detail::image_windows<Number> windows_of(const auto& positions,
                                                           const viewpoint_table& viewpoints,
                                                           const detail::pixel_rectangle& part,
                                                           const auto& run) const {
        return detail::image_windows<Number>(positions, viewpoints, noise, part, radius,
                                             largest_radius(), precision.radians(), run);
    }

    /// f(windows) of all points.
    template <class R, class Proj>
    auto with_windows(const R& points, const auto& run, Proj projection, auto&& f) const {
        const position_view<R, Proj> p(points, std::move(projection));
        const detail::pixel_rectangle image = image_of(points);
        return detail::with_table_of(points, [&](const viewpoint_table& viewpoints) {
            return f(windows_of(p, viewpoints, image, run));
        });
    }
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// From segments to views: segments whose nearest points are at most a gap apart belong to one
/// object. Klasing 2010, Sec. 5.5.1.
///
///     const auto views = gnomon::recognition::views_of(scan, surface, parts, {.ground = floor});
///
/// If the scan shows one object only, `{.gap = infinite_gap}` makes one view of all segments.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/segmentation/euclidean_clusters.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// A gap by which all segments are one view.
inline constexpr double infinite_gap = std::numeric_limits<double>::infinity();

/// How segments are grouped. Klasing 2010, Sec. 5.5.1.
struct views_of_options {
    double gap = 0.10;          ///< largest distance of nearest points within a view [m]
    std::size_t min_parts = 2;  ///< views of fewer parts are dropped
    std::optional<plane> ground = std::nullopt;  ///< with its normal upwards
};

namespace detail {

/// Coordinates above the ground: height, and horizontal position about an origin.
class ground_frame {
  public:
    ground_frame(const plane& ground, const Eigen::Vector3d& origin)
        : ground_(ground), origin_(origin) {
        const Eigen::Vector3d& n = ground.normal;
        const Eigen::Vector3d other =
            std::abs(n[0]) < 0.5 ? Eigen::Vector3d(1.0, 0.0, 0.0) : Eigen::Vector3d(0.0, 1.0, 0.0);
        u_ = gnomon::detail::direction_of(gnomon::detail::cross(n, other));
        v_ = gnomon::detail::cross(n, u_);
    }

    void add_to(height_profile& profile, const Eigen::Vector3d& x) const {
        const Eigen::Vector3d d = gnomon::detail::difference(x, origin_);
        profile.add(ground_.signed_distance(x), gnomon::detail::dot(u_, d),
                    gnomon::detail::dot(v_, d));
    }

    /// Heights and profile of the points of a part.
    void describe(part& p, const auto& points, std::span<const point_index> members) const {
        p.lowest = std::numeric_limits<double>::infinity();
        p.highest = -p.lowest;
        for (const point_index i : members) {
            const Eigen::Vector3d x = points[i];
            if (!is_finite(x)) continue;
            const double height = ground_.signed_distance(x);
            p.lowest = std::min(p.lowest, height);
            p.highest = std::max(p.highest, height);
            add_to(p.profile, x);
        }
    }

  private:
    plane ground_;
    Eigen::Vector3d origin_, u_, v_;
};

/// The groups of segments whose nearest points are at most `gap` apart, as the smallest segment of
/// the group of each.
[[nodiscard]] inline gnomon::detail::union_find linked_segments(
    const auto& labeled, const segments& parts, std::span<const point_index> indices, double gap,
    const auto& run) {
    gnomon::detail::union_find groups(parts.size());
    if (!(gap < infinite_gap)) {
        for (std::size_t s = 1; s < parts.size(); ++s) groups.unite(0, static_cast<point_index>(s));
        return groups;
    }
    const segments clusters = euclidean_clusters(labeled, {.radius = gap, .min_points = 1}, run);
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const auto label = [&](point_index i) {
            return static_cast<point_index>(parts.labels()[indices[i]]);
        };
        for (const point_index i : clusters[c]) groups.unite(label(clusters[c].front()), label(i));
    }
    return groups;
}

}  // namespace detail

/// The views in a scan.
///
/// Two segments belong to one view if a chain of segments connects them whose nearest points are at
/// most `gap` apart. Points without a segment belong to the `rest` of a view if their nearest point
/// with a segment is in it, and at most `gap` away. Segments that are no surface, of points on a
/// line for example, count as such points.
///
/// @param points   any point range of n points [m], or the `spatial_index` of them
/// @param surface  n surface elements with normals, such as the result of `estimate_normals`
/// @param parts    segments of the n points
/// @param options  gap, least number of parts, and the ground, without which features that depend
///                 on heights are refused
/// @param run      `sequential{}` or `threads{n}`; the result does not depend on it
/// @return the views of at least `min_parts` parts, in the order of their largest segments
/// @throws std::invalid_argument  if points, surface and segments differ in number, the gap is
///                                negative or NaN, or the normal of the ground not of unit length
/// Complexity: O(n log n). Source: Klasing 2010, Sec. 5.5.1.
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<view> views_of(const R& points, const Surface& surface,
                                         const segments& parts,
                                         const views_of_options& options = {}, const X& run = {},
                                         Proj projection = {}) {
    using gnomon::detail::require;
    require(parts.labels().size() == std::ranges::size(points),
            "views_of: points and segments differ in number");
    require(options.gap >= 0.0, "views_of: the gap must not be negative");
    if (options.ground) gnomon::detail::require_hesse(*options.ground);
    const auto& team = gnomon::detail::staying(run);
    const auto shapes = segment_shapes(points, surface, parts, team, projection);

    std::vector<point_index> labeled, others;
    const position_view<R, Proj> position(points, projection);
    for (std::size_t i = 0; i < position.size(); ++i) {
        if (!is_finite(position[i])) continue;
        const std::int32_t label = parts.labels()[i];
        const bool has_part = label >= 0 && shapes[static_cast<std::size_t>(label)].is_surface();
        (has_part ? labeled : others).push_back(static_cast<point_index>(i));
    }
    if (labeled.empty()) return {};

    const spatial_index index(subset_view<R, Proj>(points, labeled, projection), team);
    auto groups = detail::linked_segments(index, parts, labeled, options.gap, team);

    std::vector<view> views;
    std::vector<std::optional<detail::ground_frame>> frames;
    std::vector<std::size_t> view_of_group(parts.size(), 0);
    for (std::size_t s = 0; s < parts.size(); ++s) {
        if (!shapes[s].is_surface()) continue;
        const point_index group = groups.find(static_cast<point_index>(s));
        std::size_t& number = view_of_group[group];
        if (number == 0) {
            views.push_back({.parts = {}, .ground = options.ground, .rest = {}});
            frames.emplace_back();
            if (options.ground) frames.back().emplace(*options.ground, shapes[s].frame.centroid);
            number = views.size();
        }
        part p;
        p.segment = static_cast<std::int32_t>(s);
        p.shape = shapes[s];
        if (const auto& frame = frames[number - 1]) frame->describe(p, position, parts[s]);
        views[number - 1].parts.push_back(std::move(p));
    }

    if (options.ground) {
        for (const point_index i : others) {
            const auto nearest = options.gap < infinite_gap
                                     ? index.nearest_within(position[i], 1, options.gap)
                                     : index.nearest(position[i], 1);
            if (nearest.empty()) continue;
            const auto label = parts.labels()[labeled[nearest.front().index]];
            const point_index group = groups.find(static_cast<point_index>(label));
            const std::size_t number = view_of_group[group] - 1;
            frames[number]->add_to(views[number].rest, position[i]);
        }
    }
    for (view& v : views) {
        std::stable_sort(v.parts.begin(), v.parts.end(), [](const part& a, const part& b) {
            return a.shape.points > b.shape.points;
        });
    }
    std::erase_if(views, [&](const view& v) { return v.parts.size() < options.min_parts; });
    return views;
}

}  // namespace gnomon::recognition

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Removes isolated points: those that are farther from their neighbors than most are from theirs
/// (`statistical_outliers`, Rusu et al. 2008), or that have too few neighbors within a radius
/// (`radius_outliers`). `complement` gives the points that were removed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/filters/detail/flagged.hpp>
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// Outliers by the mean distance d of a point from its k nearest neighbors: those with
/// d > mean + factor * deviation, where mean and standard deviation (of a sample, n - 1) are those
/// of d over all points (Rusu et al. 2008, Sec. 4.1, of whose two bounds this is the upper one, as
/// in PCL). One threshold for the whole cloud: where density falls with the range, as in a scan of
/// a room, a small factor removes distant surfaces.
struct statistical_outliers {
    std::size_t k = 20;   ///< neighbors, at least 1; chosen
    double factor = 2.0;  ///< standard deviations above the mean, not negative; chosen
};

/// Outliers by number: points with fewer than `min_neighbors` other points within `radius`, the
/// distance included.
struct radius_outliers {
    double radius = 0.05;           ///< [m], finite and not negative; chosen
    std::size_t min_neighbors = 5;  ///< without the point itself; chosen
};

namespace detail {

/// The greatest mean distance that is no outlier [m].
/// @param distances  of all points [m]; negative for points that do not count
[[nodiscard]] inline double outlier_threshold(std::span<const double> distances, double factor) {
    double sum = 0.0, squares = 0.0, n = 0.0;
    for (const double d : distances) {
        if (d < 0.0) continue;
        sum += d;
        n += 1.0;
    }
    const double mean = sum / n;
    for (const double d : distances)
        if (d >= 0.0) squares += (d - mean) * (d - mean);
    return mean + factor * std::sqrt(squares / std::max(n - 1.0, 1.0));
}

/// Sets `kept` of the points of the largest nodes that no ball is wider than, and that hold enough
/// points: each of them has the others within `radius`.
inline void keep_dense_nodes(const leaf_tree& tree, double radius, std::size_t min_neighbors,
                             scratch<std::uint8_t>& kept) {
    std::array<leaf_tree::subtree, 64>
        stack;  // as deep as the tree, which has fewer than 2^32 leaves
    std::size_t depth = 0;
    stack[depth++] = tree.root();
    while (depth > 0) {
        const leaf_tree::subtree node = stack[--depth];
        const std::size_t first = node.first * leaf_tree::leaf_size;
        const std::size_t last = std::min(node.last * leaf_tree::leaf_size, tree.size());
        if (last - first <= min_neighbors) continue;
        if (tree.box(node).squared_diagonal() <= radius * radius) {
            for (std::size_t place = first; place < last; ++place) kept[tree.index()[place]] = 1;
        } else if (!node.is_leaf()) {
            const auto [left, right] = node.children();
            stack[depth++] = right;
            stack[depth++] = left;
        }
    }
}

}  // namespace detail

/// The indices of the points that are no statistical outliers, ascending; see subset. Points that
/// are not finite are left out. In a cloud of n <= k finite points, neighbors are the n - 1 others.
///
/// @param points      any point range of n points [m], or an index of them
/// @param options     number of neighbors, and the factor
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the indices of the points to keep, for `subset`
/// @throws std::invalid_argument  if k is 0, or the factor is negative or NaN
/// Complexity: O(n (log n + k)). The same bytes for every execution.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> remove_outliers(const R& points,
                                                       const statistical_outliers& options,
                                                       const X& run = {}, Proj projection = {}) {
    detail::require(options.k > 0, "statistical_outliers: k must be at least 1");
    detail::require(options.factor >= 0.0,
                    "statistical_outliers: the factor must not be negative or NaN");
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    detail::scratch<double> distances(index.size(), -1.0);
    knn{.k = options.k}.sweep(index, team, [&] {
        return
            [&](std::size_t i, const auto& found) { distances[i] = found.summed().mean_distance; };
    });
    const double threshold = detail::outlier_threshold(distances, options.factor);
    std::vector<point_index> kept;
    for (std::size_t i = 0; i < distances.size(); ++i)
        if (distances[i] >= 0.0 && !(distances[i] > threshold))
            kept.push_back(static_cast<point_index>(i));
    return kept;
}

/// The indices of the points that have enough neighbors, ascending; see subset. Points that are not
/// finite are left out.
///
/// @param points      any point range of n points [m], or an index of them
/// @param options     the radius, and the least number of neighbors
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the indices of the points to keep, for `subset`
/// @throws std::invalid_argument  if the radius is negative, infinite or NaN
/// Complexity: O(n log n) plus the neighbors of points in boxes that are larger than the radius, or
/// hold fewer points. The same bytes for every execution.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> remove_outliers(const R& points,
                                                       const radius_outliers& options,
                                                       const X& run = {}, Proj projection = {}) {
    const double radius = options.radius;
    detail::require(radius >= 0.0 && std::isfinite(radius),
                    "radius_outliers: the radius must be finite and not negative");
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    const detail::leaf_tree& tree = index.tree();
    detail::scratch<std::uint8_t> kept(index.size(), 0);
    if (tree.size() == 0) return {};
    detail::keep_dense_nodes(tree, radius, options.min_neighbors, kept);
    // Points whose neighbors are not counted yet have a radius; to others nothing is compared.
    const auto radius_of = [&](std::size_t place) {
        return kept[tree.index()[place]] != 0 ? -1.0 : radius;
    };
    detail::search_all_groups(
        tree, team, [&](const auto& of) { return detail::leaf_balls(of, radius_of); },
        [&] {
            return [&](std::size_t place, std::span<const std::uint32_t> found) {
                if (found.size() >= options.min_neighbors) kept[tree.index()[place]] = 1;
            };
        });
    return detail::flagged(kept);
}

}  // namespace gnomon

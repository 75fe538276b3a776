// SPDX-License-Identifier: BSL-1.0
/// @file
/// The loop that Alg. 4.2, Alg. 4.1 with normals and the greedy variants share: step through the
/// points and join each with those neighbors within its search radius that a criterion accepts.
/// What joins is kept by union-find, so that segments are the connected components of the relation
/// "either point accepts the other", whatever the order (specification of Klasing 2010, Algs. 4.1
/// and 4.2). Where the radius alone decides, components_within.hpp looks at less.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The radius of a point that joins nothing, be it as near as it may.
inline constexpr double no_search = -1.0;

/// Joins points to segments. Points that are not finite stay unlabeled.
template <class Points>
class linker {
  public:
    explicit linker(const Points& points) : points_(points), sets_(points.size()) {}

    /// Joins every finite point i with each point j within radius_of(i) for which link(i, q) holds,
    /// q being the neighbor j with its squared distance. Where they are joined already, by whatever
    /// way, link is not asked.
    template <execution X>
    void link_all(auto&& radius_of, auto&& link, const X& run) {
        const auto& team = detail::staying(run);
        const leaf_tree tree(points_, team);
        const auto make_search = [&] { return leaf_balls(tree, std::cref(radius_of)); };
        const auto join = [&](std::size_t place, std::span<const std::uint32_t> places) {
            const point_index i = tree.index()[place];
            point_index root = sets_.find(i);
            for (const std::uint32_t at : places) {
                const point_index j = tree.index()[at];
                if (sets_.find(j) != root && link(i, neighbor{tree.squared_distance(place, at), j}))
                    root = sets_.unite(i, j);
            }
        };
        search_all_groups(tree, team, make_search, [&] { return join; });
    }

    /// The greedy variant (Alg. 4.1, line 2): passes over points that already have a segment. Its
    /// result depends on the order of the points, so it runs on one thread.
    void link_greedily(const kd_tree& tree, auto&& radius_of, auto&& link) {
        std::vector<bool> has_segment(points_.size(), false);
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Eigen::Vector3d p = points_[i];
            const double radius = has_segment[i] ? no_search : radius_of(i);
            if (!is_finite(p) || !(radius >= 0.0)) continue;
            tree.for_each_within(p, radius, [&](const neighbor& q) {
                if (q.index == i || !link(i, q)) return;
                has_segment[q.index] = true;
                sets_.unite(static_cast<point_index>(i), q.index);
            });
        }
    }

    /// The same relation over the neighbors that a graph lists.
    template <neighborhood_graph G, execution X>
    void link_listed(const G& graph, auto&& radius_of, auto&& link, const X& run) {
        for_each_chunk(run, points_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const double radius = radius_of(i);
                if (!(radius >= 0.0)) continue;
                const double limit = radius * radius;
                const Eigen::Vector3d p = points_[i];
                for (const point_index j : graph[i]) {
                    require(j < points_.size(), "the graph lists a neighbor of no point");
                    const neighbor q{squared_distance(p, points_[j]), j};
                    if (q.squared_distance <= limit && link(i, q)) {
                        sets_.unite(static_cast<point_index>(i), j);
                    }
                }
            }
        });
    }

    /// The segments of at least `min_points` points.
    [[nodiscard]] segments result(std::size_t min_points) {
        return segments_of(sets_, min_points, [&](std::size_t i) { return is_finite(points_[i]); });
    }

  private:
    const Points& points_;
    union_find sets_;
};

}  // namespace gnomon::detail

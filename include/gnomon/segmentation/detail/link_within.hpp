// SPDX-License-Identifier: BSL-1.0
/// @file
/// The loop that Alg. 4.2, Alg. 4.1 with normals and the greedy variants share: each point is
/// joined with those neighbors within its search radius that a criterion accepts, by union-find, so
/// that segments are the connected components of the relation "either point accepts the other",
/// whatever the order (Klasing 2010, Algs. 4.1 and 4.2). Where the radius alone decides,
/// components_within.hpp reads fewer pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The radius of a point that is not joined with any other, even at distance 0.
inline constexpr double no_search = -1.0;

/// Joins points to segments. Points that are not finite stay unlabeled.
template <class Points>
class linker {
  public:
    explicit linker(const Points& points) : points_(points), sets_(points.size()) {}

    /// Joins every finite point i with each point j within radius_of(i) for which link(i, q) holds,
    /// q being the neighbor j with its squared distance. Pairs that are joined already are not
    /// tested. Precondition: the points are an index.
    template <execution X>
    void link_all(auto&& radius_of, auto&& link, const X& run) {
        const leaf_tree& tree = points_.tree();
        const auto make_search = [&](const auto& of) {
            return leaf_balls(of,
                              [&](std::size_t place) { return radius_of(tree.index()[place]); });
        };
        const auto join = [&](std::size_t place, std::span<const std::uint32_t> places) {
            const point_index i = tree.index()[place];
            point_index root = sets_.find(i);
            for (const std::uint32_t at : places) {
                const point_index j = tree.index()[at];
                if (sets_.find(j) != root && link(i, neighbor{tree.squared_distance(place, at), j}))
                    root = sets_.unite(i, j);
            }
        };
        search_all_groups(tree, run, make_search, [&] { return join; });
    }

    /// The greedy variant (Alg. 4.1, line 2): passes over points that already have a segment. Its
    /// result depends on the order of the points, so it runs on one thread. Precondition: the
    /// points are an index.
    void link_greedily(auto&& radius_of, auto&& link) {
        std::vector<neighbor> found;
        std::vector<bool> has_segment(points_.size(), false);
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Eigen::Vector3d p = points_[i];
            const double radius = has_segment[i] ? no_search : radius_of(i);
            if (!is_finite(p) || !(radius >= 0.0)) continue;
            points_.within_into(found, p, radius);
            for (const neighbor& q : found) {
                if (q.index == i || !link(i, q)) continue;
                has_segment[q.index] = true;
                sets_.unite(static_cast<point_index>(i), q.index);
            }
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
                    const neighbor q{squared_distance(p, points_[j]), j};
                    if (q.squared_distance <= limit && link(i, q)) {
                        sets_.unite(static_cast<point_index>(i), j);
                    }
                }
            }
        });
    }

    /// The labels of the segments of at least `min_points` points.
    [[nodiscard]] scratch<std::int32_t> labels(std::size_t min_points) {
        return labels_of_sets(sets_, min_points,
                              [&](std::size_t i) { return is_finite(points_[i]); });
    }

  private:
    const Points& points_;
    union_find sets_;
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighbors for estimators along rays, such as `plane_eif`: the k points nearest to the piece of
/// the ray on which a point may truly lie, 4 standard deviations of the noise to either side. The
/// points nearest in space to a noisy point are those whose errors are alike: a plane along rays
/// through them leans with the errors, whatever k, and is more certain than it should be. These are
/// chosen by their directions instead, and by distances along the ray only beyond the noise. Where
/// they lie on one scan line, or on one side of it, the points of the next rays around it are added
/// (detail/across_lines.hpp), so that a surface is determined; some of these may be of another
/// surface, which `robust_ray_ls` finds.
///
/// For estimators in space, such as `plane_pca`, take `knn`: to these, such neighbors are blurred
/// by the noise. Without view points it is knn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/across_lines.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/leaf_distances.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/ray_metric.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// Models `sweeping_neighborhood`. Neighbors come in canonical order, nearest in space first.
struct ray_knn {
    std::size_t k = 30;                    ///< number of neighbors, at least 1
    noise_curve noise = constant_noise{};  ///< along the rays
    bool sees_across_lines = true;         ///< up to 16 neighbors more

    /// Whether it takes the rays into account: if view points are known. It is `knn` otherwise.
    [[nodiscard]] static bool knows_rays(const auto& points) {
        return detail::with_table_of(points, [](const auto& table) { return !table.empty(); });
    }

    /// The stored graph of points, or of an index of them. O(n (log n + k log k)) where the noise
    /// is no wider than the neighborhood, and proportional to the ratio of both where it is.
    /// @throws std::invalid_argument  if k is 0
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the neighbors of the finite point i. O(log n + k log k).
    /// @throws std::invalid_argument  if k is 0
    template <class Allocator>
    void find(const spatial_index& index, std::size_t i,
              std::vector<neighbor, Allocator>& found) const {
        require_valid();
        detail::search_tree(index.tree(), index[i], {.k = k, .except = static_cast<point_index>(i)},
                            found, detail::ray_metric_of(index, i, noise));
        for (neighbor& q : found) q.squared_distance = squared_distance(index[i], index[q.index]);
        if (looks_across(index))
            detail::add_across(index, static_cast<point_index>(i), found, detail::lacking::a_side);
        std::sort(found.begin(), found.end());
    }

    /// Calls visit(i, found) for each finite point; see `sweeping_neighborhood`.
    /// @throws std::invalid_argument  if k is 0
    template <execution X>
    void sweep(const spatial_index& index, const X& run, auto&& make_visitor) const {
        require_valid();
        detail::search_all_groups(
            index.tree(), run,
            [&](const auto& tree) {
                return detail::nearest_search(tree, {.k = k},
                                              detail::distances_from_rays(index, noise));
            },
            [&] { return visitor_of_places(*this, index, make_visitor()); });
    }

    /// @throws std::invalid_argument  if k is 0
    void require_valid() const { detail::require(k > 0, "ray_knn: k must be at least 1"); }

  private:
    [[nodiscard]] bool looks_across(const spatial_index& index) const {
        return sees_across_lines && !index.viewpoints.empty();
    }

    /// Shows a visitor what was found of places, with the neighbors across scan lines.
    template <class Index, class Visit>
    class visitor_of_places {
      public:
        visitor_of_places(const ray_knn& policy, const Index& index, Visit visit)
            : index_(index), show_(index.tree(), std::move(visit)) {
            if (policy.looks_across(index)) across_.emplace(index, detail::lacking::a_side);
        }

        void operator()(std::size_t place, std::span<const std::uint32_t> places) {
            if (across_) {
                all_.assign(places.begin(), places.end());
                across_->add_to(all_, index_.tree().index()[place]);
                places = all_;
            }
            show_(place, places);
        }

        void finish() { show_.finish(); }

      private:
        const Index& index_;
        detail::place_visitor<Visit> show_;
        std::optional<detail::across_lines<Index>> across_;
        detail::scratch<std::uint32_t> all_;  // places
    };
};

}  // namespace gnomon

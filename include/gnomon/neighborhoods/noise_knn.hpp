// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors within a few standard deviations of the noise: as wide as a normal
/// requires, and no wider, so that edges stay sharp where the sensor is precise. Where fewer points
/// are that near, the nearest few, however far; and where these lie on one scan line, the points of
/// the next rays around it as well, so that a surface is determined (detail/across_lines.hpp).
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
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/across_lines.hpp>
#include <gnomon/neighborhoods/detail/found_neighbors.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// Models `sweeping_neighborhood`. Neighbors come in canonical order, nearest first.
struct noise_knn {
    noise_curve noise = constant_noise{};  ///< along the rays
    std::size_t k = 30;                    ///< of the nearest neighbors, at least 1
    std::size_t fewest = 12;               ///< neighbors, where as many as that are not so near
    double deviations = 6.0;               ///< within this number of standard deviations
    bool sees_across_lines = true;         ///< if view points are known; up to 16 neighbors more

    /// The stored graph of points, or of an index of them. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is 0, or deviations are negative or NaN
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the neighbors of the finite point i. O(log n + k log k).
    /// Errors: those of operator().
    template <class Allocator>
    void find(const spatial_index& index, std::size_t i,
              std::vector<neighbor, Allocator>& found) const {
        require_valid();
        detail::search_tree(index.tree(), index[i], {.k = k, .except = static_cast<point_index>(i)},
                            found);
        const double within = squared_reach(index, i);
        const auto is_far = [within](const neighbor& q) { return !(q.squared_distance <= within); };
        const auto end = std::find_if(found.begin(), found.end(), is_far) - found.begin();
        found.resize(std::min(found.size(), std::max(static_cast<std::size_t>(end), fewest)));
        if (looks_across(index)) {
            detail::add_across(index, static_cast<point_index>(i), found);
            std::sort(found.begin(), found.end());
        }
    }

    /// Calls visit(i, found) for each finite point; see `sweeping_neighborhood`.
    /// @param make_visitor_of_all  likewise, for the k nearest neighbors, however far, and those
    ///                             across scan lines
    /// Errors: those of operator().
    template <execution X>
    void sweep(const spatial_index& index, const X& run, auto&& make_visitor,
               auto&& make_visitor_of_all) const {
        require_valid();
        detail::search_all_groups(
            index.tree(), run,
            [&](const auto& tree) { return detail::nearest_search(tree, {.k = k}); },
            [&] { return gate(*this, index, make_visitor(), make_visitor_of_all()); });
    }
    /// The same without visitors of all candidates.
    template <execution X>
    void sweep(const spatial_index& index, const X& run, auto&& make_visitor) const {
        sweep(index, run, make_visitor, [] { return [](std::size_t, const auto&) {}; });
    }

    /// @throws std::invalid_argument  if k is 0, or deviations are negative or NaN
    void require_valid() const {
        detail::require(k > 0, "noise_knn: k must be at least 1");
        detail::require(deviations >= 0.0, "noise_knn: deviations must not be negative or NaN");
    }

  private:
    [[nodiscard]] bool looks_across(const spatial_index& index) const {
        return sees_across_lines && !index.viewpoints.empty();
    }

    /// The square of the distance [m^2] within which point i has its neighbors.
    [[nodiscard]] double squared_reach(const spatial_index& index, std::size_t i) const {
        const Eigen::Vector3d ray = detail::difference(index[i], index.viewpoints[i]);
        return deviations * deviations * noise.variance_along(ray);
    }

    /// Shows a visitor those of the k nearest that are near enough, and another one all; both also
    /// those across scan lines.
    template <class Index, class Visit, class VisitAll>
    class gate {
      public:
        gate(const noise_knn& policy, const Index& index, Visit visit, VisitAll visit_all)
            : policy_(policy),
              index_(index),
              visit_(std::move(visit)),
              visit_all_(std::move(visit_all)) {
            if (policy.looks_across(index)) across_.emplace(index);
        }

        void operator()(std::size_t place, std::span<const std::uint32_t> places) {
            const detail::leaf_tree& tree = index_.tree();
            const point_index i = tree.index()[place];
            const double within = policy_.squared_reach(index_, i);
            near_.assign(places.begin(), places.end());
            const auto key = [&](std::uint32_t at) {
                return neighbor{tree.squared_distance(place, at), tree.index()[at]};
            };
            auto end = std::partition(near_.begin(), near_.end(), [&](std::uint32_t at) {
                return tree.squared_distance(place, at) <= within;
            });
            const std::size_t least = std::min(policy_.fewest, near_.size());
            if (static_cast<std::size_t>(end - near_.begin()) < least) {
                end = near_.begin() + static_cast<std::ptrdiff_t>(least);
                std::partial_sort(near_.begin(), end, near_.end(),
                                  [&](auto a, auto b) { return key(a) < key(b); });
            }
            near_.resize(static_cast<std::size_t>(end - near_.begin()));
            if (across_) {
                all_.assign(places.begin(), places.end());
                for (const point_index j : across_->add_to(near_, i)) across_->add_once(j, i, all_);
            }
            visit_all_(i,
                       detail::found_neighbors(
                           tree, place, across_ ? std::span<const std::uint32_t>(all_) : places));
            visit_(i, detail::found_neighbors(tree, place, near_));
        }

        void finish() {
            if constexpr (requires { visit_.finish(); }) visit_.finish();
            if constexpr (requires { visit_all_.finish(); }) visit_all_.finish();
        }

      private:
        const noise_knn& policy_;
        const Index& index_;
        Visit visit_;
        VisitAll visit_all_;
        std::optional<detail::across_lines<Index>> across_;
        detail::scratch<std::uint32_t> near_, all_;  // places
    };
};

}  // namespace gnomon

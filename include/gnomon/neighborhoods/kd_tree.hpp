// SPDX-License-Identifier: BSL-1.0
/// @file
/// A kd-tree over the finite points of a range: exact nearest-neighbor and fixed-radius queries
/// whose answers are unique, because ties are broken by the index (Klasing 2010, App. A.1).
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/detail/nanoflann.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// An index over points. Keeps a copy of the finite ones (about 40 bytes each), so the range may
/// go. Points that coincide are one place in it, however many. Queries are const and thread-safe.
class kd_tree {
  public:
    /// A number that no point has.
    static constexpr std::size_t no_point = std::numeric_limits<std::size_t>::max();

    /// Indexes all finite points of the range. O(n log n).
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    explicit kd_tree(const R& points, Proj projection = {})
        : places_(std::make_unique<detail::nanoflann_places>(
              position_view<R, Proj>(points, std::move(projection)))) {
        constexpr std::size_t leaf_size = 12;  // fastest of 8 to 32 for k = 20 to 50
        tree_ = std::make_unique<detail::nanoflann_tree>(
            3, *places_, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
        tree_->buildIndex();
    }

    /// The number of finite points.
    [[nodiscard]] std::size_t size() const { return places_->points(); }

    /// Replaces the content of `found` by the k points nearest to `p`, point number `except` left
    /// out (`no_point` for none), in canonical order; fewer if there are no more, and up to twice
    /// as many if the rule asks for all ties. O(log n + k log k) on average. Precondition: p is
    /// finite.
    void nearest(const Eigen::Vector3d& p, std::size_t k, std::size_t except,
                 std::vector<neighbor>& found, tie_rule rule = tie_rule::by_index) const {
        found.clear();
        k = std::min(k, size());
        if (k == 0) return;
        // One more than asked for: `except` may be among them.
        detail::nearest_result_set results(*places_, k + 1, rule, found);
        find(p, results);
        results.finish();
        std::erase_if(found, [except](const neighbor& q) { return q.index == except; });
        detail::keep_nearest(found, k, rule);
    }

    /// Calls visit(neighbor) for each point at most `radius` [m] from `p`, the point at p itself
    /// included, in no particular order. Precondition: p is finite.
    template <std::invocable<neighbor> Visitor>
    void for_each_within(const Eigen::Vector3d& p, double radius, Visitor&& visit) const {
        const auto visit_place = [&](double squared_distance, point_index place) {
            for (const point_index i : places_->at(place)) visit(neighbor{squared_distance, i});
        };
        detail::ball_result_set results(radius * radius, visit_place);
        find(p, results);
    }

  private:
    template <class ResultSet>
    void find(const Eigen::Vector3d& p, ResultSet& results) const {
        if (size() > 0) tree_->findNeighbors(results, p.data(), detail::nanoflann_parameters());
    }

    std::unique_ptr<detail::nanoflann_places> places_;  // the tree refers to it
    std::unique_ptr<detail::nanoflann_tree> tree_;
};

}  // namespace gnomon

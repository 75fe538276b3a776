// SPDX-License-Identifier: BSL-1.0
/// @file
/// The queries at a position: the same members for an index and for a subset of it.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/metric.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/search_options.hpp>

namespace gnomon::detail {

/// The base of `spatial_index` and `indexed_subset`, which provide the tree, and the set
/// of places to search.
template <class Index>
class index_queries {
  public:
    /// The k points nearest to `p` [m], nearest first; fewer if there are no more. A point at p
    /// itself is found. O(log n + k log k) on average for the Euclidean distance.
    /// @throws std::invalid_argument  if p is not finite, epsilon is negative or NaN, or the
    ///                                order of the metric is below 1
    [[nodiscard]] std::vector<neighbor> nearest(const Eigen::Vector3d& p, std::size_t k,
                                                const search_options& options = {}) const {
        std::vector<neighbor> found;
        nearest_into(found, p, k, options);
        return found;
    }

    /// All points at most `radius` [m] from `p`, nearest first. O(log n + m log m) for m found.
    /// @throws std::invalid_argument  also if the radius is negative or NaN
    [[nodiscard]] std::vector<neighbor> within(const Eigen::Vector3d& p, double radius,
                                               const search_options& options = {}) const {
        std::vector<neighbor> found;
        within_into(found, p, radius, options);
        return found;
    }

    /// The k points nearest to `p` of those at most `radius` [m] away, nearest first.
    /// O(log n + m log m) for m found.
    /// @throws std::invalid_argument  also if the radius is negative or NaN
    [[nodiscard]] std::vector<neighbor> nearest_within(const Eigen::Vector3d& p, std::size_t k,
                                                       double radius,
                                                       const search_options& options = {}) const {
        std::vector<neighbor> found;
        nearest_within_into(found, p, k, radius, options);
        return found;
    }

    /// nearest(), in the memory of `found`. Errors and complexity: those of nearest().
    void nearest_into(std::vector<neighbor>& found, const Eigen::Vector3d& p, std::size_t k,
                      const search_options& options = {}) const {
        search({.k = k}, found, p, options);
    }
    /// within(), in the memory of `found`. Errors and complexity: those of within().
    void within_into(std::vector<neighbor>& found, const Eigen::Vector3d& p, double radius,
                     const search_options& options = {}) const {
        search({.squared_radius = squared(radius)}, found, p, options);
    }
    /// nearest_within(), in the memory of `found`. Errors and complexity: those of
    /// nearest_within().
    void nearest_within_into(std::vector<neighbor>& found, const Eigen::Vector3d& p, std::size_t k,
                             double radius, const search_options& options = {}) const {
        search({.k = k, .squared_radius = squared(radius)}, found, p, options);
    }

  private:
    static double squared(double radius) {
        require(radius >= 0.0, "spatial_index: the radius must not be negative or NaN");
        return radius * radius;
    }

    void search(tree_question question, std::vector<neighbor>& found, const Eigen::Vector3d& p,
                const search_options& options) const {
        require(is_finite(p), "spatial_index: the position must be finite");
        require(options.epsilon >= 0.0, "spatial_index: epsilon must not be negative or NaN");
        require_valid(options.metric);
        const auto& self = static_cast<const Index&>(*this);
        question.ties = options.ties;
        question.epsilon = options.epsilon;
        question.among = self.places();
        if (options.metric == metric::euclidean())
            search_tree(self.tree(), p, question, found);
        else
            search_tree(self.tree(), p, question, found, options.metric);
    }
};

}  // namespace gnomon::detail

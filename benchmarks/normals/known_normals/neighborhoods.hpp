// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighbors of the first points of a cloud, searched once for all k.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace known_normals {

/// The `most` nearest of each of the first `tests` points, nearest first. Precondition: the cloud
/// has more points than that.
class nearest_of_tests {
  public:
    nearest_of_tests(const std::vector<Eigen::Vector3d>& points, std::size_t tests,
                     std::size_t most)
        : points_(points.size()), tests_(tests), most_(most) {
        const gnomon::spatial_index index(points);
        std::vector<gnomon::neighbor> found;
        for (std::size_t i = 0; i < tests; ++i) {
            gnomon::knn{.k = most}.find(index, i, found);
            for (const gnomon::neighbor& q : found) indices_.push_back(q.index);
        }
    }

    /// The k nearest of test point i, k <= most.
    [[nodiscard]] std::span<const gnomon::point_index> neighbors(std::size_t i,
                                                                 std::size_t k) const {
        return {indices_.data() + i * most_, k};
    }

    [[nodiscard]] std::size_t points() const { return points_; }
    [[nodiscard]] std::size_t tests() const { return tests_; }

  private:
    std::size_t points_;
    std::size_t tests_;
    std::size_t most_;
    std::vector<gnomon::point_index> indices_;
};

/// Models `neighborhood_graph`: k neighbors for a test point, none for the others.
struct first_k {
    const nearest_of_tests* nearest;
    std::size_t k;

    [[nodiscard]] std::size_t size() const { return nearest->points(); }
    [[nodiscard]] std::span<const gnomon::point_index> operator[](std::size_t i) const {
        if (i >= nearest->tests()) return {};
        return nearest->neighbors(i, k);
    }
};

}  // namespace known_normals

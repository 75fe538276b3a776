// SPDX-License-Identifier: BSL-1.0
/// @file
/// Groups of samples of which only distances are known, by average linkage (Sokal and Michener
/// 1958): the two groups of least mean distance become one, as long as there are such within a
/// limit. The number of groups need not be known.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::recognition {

namespace detail {

/// Merges groups along chains of nearest neighbors (Murtagh 1983): from a group to its nearest one,
/// and so on, until two are the nearest of each other. They may be merged at once, whatever the
/// rest is, as no group comes nearer to another one by a union.
class linkage_chain {
  public:
    linkage_chain(std::size_t n, auto&& distance)
        : sizes_(n, 1.0), group_of_(n), distances_(n * n, 0.0) {
        std::iota(group_of_.begin(), group_of_.end(), std::size_t{0});
        left_ = group_of_;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const double d = distance(i, j);
                gnomon::detail::require(std::isfinite(d),
                                        "average_linkage: a distance is not finite");
                at(i, j) = at(j, i) = d;
            }
        }
    }

    void merge_within(double limit) {
        std::vector<std::size_t> chain;
        while (left_.size() > 1) {
            if (chain.empty()) chain.push_back(left_.front());
            const std::size_t last = chain.back();
            const std::size_t before = chain.size() > 1 ? chain[chain.size() - 2] : last;
            const std::size_t next = nearest_of(last, before);
            if (next != before) {
                chain.push_back(next);
                continue;
            }
            chain.resize(chain.size() - 2);
            if (at(last, next) <= limit) {
                merge(last, next);
            } else {  // then neither is ever within the limit of another one
                std::erase(left_, last);
                std::erase(left_, next);
            }
        }
    }

    /// The number of the group of each sample, in the order of their first samples.
    [[nodiscard]] std::vector<std::size_t> groups() const {
        std::vector<std::size_t> numbers(group_of_.size(), group_of_.size()), result;
        std::size_t count = 0;
        for (const std::size_t g : group_of_) {
            if (numbers[g] == group_of_.size()) numbers[g] = count++;
            result.push_back(numbers[g]);
        }
        return result;
    }

  private:
    double& at(std::size_t i, std::size_t j) { return distances_[i * sizes_.size() + j]; }

    /// Of equally near groups `preferred`, or else the first.
    [[nodiscard]] std::size_t nearest_of(std::size_t i, std::size_t preferred) {
        std::size_t nearest = preferred;
        for (const std::size_t j : left_)
            if (j != i && (nearest == i || at(i, j) < at(i, nearest))) nearest = j;
        return nearest;
    }

    void merge(std::size_t into, std::size_t from) {
        const double all = sizes_[into] + sizes_[from];
        for (const std::size_t k : left_) {
            const double a = at(into, k), b = at(from, k);
            const double mean = (sizes_[into] * a + sizes_[from] * b) / all;
            at(into, k) = at(k, into) = std::max(mean, std::min(a, b));  // also when rounded
        }
        sizes_[into] = all;
        for (std::size_t& g : group_of_)
            if (g == from) g = into;
        std::erase(left_, from);
    }

    std::vector<double> sizes_;
    std::vector<std::size_t> group_of_, left_;  // of each sample; groups that may still be merged
    std::vector<double> distances_;             // means over all pairs of two groups
};

}  // namespace detail

/// Groups n samples.
/// @param distance      (i, j) is the distance of two samples: finite and symmetric
/// @param max_distance  mean distance of two groups up to which they become one
/// @return the number of the group of each sample; groups are numbered by their first samples
/// @throws std::invalid_argument  if a distance is not finite
/// Complexity: O(n^2), and as much memory.
[[nodiscard]] std::vector<std::size_t> average_linkage(std::size_t n, auto&& distance,
                                                       double max_distance) {
    detail::linkage_chain chain(n, distance);
    chain.merge_within(max_distance);
    return chain.groups();
}

}  // namespace gnomon::recognition

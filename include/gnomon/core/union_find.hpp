// SPDX-License-Identifier: BSL-1.0
/// @file
/// Disjoint sets under union, safe to use from many threads at once. The root of a set is its
/// smallest element, whatever the order of the unions, so that results never depend on threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include <gnomon/core/point.hpp>

namespace gnomon {

/// The partition of {0, ..., n-1} into singletons, coarsened by `unite`. Lock-free by compare and
/// swap on the larger root (Anderson and Woll 1991; Jaiganesh and Burtscher 2018).
class union_find {
  public:
    /// n singletons.
    explicit union_find(std::size_t n) : parent_(n) {
        for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<point_index>(i);
    }

    [[nodiscard]] std::size_t size() const { return parent_.size(); }

    /// The smallest element of the set of i, once no other thread unites. O(log n) amortised.
    point_index find(point_index i) {
        // Path halving: whatever is stored is an ancestor, so a lost race costs a step, no more.
        for (point_index p = load(i); p != i; p = load(i)) {
            const point_index grandparent = load(p);
            if (grandparent != p) at(i).store(grandparent, std::memory_order_relaxed);
            i = grandparent;
        }
        return i;
    }

    /// Makes one set of those of i and j.
    /// @return its smallest element, once no other thread unites
    point_index unite(point_index i, point_index j) {
        for (;;) {
            i = find(i);
            j = find(j);
            if (i == j) return i;
            if (i > j) std::swap(i, j);
            point_index expected = j;
            if (at(j).compare_exchange_strong(expected, i, std::memory_order_relaxed)) return i;
        }
    }

  private:
    std::atomic_ref<point_index> at(point_index i) { return std::atomic_ref(parent_[i]); }
    point_index load(point_index i) { return at(i).load(std::memory_order_relaxed); }

    std::vector<point_index> parent_;
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Disjoint sets under union, safe for concurrent use. The root of a set is its smallest element,
/// whatever the order of the unions, so results never depend on the number of threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// A partition of {0, ..., n-1} into singletons, coarsened by `unite`.
///
/// Lock-free: a union is one compare-and-swap on the larger root (Anderson and Woll 1991;
/// Jaiganesh and Burtscher 2018). All accesses are relaxed, since nothing but the parents
/// themselves is shared. Can be moved; one that was moved from can be destroyed or reset.
/// n indices of memory.
class union_find {
  public:
    /// n singletons. O(n).
    explicit union_find(std::size_t n = 0) { reset(n); }

    /// Makes n singletons again, in the memory of the largest n so far. O(n). Not concurrently.
    void reset(std::size_t n) {
        if (n > parents_.size()) parents_ = scratch<parent>(n);
        size_ = n;
        for (std::size_t i = 0; i < n; ++i) {
            parents_[i].store(static_cast<point_index>(i), std::memory_order_relaxed);
        }
    }

    /// The number n of elements.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Whether no elements are united. O(n).
    [[nodiscard]] bool is_of_singletons() const {
        for (std::size_t i = 0; i < size_; ++i)
            if (load(static_cast<point_index>(i)) != i) return false;
        return true;
    }

    /// Returns the smallest element of the set of i; while other threads unite, some element of
    /// that set. O(log n) amortised. Precondition: i < n.
    point_index find(point_index i) {
        // Path halving: every stored value is an ancestor, so a lost race costs one step more.
        for (point_index p = load(i); p != i; p = load(i)) {
            const point_index grandparent = load(p);
            if (grandparent != p) parents_[i].store(grandparent, std::memory_order_relaxed);
            i = grandparent;
        }
        return i;
    }

    /// Merges the sets of i and j. O(log n) amortised. Precondition: i < n and j < n.
    /// @return the smallest element of the union; while other threads unite, some element of it
    point_index unite(point_index i, point_index j) {
        for (;;) {
            i = find(i);
            j = find(j);
            if (i == j) return i;
            if (i > j) std::swap(i, j);
            point_index expected = j;
            if (parents_[j].compare_exchange_strong(expected, i, std::memory_order_relaxed)) {
                return i;
            }
        }
    }

    /// Merges the sets of elements that are in one set of another, of n elements or fewer. O(n log
    /// n) amortised.
    void unite_as(union_find& other) {
        for (std::size_t i = 0; i < other.size(); ++i) {
            const auto element = static_cast<point_index>(i);
            unite(element, other.find(element));
        }
    }

  private:
    using parent = std::atomic<point_index>;

    [[nodiscard]] point_index load(point_index i) const {
        return parents_[i].load(std::memory_order_relaxed);
    }

    scratch<parent> parents_;  // at least size_; a root is its own parent
    std::size_t size_ = 0;
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The finite points of a cloud with their numbers: what a tree sorts while it is built.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/kept_array.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// A point and its number in the cloud.
struct tree_entry {
    std::array<double, 3> at;  // [m]
    point_index index;
};

/// The entries of all finite points, in the order of the cloud.
class finite_entries {
  public:
    /// Copies the finite points of a position_view, in two passes: one counts, one copies. O(n).
    template <class Points, execution X>
    void gather(const Points& points, const X& run) {
        ends_.resize(chunk_count(points.size()), run);
        for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
            point_index count = 0;
            for (std::size_t i = begin; i < end; ++i) count += is_finite(points[i]) ? 1 : 0;
            ends_[begin / chunk_size] = count;
        });
        for (std::size_t c = 1; c < ends_.size(); ++c) ends_[c] += ends_[c - 1];
        entries_.resize(ends_.size() > 0 ? ends_[ends_.size() - 1] : 0, run);
        for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
            tree_entry* to = entries_.data() + (begin == 0 ? 0 : ends_[begin / chunk_size - 1]);
            for (std::size_t i = begin; i < end; ++i) {
                const Eigen::Vector3d p = points[i];
                if (is_finite(p)) *to++ = {{p[0], p[1], p[2]}, static_cast<point_index>(i)};
            }
        });
    }

    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    [[nodiscard]] std::span<tree_entry> all() { return {entries_.data(), entries_.size()}; }
    void release() { *this = {}; }

  private:
    kept_array<tree_entry> entries_;
    kept_array<point_index> ends_;  // of each chunk of the cloud in `entries_`
};

/// Sorts entries at one position by their index, so that a search for the k nearest stops after k
/// of them. (As neighbors, whose sort a query needs as well: for compile time only.)
void sort_by_index(auto entries) {
    scratch<neighbor> sorted(entries.size());
    for (std::size_t l = 0; l < sorted.size(); ++l) sorted[l].index = entries[l].index;
    if (std::is_sorted(sorted.data(), sorted.data() + sorted.size())) return;
    std::sort(sorted.data(), sorted.data() + sorted.size());
    for (std::size_t l = 0; l < sorted.size(); ++l) entries[l].index = sorted[l].index;
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The neighbors that a sweep found for one point, by their places in the tree: their moments and
/// mean distance, in one pass over vectors of neighbors that stores nothing, and, on request, the
/// neighbors in canonical order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/neighbor_order.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Sums over the neighbors of a point.
struct neighborhood_sums {
    moments about_point;
    double mean_distance = 0.0;  // from it [m]; 0 if there are none
};

/// A view of the neighbors of one point, in no particular order; valid until the search goes on to
/// the next point. (A template, so that only users of a search compile it.)
template <class Tree>
class found_neighbors {
  public:
    /// The points at `places` of the tree, seen from that at `from`.
    found_neighbors(const Tree& tree, std::size_t from, std::span<const std::uint32_t> places)
        : tree_(tree), from_(from), places_(places) {}

    [[nodiscard]] std::size_t size() const { return places_.size(); }

    /// The moments [m], [m^2] of the neighbors about the point, and their mean distance. O(k).
    [[nodiscard]] neighborhood_sums summed() const {
        vector_sums all;
        const std::size_t whole = size() / slim_pack::size * slim_pack::size;
        for (std::size_t j = 0; j < whole; j += slim_pack::size) add(all, places_.data() + j);
        if (whole < size()) {
            std::array<std::uint32_t, slim_pack::size> last;
            last.fill(static_cast<std::uint32_t>(from_));  // adds zeros
            std::copy(places_.begin() + static_cast<std::ptrdiff_t>(whole), places_.end(),
                      last.begin());
            add(all, last.data());
        }
        neighborhood_sums r;
        r.about_point.count = size();
        r.about_point.sum = {all.x.sum(), all.y.sum(), all.z.sum()};
        r.about_point.outer(0, 0) = all.xx.sum();
        r.about_point.outer(1, 0) = all.xy.sum();
        r.about_point.outer(2, 0) = all.xz.sum();
        r.about_point.outer(1, 1) = all.yy.sum();
        r.about_point.outer(2, 1) = all.yz.sum();
        r.about_point.outer(2, 2) = all.zz.sum();
        if (size() > 0) r.mean_distance = all.distance.sum() / static_cast<double>(size());
        return r;
    }

    /// Replaces the content of `sorted` by the neighbors in canonical order. O(k log k), for few
    /// neighbors O(k log^2 k).
    template <class Allocator>
    void sort_into(std::vector<neighbor, Allocator>& sorted) const {
        sorted.resize(size());
        if (size() <= order::most) {
            in_order([&](std::size_t rank, const neighbor& q) { sorted[rank] = q; });
        } else {
            for (std::size_t j = 0; j < size(); ++j) sorted[j] = at(j);
            std::sort(sorted.begin(), sorted.end());
        }
    }

    /// Writes the indices of the neighbors in canonical order; `buffer` is memory for the sorting
    /// of many neighbors. As long as sort_into(sorted).
    template <class Allocator>
    void sort_into(point_index* indices, std::vector<neighbor, Allocator>& buffer) const {
        if (size() <= order::most) {
            in_order([&](std::size_t rank, const neighbor& q) { indices[rank] = q.index; });
        } else {
            sort_into(buffer);
            for (const neighbor& q : buffer) *indices++ = q.index;
        }
    }

  private:
    using order = neighbor_order<>;

    struct vector_sums {
        slim_pack x = 0.0, y = 0.0, z = 0.0;
        slim_pack xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
        slim_pack distance = 0.0;
    };

    /// Adds as many neighbors as a vector has numbers.
    [[GNOMON_ALWAYS_INLINE]] void add(vector_sums& all, const std::uint32_t* places) const {
        const slim_pack x = slim_pack(tree_.at(0), places) - tree_.at(0)[from_];
        const slim_pack y = slim_pack(tree_.at(1), places) - tree_.at(1)[from_];
        const slim_pack z = slim_pack(tree_.at(2), places) - tree_.at(2)[from_];
        const slim_pack xx = x * x, yy = y * y, zz = z * z;
        all.x += x;
        all.y += y;
        all.z += z;
        all.xx += xx;
        all.xy += x * y;
        all.xz += x * z;
        all.yy += yy;
        all.yz += y * z;
        all.zz += zz;
        all.distance += root(xx + yy + zz);
    }

    [[nodiscard]] neighbor at(std::size_t j) const {
        return {tree_.squared_distance(from_, places_[j]), tree_.index()[places_[j]]};
    }

    /// Calls write(rank, neighbor) for all neighbors.
    /// Precondition: there are at most order::most.
    void in_order(auto&& write) const {
        std::array<double, order::most> squared;
        for (std::size_t j = 0; j < size(); ++j)
            squared[j] = tree_.squared_distance(from_, places_[j]);
        const auto index_of = [&](std::size_t j) { return tree_.index()[places_[j]]; };
        const order sorted({squared.data(), size()}, index_of);
        for (std::size_t rank = 0; rank < size(); ++rank)
            write(rank, neighbor{squared[sorted[rank]], index_of(sorted[rank])});
    }

    const Tree& tree_;
    std::size_t from_;
    std::span<const std::uint32_t> places_;
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

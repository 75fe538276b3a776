// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a sweep has found of one point: where its neighbors lie in the tree. From there come their
/// moments and mean distance, in one pass over vectors of neighbors that stores nothing, and the
/// ring in canonical order if somebody asks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Sums over the neighbors of a point.
struct ring_sums {
    moments about_point;
    double mean_distance = 0.0;  // from it [m]; 0 if there are none
};

/// A view of the neighbors of one point, in no particular order, until the search goes on to the
/// next. (A template, so that only who searches compiles it.)
template <class Tree>
class found_neighbors {
  public:
    /// The points at `places` of the tree, seen from that at `from`.
    found_neighbors(const Tree& tree, std::size_t from, std::span<const std::uint32_t> places)
        : tree_(tree), from_(from), places_(places) {}

    [[nodiscard]] std::size_t size() const { return places_.size(); }

    /// Their moments [m], [m^2] about the point, and how far they are on average. O(k).
    [[nodiscard]] ring_sums summed() const {
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
        ring_sums r;
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

    /// Replaces the content of `ring` by them in canonical order. O(k log k), of a few O(k^2).
    void sort_into(std::vector<neighbor>& ring) const {
        ring.resize(size());
        if (size() <= few) {
            rank_into(ring);
        } else {
            for (std::size_t j = 0; j < size(); ++j) ring[j] = at(j);
            std::sort(ring.begin(), ring.end());
        }
    }

  private:
    /// Beyond so many, comparing all with all takes longer than sorting.
    static constexpr std::size_t few = 128;

    struct vector_sums {
        slim_pack x = 0.0, y = 0.0, z = 0.0;
        slim_pack xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
        slim_pack distance = 0.0;
    };

    /// As many neighbors as a vector has numbers.
    [[gnu::always_inline]] void add(vector_sums& all, const std::uint32_t* places) const {
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

    /// Puts each where as many are nearer, for which all are compared with all, eight at a time;
    /// then sets ties right.
    void rank_into(std::vector<neighbor>& ring) const {
        std::array<double, few> squared;  // distances
        for (std::size_t j = 0; j < size(); ++j)
            squared[j] = tree_.squared_distance(from_, places_[j]);
        const std::size_t filled = (size() + pack::size - 1) / pack::size * pack::size;
        const std::size_t not_there = filled - size();  // zeros, as near as anything
        std::fill_n(squared.data() + size(), not_there, 0.0);
        std::array<std::uint8_t, few> ties{};  // found up to now, by their last place
        for (std::size_t j = 0; j < size(); ++j) {
            const pack d2(squared[j]);
            pack not_farther(0.0);
            for (std::size_t i = 0; i < filled; i += pack::size)
                not_farther += where_at_least(d2, pack(squared.data() + i), 1.0, 0.0);
            const auto last = static_cast<std::size_t>(not_farther.sum()) - not_there - 1;
            ring[last - ties[last]++] = {squared[j], tree_.index()[places_[j]]};
        }
        for (std::size_t last = 0; last < size(); ++last) {
            const auto end = ring.begin() + static_cast<std::ptrdiff_t>(last) + 1;
            if (ties[last] > 1) std::sort(end - ties[last], end);
        }
    }

    const Tree& tree_;
    std::size_t from_;
    std::span<const std::uint32_t> places_;
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

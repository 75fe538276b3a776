// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a sweep has found of one point: its neighbors as arrays, from which moments and mean
/// distance come eight neighbors at a time, and the ring in canonical order if somebody asks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// The neighbors of one point, in no particular order. All arrays are filled up to whole packs: the
/// offsets with zeros.
class found_neighbors {
  public:
    [[nodiscard]] std::size_t size() const { return count_; }
    /// Coordinate `axis` of their offsets from the point [m].
    [[nodiscard]] const double* offset(std::size_t axis) const {
        return numbers_.data() + axis * capacity_;
    }
    /// Canonical squared distances [m^2].
    [[nodiscard]] const double* squared_distance() const { return offset(3); }
    [[nodiscard]] const point_index* index() const { return index_.data(); }

    /// Of them about the point.
    [[nodiscard]] moments moments_about_point() const {
        pack x_sum(0.0), y_sum(0.0), z_sum(0.0);
        pack xx(0.0), xy(0.0), xz(0.0), yy(0.0), yz(0.0), zz(0.0);
        for (std::size_t j = 0; j < filled(); j += pack::size) {
            const pack x(offset(0) + j), y(offset(1) + j), z(offset(2) + j);
            x_sum += x;
            y_sum += y;
            z_sum += z;
            xx += x * x;
            xy += x * y;
            xz += x * z;
            yy += y * y;
            yz += y * z;
            zz += z * z;
        }
        moments m;
        m.count = count_;
        m.sum = {x_sum.sum(), y_sum.sum(), z_sum.sum()};
        m.outer(0, 0) = xx.sum();
        m.outer(1, 0) = xy.sum();
        m.outer(2, 0) = xz.sum();
        m.outer(1, 1) = yy.sum();
        m.outer(2, 1) = yz.sum();
        m.outer(2, 2) = zz.sum();
        return m;
    }

    /// The mean distance from the point [m]; 0 if there are none.
    [[nodiscard]] double mean_distance() const {
        if (count_ == 0) return 0.0;
        pack sum(0.0);
        for (std::size_t j = 0; j < filled(); j += pack::size)
            sum += root(pack(squared_distance() + j));
        return sum.sum() / static_cast<double>(count_);
    }

    /// Replaces the content of `ring` by them in canonical order.
    void sort_into(std::vector<neighbor>& ring) const {
        ring.resize(count_);
        if (count_ <= few) {
            rank_into(ring);
        } else {
            for (std::size_t j = 0; j < count_; ++j) ring[j] = at(j);
            std::sort(ring.begin(), ring.end());
        }
    }

    /// Replaces them by the points at the given places of the tree, seen from that at `from`.
    void look_up(const leaf_tree& tree, std::size_t from, std::span<const std::uint32_t> places) {
        resize(places.size());
        const double *all_x = tree.at(0), *all_y = tree.at(1), *all_z = tree.at(2);
        const point_index* all_indices = tree.index();
        const double px = all_x[from], py = all_y[from], pz = all_z[from];
        double* offset_x = numbers_.data();
        double* offset_y = offset_x + capacity_;
        double* offset_z = offset_y + capacity_;
        point_index* index = index_.data();
        for (std::size_t j = 0; j < count_; ++j) {
            const std::size_t at = places[j];
            offset_x[j] = all_x[at] - px;
            offset_y[j] = all_y[at] - py;
            offset_z[j] = all_z[at] - pz;
            index[j] = all_indices[at];
        }
        const double *x = offset(0), *y = offset(1), *z = offset(2);
        for (std::size_t j = 0; j < filled(); j += pack::size) {
            std::array<double, pack::size> d2;
            for (std::size_t l = 0; l < pack::size; ++l)
                d2[l] = x[j + l] * x[j + l] + y[j + l] * y[j + l] + z[j + l] * z[j + l];
            std::copy(d2.begin(), d2.end(), numbers_.data() + 3 * capacity_ + j);
        }
    }

  private:
    /// Beyond so many, comparing all with all takes longer than sorting.
    static constexpr std::size_t few = 128;

    [[nodiscard]] neighbor at(std::size_t j) const { return {squared_distance()[j], index_[j]}; }

    /// Puts each where as many are nearer, for which all are compared with all, eight at a time;
    /// then sets ties right.
    void rank_into(std::vector<neighbor>& ring) const {
        const std::size_t not_there = filled() - count_;  // zeros, as near as anything
        std::array<std::uint8_t, few> ties{};             // found up to now, by their last place
        for (std::size_t j = 0; j < count_; ++j) {
            const pack d2(squared_distance()[j]);
            pack not_farther(0.0);
            for (std::size_t i = 0; i < filled(); i += pack::size)
                not_farther += where_at_least(d2, pack(squared_distance() + i), 1.0, 0.0);
            const auto last = static_cast<std::size_t>(not_farther.sum()) - not_there - 1;
            ring[last - ties[last]++] = at(j);
        }
        for (std::size_t j = 1; j < count_; ++j) {
            for (std::size_t t = j; t > 0 && ring[t] < ring[t - 1]; --t)
                std::swap(ring[t], ring[t - 1]);
        }
    }

    void resize(std::size_t count) {
        count_ = count;
        if (filled() > capacity_) {
            capacity_ = filled();
            index_.resize(capacity_);
            numbers_.resize(4 * capacity_);
        }
        for (std::size_t a = 0; a < 3; ++a)
            std::fill(numbers_.data() + a * capacity_ + count_,
                      numbers_.data() + a * capacity_ + filled(), 0.0);
    }

    [[nodiscard]] std::size_t filled() const {
        return (count_ + pack::size - 1) / pack::size * pack::size;
    }

    std::size_t count_ = 0;
    std::size_t capacity_ = 0;
    std::vector<point_index> index_;
    std::vector<double> numbers_;  // x, y, z and squared distance
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

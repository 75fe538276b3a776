// SPDX-License-Identifier: BSL-1.0
/// @file
/// The finite points of a range, told apart by where they are: each position once, with the indices
/// of the points that lie there. Scans hold many points at one place (drivers that report invalid
/// returns as the origin, cells of a grid, one scan merged twice); a tree over places needs to look
/// at them once.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// Places are numbered by the first of their points.
class places {
  public:
    /// Of any indexed range of Eigen::Vector3d. O(n) on average.
    template <class Positions>
    explicit places(const Positions& points) {
        indices_.reserve(points.size());
        positions_.reserve(points.size());
        std::vector<point_index> place_of;  // of each finite point, so far in `indices_`
        place_of.reserve(points.size());
        hash_table numbers(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d p = points[i];
            if (!is_finite(p)) continue;
            const point_index number = numbers.find_or_add(p, positions_);
            if (number == positions_.size()) positions_.push_back(p);
            place_of.push_back(number);
            indices_.push_back(static_cast<point_index>(i));
        }
        if (positions_.size() < indices_.size()) group(place_of);
    }

    /// The number of places.
    [[nodiscard]] std::size_t size() const { return positions_.size(); }
    /// The number of points at all places together.
    [[nodiscard]] std::size_t points() const { return indices_.size(); }

    [[nodiscard]] const Eigen::Vector3d& position(std::size_t place) const {
        return positions_[place];
    }
    /// The indices of the points there, ascending and at least one.
    [[nodiscard]] std::span<const point_index> at(std::size_t place) const {
        if (begin_.empty()) return {indices_.data() + place, 1};
        return {indices_.data() + begin_[place], indices_.data() + begin_[place + 1]};
    }

  private:
    /// Open addressing, linear probing, at most half full.
    class hash_table {
      public:
        explicit hash_table(std::size_t points)
            : slots_(std::bit_ceil(2 * points + 2), empty), mask_(slots_.size() - 1) {}

        /// The number of the place at p; positions.size(), now taken, if there is none yet.
        point_index find_or_add(const Eigen::Vector3d& p,
                                const std::vector<Eigen::Vector3d>& positions) {
            std::size_t s = hash(p) & mask_;
            while (slots_[s] != empty && !equal(positions[slots_[s]], p)) s = (s + 1) & mask_;
            if (slots_[s] == empty) slots_[s] = static_cast<point_index>(positions.size());
            return slots_[s];
        }

      private:
        static constexpr point_index empty = std::numeric_limits<point_index>::max();

        static bool equal(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
            return p.x() == q.x() && p.y() == q.y() && p.z() == q.z();
        }

        static std::size_t hash(const Eigen::Vector3d& p) {
            std::uint64_t h = 0;
            for (const double x : {p.x(), p.y(), p.z()}) {
                h ^= std::bit_cast<std::uint64_t>(x + 0.0);  // -0.0 is where 0.0 is
                h *= 0x9e3779b97f4a7c15;                     // 2^64 / golden ratio, odd
                h ^= h >> 32;
            }
            return static_cast<std::size_t>(h);
        }

        std::vector<point_index> slots_;
        std::size_t mask_;
    };

    /// Puts the indices of each place side by side (a counting sort, which keeps them ascending).
    void group(const std::vector<point_index>& place_of) {
        begin_.assign(size() + 1, 0);
        for (const point_index place : place_of) ++begin_[place + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<point_index> next(begin_.begin(), begin_.end() - 1);
        std::vector<point_index> grouped(indices_.size());
        for (std::size_t i = 0; i < place_of.size(); ++i) {
            grouped[next[place_of[i]]++] = indices_[i];
        }
        indices_ = std::move(grouped);
    }

    std::vector<Eigen::Vector3d> positions_;
    std::vector<point_index> indices_;
    std::vector<point_index> begin_;  // of each place in indices_; empty if each holds one point
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The finite points of a range in coordinates of order 1, without any rounding, so that predicates
/// on them are predicates on the points: far from the origin differences of coordinates are exact.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/begins_from_sizes.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/features/detail/inner_cells.hpp>

namespace gnomon::detail {

/// q = scale (p - origin) for the finite points p that can be extreme: of many, those that are
/// obviously in the interior are left out. Exact: the scale is a power of
/// two; a coordinate is translated only if all values of it have one sign and differ by a factor
/// of 2 at most (lemma of Sterbenz 1974). Only coordinates below 1e-80 of the largest become zero.
struct local_points {
    std::vector<Eigen::Vector3d> positions;  ///< below 1 in magnitude
    std::vector<point_index> indices;        ///< in the range
    Eigen::Vector3d origin{0.0, 0.0, 0.0};   ///< [m]
    double scale = 1.0;                      ///< [1 / m]

    /// @param p  a position_view, or anything with size() and positions by index
    template <class Points>
    explicit local_points(const Points& p) {
        constexpr double inf = std::numeric_limits<double>::infinity();
        Eigen::Vector3d low(inf, inf, inf);
        Eigen::Vector3d high(-inf, -inf, -inf);
        std::size_t count = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Eigen::Vector3d x = p[i];
            if (!is_finite(x)) continue;
            ++count;
            for (int a = 0; a < 3; ++a) {
                low[a] = std::min(low[a], x[a]);
                high[a] = std::max(high[a], x[a]);
            }
        }
        if (count == 0) return;
        double largest = 0.0;
        for (int a = 0; a < 3; ++a) {
            if (low[a] > 0.0 && high[a] <= 2.0 * low[a]) origin[a] = low[a];
            if (high[a] < 0.0 && low[a] >= 2.0 * high[a]) origin[a] = high[a];
            largest = std::max({largest, high[a] - origin[a], origin[a] - low[a]});
        }
        if (largest > 0.0) scale = power_to_one(largest);
        if (count <= cached) {
            add(p, 1);
            return;
        }
        const std::size_t sample_size = 1024 + p.size() / 512;  // performance only
        add(p, p.size() / sample_size);
        const inner_cells interior(positions);
        positions.clear();
        indices.clear();
        add(p, 1, &interior);
        if (positions.size() > cached) sort_into_cells();
    }

    /// Keeps the points of the given numbers, in that order.
    void keep(const std::vector<std::uint32_t>& numbers) {
        std::vector<Eigen::Vector3d> kept;
        std::vector<point_index> kept_indices;
        for (const std::uint32_t i : numbers) {
            kept.push_back(positions[i]);
            kept_indices.push_back(indices[i]);
        }
        positions = std::move(kept);
        indices = std::move(kept_indices);
    }

  private:
    static constexpr std::size_t cached = 32768;  // performance only
    static constexpr double smallest = 1e-80;     // products of three do not underflow

    /// Adds each stride-th point, unless it is in the interior.
    template <class Points>
    void add(const Points& p, std::size_t stride, const inner_cells* interior = nullptr) {
        for (std::size_t i = 0; i < p.size(); i += stride) {
            const Eigen::Vector3d x = p[i];
            if (!is_finite(x)) continue;
            Eigen::Vector3d q = scaled(scale, difference(x, origin));
            for (int a = 0; a < 3; ++a)
                if (std::abs(q[a]) < smallest) q[a] = 0.0;
            if (interior != nullptr && interior->contains(q)) continue;
            positions.push_back(q);
            indices.push_back(static_cast<point_index>(i));
        }
    }

    /// Sorts the points into cells of 1/8, by the Morton order of these; those of one cell keep
    /// their order. Points that are near in space are then near in memory. O(n).
    void sort_into_cells() {
        constexpr std::uint32_t cells_per_axis = 16;  // performance only
        std::vector<std::uint32_t> begin(cells_per_axis * cells_per_axis * cells_per_axis + 1, 0);
        std::vector<std::uint16_t> cells(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            std::uint32_t cell = 0;
            for (int a = 0; a < 3; ++a) {
                const double along = 0.5 * (positions[i][a] + 1.0) * cells_per_axis;
                cell |= every_third(static_cast<std::uint32_t>(along)) << a;
            }
            cells[i] = static_cast<std::uint16_t>(cell);
            ++begin[cell + 1];
        }
        begins_from_sizes(begin);
        std::vector<Eigen::Vector3d> sorted(positions.size());
        std::vector<point_index> sorted_indices(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const std::uint32_t place = begin[cells[i]]++;
            sorted[place] = positions[i];
            sorted_indices[place] = indices[i];
        }
        positions = std::move(sorted);
        indices = std::move(sorted_indices);
    }

    /// The four bits of x, at every third place.
    [[nodiscard]] static std::uint32_t every_third(std::uint32_t x) {
        return (x & 1u) | (x & 2u) << 2 | (x & 4u) << 4 | (x & 8u) << 6;
    }
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The occupied cells of a grid of cubes: their points, means, and the points nearest to these.
///
/// Points are copied to parts by a hash of their cells, so that a part and the hash table of its
/// cells stay in the cache, and parts are independent of each other. Sums are of integers, which
/// are exact: the mean of a cell depends on its points alone, not on their order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/hash_of.hpp>
#include <gnomon/core/detail/kept_array.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// A point of a part, or one of its cells. (One type, as cells take the memory of their points.)
struct voxel_entry {
    std::array<double, 3> at;  ///< the point, or the mean of the points of the cell [m]
    std::uint32_t number;      ///< the hash of its cell, then the cell; or the count of the points
    point_index index;         ///< the point, or that nearest to the mean

    [[nodiscard]] Eigen::Vector3d position() const { return {at[0], at[1], at[2]}; }
};

/// Finds the cells of the points of one part; each thread has its own object.
class voxel_finder {
  public:
    /// @param side  of the cells [m], whose square neither over- nor underflows
    explicit voxel_finder(double side) : side_(side) {}

    /// The cell (i, j, k) of a point: i side <= x < (i + 1) side, and so on.
    /// @throws std::invalid_argument  if a point is 2^50 cells or more from the origin
    [[nodiscard]] std::array<std::int64_t, 3> number_of(const Eigen::Vector3d& p) const {
        constexpr double most = 0x1p50;  // numerical: the centers of cells are exact numbers
        std::array<std::int64_t, 3> number;
        for (std::size_t a = 0; a < 3; ++a) {
            const double sides = p[static_cast<Eigen::Index>(a)] / side_;
            require(std::abs(sides) < most,
                    "voxel_grid: the cells are too small for coordinates as large as these");
            const auto toward_zero = static_cast<std::int64_t>(sides);
            number[a] = toward_zero - (static_cast<double>(toward_zero) > sides ? 1 : 0);
        }
        return number;
    }

    /// Calls visit(i, j) for all points i of a part and the points j that are nearest to the means
    /// of their cells, and replaces the first points by the cells.
    /// @return the number of cells
    std::size_t operator()(std::span<voxel_entry> part, auto&& visit) {
        assign(part);
        for (cell& c : cells_) center(c);
        for (const voxel_entry& e : part) add(cells_[e.number], e);
        for (cell& c : cells_) average(c);
        for (std::uint32_t i = 0; i < part.size(); ++i) choose(cells_[part[i].number], part, i);
        for (const voxel_entry& e : part) {
            const cell& c = cells_[e.number];
            visit(e.index, part[c.nearest].index, c.count);
        }
        // Cells are in the order of their first points, so none replaces the points of a later one.
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            const cell& c = cells_[k];
            part[k] = {c.mean, c.count, part[c.nearest].index};
        }
        return cells_.size();
    }

  private:
    struct cell {
        std::array<std::int64_t, 3> number;
        std::array<std::int64_t, 3> sum;  // of offsets from the center
        std::array<double, 3> mean;       // the center until it is known [m]
        double scale;                     // of the sum [1/m]
        double least;                     // the squared distance of the nearest point [m^2]
        std::uint32_t nearest;            // the number of that point in the part
        point_index count;
    };

    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// Counts the points of each cell, by a hash table with linear probing, at most half full.
    void assign(std::span<voxel_entry> part) {
        cells_.clear();
        table_.assign(std::bit_ceil(2 * part.size() + 1), none);
        const std::size_t mask = table_.size() - 1;
        for (std::uint32_t i = 0; i < part.size(); ++i) {
            voxel_entry& e = part[i];
            const auto own = number_of(e.position());
            std::size_t slot = e.number & mask;
            while (table_[slot] != none && !is_at(cells_[table_[slot]], own))
                slot = (slot + 1) & mask;
            if (table_[slot] == none) {
                table_[slot] = static_cast<std::uint32_t>(cells_.size());
                constexpr double infinity = std::numeric_limits<double>::infinity();
                cells_.push_back({own, {0, 0, 0}, e.at, 0.0, infinity, i, 0});
            }
            e.number = table_[slot];
            ++cells_[e.number].count;
        }
    }

    [[nodiscard]] static bool is_at(const cell& c, const std::array<std::int64_t, 3>& number) {
        return c.number[0] == number[0] && c.number[1] == number[1] && c.number[2] == number[2];
    }

    /// Prepares the sum of offsets from the center, less than a side each: in units as fine as they
    /// can be without overflow. The mean of a single point is that point.
    void center(cell& c) const {
        const int unused_bits = 62 - static_cast<int>(std::bit_width(c.count));
        c.scale = static_cast<double>(std::int64_t{1} << unused_bits) / side_;
        if (c.count == 1) return;
        for (std::size_t a = 0; a < 3; ++a)
            c.mean[a] = (static_cast<double>(c.number[a]) + 0.5) * side_;
    }

    // No branches for single points here: they would be mispredicted.
    static void add(cell& c, const voxel_entry& e) {
        for (std::size_t a = 0; a < 3; ++a)
            c.sum[a] += static_cast<std::int64_t>((e.at[a] - c.mean[a]) * c.scale);
    }

    static void average(cell& c) {
        const double unit = 1.0 / (c.scale * static_cast<double>(c.count));
        for (std::size_t a = 0; a < 3; ++a) c.mean[a] += static_cast<double>(c.sum[a]) * unit;
    }

    /// Of points that are equally near, the one of least coordinates is chosen, then of least
    /// index.
    static void choose(cell& c, std::span<const voxel_entry> part, std::uint32_t i) {
        const double squared =
            squared_distance(part[i].position(), {c.mean[0], c.mean[1], c.mean[2]});
        if (squared > c.least || (squared == c.least && part[i].at >= part[c.nearest].at)) return;
        c.least = squared;
        c.nearest = i;
    }

    double side_;
    scratch<std::uint32_t> table_;
    scratch<cell> cells_;
};

/// The finite points of a position_view, distributed to parts by their cells.
class voxel_parts {
  public:
    /// @param side  of the cells [m]
    template <execution X>
    voxel_parts(const auto& points, double side, const X& run) : side_(side) {
        constexpr std::size_t per_part = 1 << 11, most_parts = 1 << 10;  // performance only
        constexpr std::size_t blocks = 64;                               // of points
        const std::size_t n = points.size();
        const std::size_t parts = std::min(std::bit_ceil(n / per_part + 1), most_parts);
        const auto part_of = [shift = 32 - std::countr_zero(parts)](std::uint32_t hash) {
            return static_cast<std::size_t>(std::uint64_t{hash} >> shift);
        };
        // A counting sort in blocks, stable.
        kept_array<std::uint32_t> hashes;
        hashes.resize(n, run);
        scratch<std::size_t> next(blocks * parts, 0);  // by block, then part
        const voxel_finder grid(side);
        const auto for_points_of = [n](std::size_t block, auto&& f) {
            for (std::size_t i = block * n / blocks; i < (block + 1) * n / blocks; ++i) f(i);
        };
        run(blocks, [&](std::size_t block) {
            for_points_of(block, [&](std::size_t i) {
                const Eigen::Vector3d p = points[i];
                hashes[i] = none;
                if (!is_finite(p)) return;
                const auto hash = static_cast<std::uint32_t>(hash_of(grid.number_of(p)));
                hashes[i] = std::min(hash, none - 1);
                ++next[block * parts + part_of(hashes[i])];
            });
        });
        ends_.resize(parts);
        std::size_t size = 0;
        for (std::size_t p = 0; p < parts; ++p) {
            for (std::size_t b = 0; b < blocks; ++b)
                size += std::exchange(next[b * parts + p], size);
            ends_[p] = size;
        }
        entries_.resize(size, run);
        run(blocks, [&](std::size_t block) {
            for_points_of(block, [&](std::size_t i) {
                if (hashes[i] == none) return;
                std::size_t& to = next[block * parts + part_of(hashes[i])];
                const Eigen::Vector3d p = points[i];
                entries_[to++] = {{p[0], p[1], p[2]}, hashes[i], static_cast<point_index>(i)};
            });
        });
    }

    /// Finds the cells. Calls visit(i, j, count) for all finite points i, from several threads: j
    /// is the point nearest to the mean of its cell, which has `count` points.
    template <execution X>
    void find(const X& run, auto&& visit) {
        constexpr std::size_t parts_per_chunk = 8;  // performance only
        cells_.resize(ends_.size());
        run((ends_.size() + parts_per_chunk - 1) / parts_per_chunk, [&](std::size_t chunk) {
            voxel_finder find(side_);
            const std::size_t last = std::min((chunk + 1) * parts_per_chunk, ends_.size());
            for (std::size_t p = chunk * parts_per_chunk; p < last; ++p)
                cells_[p] = find(std::span(entries_.data() + begin(p), ends_[p] - begin(p)), visit);
        });
    }

    /// Calls visit(cell) for all cells that were found, in no particular order.
    void for_each_cell(auto&& visit) const {
        for (std::size_t p = 0; p < cells_.size(); ++p)
            for (std::size_t c = 0; c < cells_[p]; ++c) visit(entries_[begin(p) + c]);
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    [[nodiscard]] std::size_t begin(std::size_t part) const {
        return part > 0 ? ends_[part - 1] : 0;
    }

    double side_;
    kept_array<voxel_entry> entries_;  // part after part; cells replace points
    scratch<std::size_t> ends_;        // of the parts
    scratch<std::size_t> cells_;       // the number of cells of each part
};

}  // namespace gnomon::detail

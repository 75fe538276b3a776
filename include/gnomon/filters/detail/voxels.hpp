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
#include <tuple>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/hash_of.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// One occupied cell.
struct voxel {
    Eigen::Vector3d mean;  ///< of its points [m]
    point_index count;     ///< of its points
    point_index nearest;   ///< the point nearest to the mean: of equals that of least coordinates
};

/// Finds the cells of the points of one part; each thread has its own object.
class voxel_finder {
  public:
    /// A point and, as long as it is not known, the hash of its cell; then the number of the cell.
    struct entry {
        Eigen::Vector3d p;
        std::uint32_t cell;
        point_index index;
    };

    explicit voxel_finder(double side) : side_(side) {}

    /// Cell (i, j, k) holds the points with i side <= x < (i + 1) side, and so on.
    /// @throws std::invalid_argument  if a point is 2^50 cells or more from the origin
    [[nodiscard]] std::array<std::int64_t, 3> cell_at(const Eigen::Vector3d& p) const {
        constexpr double most = 0x1p50;  // numerical: the centers of cells are exact numbers
        std::array<std::int64_t, 3> at;
        for (std::size_t a = 0; a < 3; ++a) {
            const double number = p[static_cast<Eigen::Index>(a)] / side_;
            require(std::abs(number) < most,
                    "voxel_grid: the cells are too small for coordinates as large as these");
            at[a] = static_cast<std::int64_t>(number);
            if (static_cast<double>(at[a]) > number) --at[a];  // rounds down; faster than floor
        }
        return at;
    }

    /// Calls visit(i, voxel) for all points of a part and their cells.
    void operator()(std::span<entry> part, auto&& visit) {
        assign(part);
        for (cell& c : cells_) center(c);
        for (const entry& e : part) add(cells_[e.cell], e.p);
        for (cell& c : cells_) average(c);
        for (const entry& e : part) choose(cells_[e.cell], e);
        for (const entry& e : part) visit(e.index, cells_[e.cell].found);
    }

  private:
    struct cell {
        std::array<std::int64_t, 3> at;
        std::array<std::int64_t, 3> sum;  // of offsets from the center
        voxel found;                      // the mean is the center until it is known
        Eigen::Vector3d nearest;          // the position of the nearest point so far
        double scale;                     // of the sum [1/m]
        double least;                     // the squared distance of the nearest point [m^2]
        std::uint32_t hash;
    };

    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// The slot of a cell, or the empty one for it, in a hash table with linear probing.
    [[nodiscard]] std::size_t slot_of(std::uint32_t hash, auto&& is_it) const {
        std::size_t slot = hash & (table_.size() - 1);
        while (table_[slot] != none && !is_it(cells_[table_[slot]]))
            slot = (slot + 1) & (table_.size() - 1);
        return slot;
    }

    /// Counts the points of each cell. The table is at most half full.
    void assign(std::span<entry> part) {
        constexpr std::size_t fewest_slots = 1024;  // performance only
        cells_.clear();
        table_.assign(fewest_slots, none);
        for (entry& e : part) {
            const auto own = cell_at(e.p);
            const std::size_t slot = slot_of(e.cell, [&](const cell& c) { return c.at == own; });
            std::uint32_t number = table_[slot];
            if (number == none) {
                table_[slot] = number = static_cast<std::uint32_t>(cells_.size());
                cells_.push_back({own, {0, 0, 0}, {e.p, 0, e.index}, e.p, 0.0, 0.0, e.cell});
                if (2 * cells_.size() > table_.size()) grow();
            }
            e.cell = number;
            ++cells_[number].found.count;
        }
    }

    void grow() {
        table_.assign(2 * table_.size(), none);
        for (std::size_t c = 0; c < cells_.size(); ++c)
            table_[slot_of(cells_[c].hash, [](const cell&) { return false; })] =
                static_cast<std::uint32_t>(c);
    }

    /// Prepares the sum of offsets from the center, less than a side each: in units as fine as they
    /// can be without overflow.
    void center(cell& c) const {
        if (c.found.count == 1) return;  // the mean is the point
        c.scale = std::ldexp(1.0, 62 - static_cast<int>(std::bit_width(c.found.count))) / side_;
        c.least = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < 3; ++a)
            c.found.mean[static_cast<Eigen::Index>(a)] =
                (static_cast<double>(c.at[a]) + 0.5) * side_;
    }

    static void add(cell& c, const Eigen::Vector3d& p) {
        if (c.found.count == 1) return;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<Eigen::Index>(a);
            c.sum[a] += static_cast<std::int64_t>((p[axis] - c.found.mean[axis]) * c.scale);
        }
    }

    static void average(cell& c) {
        if (c.found.count == 1) return;
        const double unit = 1.0 / (c.scale * static_cast<double>(c.found.count));
        for (std::size_t a = 0; a < 3; ++a)
            c.found.mean[static_cast<Eigen::Index>(a)] += static_cast<double>(c.sum[a]) * unit;
    }

    static void choose(cell& c, const entry& e) {
        if (c.found.count == 1) return;
        const double squared = squared_distance(e.p, c.found.mean);
        const Eigen::Vector3d &p = e.p, &q = c.nearest;
        if (squared > c.least ||
            (squared == c.least && std::tie(p[0], p[1], p[2]) >= std::tie(q[0], q[1], q[2])))
            return;
        c.least = squared;
        c.nearest = p;
        c.found.nearest = e.index;
    }

    double side_;
    scratch<std::uint32_t> table_;
    scratch<cell> cells_;
};

/// Calls visit(i, voxel) for all finite points of a position_view and their cells, from several
/// threads.
/// @param side  of the cells [m]
template <execution X>
void visit_voxels(const auto& points, double side, const X& run, auto&& visit) {
    using entry = voxel_finder::entry;
    constexpr std::size_t per_part = 1 << 11, most_parts = 1 << 10;  // performance only
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    const std::size_t n = points.size();
    const std::size_t parts = std::min(std::bit_ceil(n / per_part + 1), most_parts);
    const auto part_of = [shift = 32 - std::countr_zero(parts)](std::uint32_t hash) {
        return static_cast<std::size_t>(std::uint64_t{hash} >> shift);
    };
    // A counting sort in blocks, stable.
    const std::size_t block = std::max(n / 64 + 1, per_part);
    const std::size_t blocks = (n + block - 1) / block;
    scratch<std::uint32_t> hashes(n, none);
    scratch<std::size_t> next(blocks * parts, 0);  // by block, then part
    const voxel_finder grid(side);
    run(blocks, [&](std::size_t b) {
        for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) {
            const Eigen::Vector3d p = points[i];
            if (!is_finite(p)) continue;
            hashes[i] = std::min(static_cast<std::uint32_t>(hash_of(grid.cell_at(p))), none - 1);
            ++next[b * parts + part_of(hashes[i])];
        }
    });
    std::size_t size = 0;
    scratch<std::size_t> first(parts + 1, 0);
    for (std::size_t p = 0; p < parts; ++p) {
        for (std::size_t b = 0; b < blocks; ++b) size += std::exchange(next[b * parts + p], size);
        first[p + 1] = size;
    }
    scratch<entry> entries(size);
    run(blocks, [&](std::size_t b) {
        for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i)
            if (hashes[i] != none)
                entries[next[b * parts + part_of(hashes[i])]++] = {points[i], hashes[i],
                                                                   static_cast<point_index>(i)};
    });
    constexpr std::size_t parts_per_chunk = 8;  // performance only
    run((parts + parts_per_chunk - 1) / parts_per_chunk, [&](std::size_t chunk) {
        voxel_finder find(side);
        const std::size_t last = std::min((chunk + 1) * parts_per_chunk, parts);
        for (std::size_t p = chunk * parts_per_chunk; p < last; ++p)
            find(std::span(entries).subspan(first[p], first[p + 1] - first[p]), visit);
    });
}

}  // namespace gnomon::detail

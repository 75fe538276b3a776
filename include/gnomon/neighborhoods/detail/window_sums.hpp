// SPDX-License-Identifier: BSL-1.0
/// @file
/// The moments of the pixels of a window about its center, and their mean distance from it: rows of
/// an image are read vector by vector, in which pixels beyond the row or without a return are
/// masked out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/neighborhoods/detail/found_neighbors.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Vectors of four numbers. All processors add in the same order, so that sums are the same bytes.
struct four_numbers {
    static constexpr std::size_t size = 4;
#if defined(GNOMON_SCALAR_LANES)
    using numbers = std::array<double, size>;
#else
    using numbers [[gnu::vector_size(32)]] = double;
    using bits [[gnu::vector_size(32)]] = std::int64_t;
    static constexpr std::int64_t masks[] = {-1, -1, -1, -1, 0, 0, 0};

    [[GNOMON_ALWAYS_INLINE]] static void take_roots(numbers& a) {
        for (std::size_t l = 0; l < size; ++l) a[l] = std::sqrt(a[l]);
    }
#endif
};
#if GNOMON_LANE_BITS >= 256 || defined(GNOMON_LANES_UP_TO_AVX2)
/// The same in functions that are compiled for AVX2.
struct four_numbers_of_avx2 : four_numbers {
    [[GNOMON_WITH_AVX2]] static void take_roots(numbers& a) { a = __builtin_ia32_sqrtpd256(a); }
};
#endif

/// The sums of the numbers of each vector: of offsets, of their products by columns, of distances.
template <class Vectors>
[[GNOMON_ALWAYS_INLINE]] inline neighborhood_sums reduced(
    const typename Vectors::numbers (&all)[10], std::size_t count) {
    double sums[10];
    for (std::size_t s = 0; s < 10; ++s) {
        sums[s] = 0.0;
        for (std::size_t l = 0; l < Vectors::size; ++l) sums[s] += all[s][l];
    }
    neighborhood_sums r;
    r.about_point.count = count;
    r.about_point.sum = {sums[0], sums[1], sums[2]};
    for (int j = 0, s = 3; j < 3; ++j)
        for (int i = j; i < 3; ++i) r.about_point.outer(i, j) = sums[s++];
    if (count > 0) r.mean_distance = sums[9] / static_cast<double>(count);
    return r;
}

#if defined(GNOMON_SCALAR_LANES)
/// The sums over the window of a pixel, in the order of the vectors.
/// @param count  of its neighbors
template <class Vectors>
[[nodiscard]] neighborhood_sums summed_by(const auto& windows, std::size_t center,
                                          std::size_t count) {
    typename Vectors::numbers all[10] = {};
    const auto column = windows.column_of(center);
    for (std::size_t q = column.begin; q <= column.last; q += column.step) {
        if (!windows.links().has_return(q)) continue;
        const auto [begin, end] = windows.row_of(q, column.radius);
        for (std::size_t l = begin; l < end; ++l) {
            double d[3];
            for (std::size_t i = 0; i < 3; ++i)
                d[i] = windows.links().at(i)[l] - windows.links().at(i)[center];
            if (std::isnan(d[0])) continue;  // no return
            const std::size_t lane = (l - begin) % Vectors::size;
            for (std::size_t i = 0, s = 3; i < 3; ++i) {
                all[i][lane] += d[i];
                for (std::size_t j = i; j < 3; ++j) all[s++][lane] += d[i] * d[j];
            }
            all[9][lane] += std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        }
    }
    return reduced<Vectors>(all, count);
}
#else
/// The sums over the window of a pixel, by such vectors. The arrays of coordinates are at least
/// three numbers longer than the image. (One loop without calls, so that all sums stay in
/// registers: performance only.)
/// @param count  of its neighbors
template <class Vectors>
[[GNOMON_ALWAYS_INLINE]] inline neighborhood_sums summed_by(const auto& windows, std::size_t center,
                                                            std::size_t count) {
    using numbers = typename Vectors::numbers;
    constexpr std::size_t size = Vectors::size;
    const double* const at_x = windows.links().at(0);
    const double* const at_y = windows.links().at(1);
    const double* const at_z = windows.links().at(2);
    const double px = at_x[center], py = at_y[center], pz = at_z[center];
    numbers distance{}, x{}, y{}, z{}, xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
    const auto column = windows.column_of(center);
    for (std::size_t q = column.begin; q <= column.last; q += column.step) {
        if (!windows.links().has_return(q)) continue;
        const auto [begin, end] = windows.row_of(q, column.radius);
        using bits = typename Vectors::bits;
        for (std::size_t l = begin; l < end; l += size) {
            bits mask;
            const std::size_t many = end - l < size ? end - l : size;
            std::memcpy(&mask, Vectors::masks + (size - many), sizeof mask);
            numbers dx, dy, dz;
            std::memcpy(&dx, at_x + l, sizeof dx);
            std::memcpy(&dy, at_y + l, sizeof dy);
            std::memcpy(&dz, at_z + l, sizeof dz);
            mask &= dx == dx;  // NaN: no return
            dx = reinterpret_cast<numbers>(reinterpret_cast<bits>(dx - px) & mask);
            dy = reinterpret_cast<numbers>(reinterpret_cast<bits>(dy - py) & mask);
            dz = reinterpret_cast<numbers>(reinterpret_cast<bits>(dz - pz) & mask);
            const numbers dxdx = dx * dx, dydy = dy * dy, dzdz = dz * dz;
            numbers length = dxdx + dydy + dzdz;
            Vectors::take_roots(length);
            distance += length;
            x += dx;
            y += dy;
            z += dz;
            xx += dxdx;
            xy += dx * dy;
            xz += dx * dz;
            yy += dydy;
            yz += dy * dz;
            zz += dzdz;
        }
    }
    const numbers all[] = {x, y, z, xx, xy, xz, yy, yz, zz, distance};
    return reduced<Vectors>(all, count);
}
#endif

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Thirty-two points, or boxes, as a structure of arrays, and their distances from a point: loops
/// of fixed length, which compilers vectorise at -O2 already. And the k-th least of few distances,
/// which compilers do not vectorise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

inline constexpr std::size_t lane_count = 32;

/// One number of each of 32 points.
struct alignas(64) lanes {
    float at[lane_count];

    [[nodiscard]] float& operator[](std::size_t l) { return at[l]; }
    [[nodiscard]] const float& operator[](std::size_t l) const { return at[l]; }
};

/// The positions of 32 points; with fewer points, the rest is infinity.
struct lane_points {
    lanes x, y, z;

    void set(std::size_t l, const std::array<float, 3>& p) {
        x[l] = p[0], y[l] = p[1], z[l] = p[2];
    }

    /// The squared distances from (px, py, pz).
    [[nodiscard, GNOMON_ALWAYS_INLINE]] lanes squared_distances(float px, float py,
                                                                float pz) const {
        lanes d2;
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float dx = x.at[l] - px, dy = y.at[l] - py, dz = z.at[l] - pz;
            d2.at[l] = dx * dx + dy * dy + dz * dz;
        }
        return d2;
    }
};

/// Thirty-two boxes, as their centers, half their side lengths and half their diagonals.
struct lane_boxes {
    lanes x, y, z, half_x, half_y, half_z, half_diagonal;

    void set(std::size_t l, const std::array<float, 3>& middle, const std::array<float, 3>& half) {
        x[l] = middle[0], y[l] = middle[1], z[l] = middle[2];
        half_x[l] = half[0], half_y[l] = half[1], half_z[l] = half[2];
        half_diagonal[l] = std::sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
    }

    /// Four times the squared distances from (px, py, pz); 0 inside.
    [[nodiscard, GNOMON_ALWAYS_INLINE]] lanes squared_distances_times_4(float px, float py,
                                                                        float pz) const {
        lanes d2;
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float dx = std::abs(x.at[l] - px) - half_x.at[l];
            const float dy = std::abs(y.at[l] - py) - half_y.at[l];
            const float dz = std::abs(z.at[l] - pz) - half_z.at[l];
            // d + |d| is twice the larger of d and 0, which compilers would not vectorise.
            const float gx = dx + std::abs(dx), gy = dy + std::abs(dy), gz = dz + std::abs(dz);
            d2.at[l] = gx * gx + gy * gy + gz * gz;
        }
        return d2;
    }
};

/// Distances of 32 points from a point.
struct lane_point {
    float x, y, z;

    [[nodiscard, GNOMON_ALWAYS_INLINE]] lanes squared_distances(const lane_points& points) const {
        return points.squared_distances(x, y, z);
    }
    /// Which of 32 boxes may have points within a limit, a squared distance.
    [[nodiscard, GNOMON_ALWAYS_INLINE]] std::uint32_t nearby(auto instructions,
                                                             const lane_boxes& boxes,
                                                             float limit) const {
        return instructions.at_most(boxes.squared_distances_times_4(x, y, z), 4.00004f * limit);
    }
};

/// Distances of 32 points from a segment.
struct lane_segment {
    float x, y, z;     // of its middle
    float ux, uy, uz;  // its direction, of length 1, or 0 for a segment of length 0
    float half_length;

    [[nodiscard, GNOMON_ALWAYS_INLINE]] lanes squared_distances(const lane_points& points) const {
        return squared_distances(points.x, points.y, points.z);
    }
    /// Which of 32 boxes may have points within a limit, a squared distance: the balls around them.
    [[nodiscard, GNOMON_ALWAYS_INLINE]] std::uint32_t nearby(auto instructions,
                                                             const lane_boxes& boxes,
                                                             float limit) const {
        constexpr float margin = 1e-5f;  // floats are off by some 2^-24 of coordinates below 4
        const float distance = std::sqrt(limit) + margin;
        lanes excess = squared_distances(boxes.x, boxes.y, boxes.z);
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float reach = distance + boxes.half_diagonal.at[l];
            excess.at[l] -= reach * reach + margin;
        }
        return instructions.at_most(excess, 0.0f);
    }

  private:
    [[nodiscard, GNOMON_ALWAYS_INLINE]] lanes squared_distances(const lanes& px, const lanes& py,
                                                                const lanes& pz) const {
        lanes d2;
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float dx = px.at[l] - x, dy = py.at[l] - y, dz = pz.at[l] - z;
            const float along = dx * ux + dy * uy + dz * uz;
            const float end = std::abs(along) - half_length;
            const float beyond = end + std::abs(end);  // twice the larger of end and 0, see above
            const float across = dx * dx + dy * dy + dz * dz - along * along;  // or just below 0
            d2.at[l] = 0.5f * (across + std::abs(across)) + 0.25f * beyond * beyond;
        }
        return d2;
    }
};

/// The k-th least of n numbers: compares each number with all numbers, eight at a time. O(n^2).
/// Precondition: 0 < k <= n; `a` is aligned for vectors of eight, and infinity fills the last one.
[[nodiscard, GNOMON_ALWAYS_INLINE]] inline float kth_least(const float* a, std::size_t n,
                                                           std::size_t k) {
#if defined(GNOMON_SCALAR_LANES)
    float kth = std::numeric_limits<float>::infinity();
    for (std::size_t v = 0; v < n; ++v) {
        std::size_t at_most = 0;
        for (std::size_t j = 0; j < n; ++j) at_most += a[j] <= a[v] ? 1u : 0u;
        if (at_most >= k) kth = std::min(kth, a[v]);
    }
    return kth;
#else
    constexpr std::size_t width = 8;
    using floats [[gnu::vector_size(4 * width), gnu::may_alias]] = float;
    using integers [[gnu::vector_size(4 * width)]] = int;
    floats least = std::numeric_limits<float>::infinity() - floats{};
    for (std::size_t v = 0; v < n; v += width) {
        const floats these = reinterpret_cast<const floats&>(a[v]);
        integers at_most = {};  // these; counted downwards, as a comparison gives 0 or -1
        for (std::size_t j = 0; j < n; j += 4) {
            at_most += a[j] <= these;
            at_most += a[j + 1] <= these;
            at_most += a[j + 2] <= these;
            at_most += a[j + 3] <= these;
        }
        least = at_most <= -static_cast<int>(k) && these < least ? these : least;
    }
    float kth = least[0];
    for (std::size_t l = 1; l < width; ++l) kth = std::min(kth, least[l]);
    return kth;
#endif
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

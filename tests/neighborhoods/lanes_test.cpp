// SPDX-License-Identifier: BSL-1.0
/// What vector instructions do, against plain loops. Compiled once more for each set of
/// instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>
#include <gnomon/neighborhoods/detail/ray_metric.hpp>

namespace {

using gnomon::detail::lane_count, gnomon::detail::lanes;

/// Distances of points, and of boxes about them: never more than from any point of the box.
TEST(lanes, measure_points_and_boxes) {
    gnomon::random_stream random(3);
    const auto any = [&] { return static_cast<float>(random.uniform()); };
    for (int trial = 0; trial < 200; ++trial) {
        gnomon::detail::lane_points points;
        gnomon::detail::lane_boxes boxes;
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float x = any(), y = any(), z = any();
            points.set(l, {x, y, z});
            boxes.set(l, {x, y, z}, {0.25f, 0.5f, 0.0f});
        }
        const float px = any(), py = any(), pz = any();
        const lanes d2 = points.squared_distances(px, py, pz);
        const lanes gap2 = boxes.squared_distances_times_4(px, py, pz);
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float dx = points.x[l] - px, dy = points.y[l] - py, dz = points.z[l] - pz;
            ASSERT_NEAR(d2[l], dx * dx + dy * dy + dz * dz, 1e-6);
            const float gx = std::max(0.0f, std::abs(dx) - 0.25f);
            const float gy = std::max(0.0f, std::abs(dy) - 0.5f);
            ASSERT_NEAR(gap2[l], 4 * (gx * gx + gy * gy + dz * dz), 4e-6);
        }
    }
}

/// Distances from a segment, also where they are 0 but for rounding; and no box is left out that
/// may have a point within the limit.
TEST(lanes, measure_from_segments) {
    constexpr gnomon::detail::compiled_instructions instructions;
    gnomon::random_stream random(5);
    const auto any = [&] { return static_cast<float>(random.uniform()); };
    for (int trial = 0; trial < 300; ++trial) {
        const Eigen::Vector3d u = clouds::gaussian_vector(random).normalized();
        const float half_length = trial % 3 == 0 ? 0.0f : any();
        const Eigen::Vector3f v = u.cast<float>(), from(any(), any(), any());
        const gnomon::detail::lane_segment segment{from[0], from[1], from[2],    v[0],
                                                   v[1],    v[2],    half_length};
        const gnomon::detail::ray_metric metric(u, half_length);
        gnomon::detail::lane_points points;
        gnomon::detail::lane_boxes boxes;
        const std::array<float, 3> half{0.02f, 0.05f, 0.0f};
        for (std::size_t l = 0; l < lane_count; ++l) {
            Eigen::Vector3f q(any(), any(), any());
            if (l % 4 == 0) q = from + 0.3f * any() * v;
            points.set(l, {q[0], q[1], q[2]});
            boxes.set(l, {q[0], q[1], q[2]}, half);
        }
        const lanes d2 = segment.squared_distances(points);
        const float limit = 0.1f * any();
        const std::uint32_t near = segment.nearby(instructions, boxes, limit);
        for (std::size_t l = 0; l < lane_count; ++l) {
            const Eigen::Vector3d d(points.x[l] - from[0], points.y[l] - from[1],
                                    points.z[l] - from[2]);
            ASSERT_GE(d2[l], 0.0f);
            ASSERT_NEAR(d2[l], metric.squared(d[0], d[1], d[2]), 2e-6);
            double nearest = clouds::infinity;  // of the corners
            for (int corner = 0; corner < 4; ++corner) {
                const double x = corner % 2 == 0 ? half[0] : -half[0];
                const double y = corner / 2 == 0 ? half[1] : -half[1];
                nearest = std::min(nearest, metric.squared(d[0] + x, d[1] + y, d[2]));
            }
            if (nearest <= limit) {
                ASSERT_TRUE((near >> l & 1u) != 0) << l;
            }
        }
    }
}

/// The k-th least of few numbers, many of them equal, against sorting.
TEST(lanes, find_the_kth_least) {
    gnomon::random_stream random(4);
    for (std::size_t n = 1; n <= lane_count; ++n) {
        for (const double kinds : {1.0, 3.0, 1e6}) {
            lanes a;
            std::fill(a.at, a.at + lane_count, std::numeric_limits<float>::infinity());
            for (std::size_t l = 0; l < n; ++l)
                a[l] = static_cast<float>(std::floor(kinds * random.uniform()));
            std::vector<float> sorted(a.at, a.at + n);
            std::sort(sorted.begin(), sorted.end());
            for (std::size_t k = 1; k <= n; ++k)
                ASSERT_EQ(gnomon::detail::kth_least(a.at, n, k), sorted[k - 1]) << k << " of " << n;
        }
    }
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
/// What vector instructions do, against plain loops. Compiled once more for each set of
/// instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/detail/lanes.hpp>

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

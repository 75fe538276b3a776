// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/detail/bvh.hpp>

namespace sim = gnomon::simulation;

namespace {

std::vector<sim::bounds> random_boxes(std::size_t n, double size) {
    gnomon::random_stream random(n);
    std::vector<sim::bounds> boxes;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3d low(random.uniform(), random.uniform(), random.uniform());
        boxes.push_back({low, low + size * Eigen::Vector3d(random.uniform(), random.uniform(), 0)});
    }
    return boxes;
}

/// Oracle: the slab test, written differently.
bool meets(const sim::ray& r, const sim::bounds& b) {
    double enter = 0.0;
    double leave = r.reach;
    for (int a = 0; a < 3; ++a) {
        const double t0 = (b.low[a] - r.origin[a]) / r.direction[a];
        const double t1 = (b.high[a] - r.origin[a]) / r.direction[a];
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave;
}

TEST(bvh, visits_all_that_a_ray_meets_and_not_much_more) {
    const auto boxes = random_boxes(20'000, 0.02);
    const sim::detail::bvh tree(boxes);
    gnomon::random_stream random(5);
    std::size_t visits = 0;
    for (int k = 0; k < 200; ++k) {
        sim::ray r{{random.uniform(), random.uniform(), random.uniform()},
                   laws::random_direction(random)};
        if (k % 2) r.reach = random.uniform(0.0, 0.5);
        std::vector<bool> visited(boxes.size(), false);
        tree.walk(r, [&](std::uint32_t i) {
            EXPECT_FALSE(visited[i]);
            visited[i] = true;
            ++visits;
        });
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (meets(r, boxes[i])) {
                EXPECT_TRUE(visited[i]);
            }
        }
    }
    EXPECT_LT(visits / 200, 100u);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/detail/ray_metric.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::detail::ray_metric;

/// The distance of d from the points of the segment, tried one by one.
double distance_by_trial(const Eigen::Vector3d& d, const Eigen::Vector3d& u, double half_length) {
    double least = clouds::infinity;
    constexpr int steps = 20'000;
    for (int s = -steps; s <= steps; ++s)
        least = std::min(least, (d - half_length * s / steps * u).norm());
    return least;
}

TEST(ray_metric, is_the_distance_from_a_segment) {
    gnomon::random_stream random(1);
    for (int i = 0; i < 20; ++i) {
        const Eigen::Vector3d u = clouds::gaussian_vector(random).normalized();
        const Eigen::Vector3d d = clouds::gaussian_vector(random);
        const double half_length = random.uniform(0.0, 2.0);
        EXPECT_NEAR(std::sqrt(ray_metric(u, half_length).squared(d[0], d[1], d[2])),
                    distance_by_trial(d, u, half_length), 1e-3);
        EXPECT_NEAR(ray_metric(u, 0.0).squared(d[0], d[1], d[2]), d.squaredNorm(), 1e-12);
    }
}

TEST(ray_metric, bound_of_a_box_is_below_the_distances_of_its_points) {
    gnomon::random_stream random(2);
    for (int i = 0; i < 200; ++i) {
        const ray_metric metric(clouds::gaussian_vector(random).normalized(),
                                random.uniform(0.0, 2.0));
        const Eigen::Vector3d at = clouds::gaussian_vector(random);
        gnomon::detail::leaf_box box{};
        for (std::size_t a = 0; a < 3; ++a) {
            box.low[a] = random.uniform(-3.0, 3.0);
            box.high[a] = box.low[a] + random.uniform(0.0, 1.0);
        }
        const double bound = metric.lower_bound({at[0], at[1], at[2]}, box);
        for (int j = 0; j < 100; ++j) {
            Eigen::Vector3d q;
            for (int a = 0; a < 3; ++a)
                q[a] = random.uniform(box.low[static_cast<std::size_t>(a)],
                                      box.high[static_cast<std::size_t>(a)]);
            const Eigen::Vector3d d = at - q;
            ASSERT_LE(bound, metric.squared(d[0], d[1], d[2]) + 1e-12);
        }
    }
}

/// The search with bounds of boxes finds what comparing with every point finds.
TEST(ray_metric, search_finds_the_nearest_points) {
    const clouds::cloud points = clouds::sheet(5000, 3, 0.02);
    const gnomon::spatial_index index(points);
    gnomon::random_stream random(4);
    std::vector<gnomon::neighbor> found;
    for (int trial = 0; trial < 50; ++trial) {
        const std::size_t i = random.below(points.size());
        const ray_metric metric(clouds::gaussian_vector(random).normalized(),
                                random.uniform(0.0, 0.2));
        gnomon::detail::search_tree(index.tree(), points[i], {.k = 16}, found, metric);
        std::vector<double> all;
        for (const Eigen::Vector3d& q : points) {
            const Eigen::Vector3d d = points[i] - q;
            all.push_back(metric.squared(d[0], d[1], d[2]));
        }
        std::sort(all.begin(), all.end());
        ASSERT_EQ(found.size(), 16u);
        for (std::size_t l = 0; l < found.size(); ++l)
            ASSERT_NEAR(found[l].squared_distance, all[l], 1e-12) << trial;
    }
}

}  // namespace

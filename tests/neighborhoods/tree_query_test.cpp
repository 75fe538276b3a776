// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

/// The canonical distance of every n-th point only; of none for 0.
struct distance_of_every : gnomon::detail::canonical_metric {
    std::size_t n;

    [[nodiscard]] bool accepts(gnomon::point_index i) const { return n > 0 && i % n == 0; }
};

/// For few neighbors, which are kept in order, and many, which are selected.
TEST(tree_query, finds_the_nearest_of_some_points_as_a_loop_does) {
    gnomon::random_stream random(1);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 2000; ++i)
        points.emplace_back(random.uniform(), random.uniform(), random.uniform());
    const gnomon::spatial_index index(points);
    std::vector<gnomon::neighbor> found, expected;
    for (const std::size_t every : {0u, 1u, 3u, 50u}) {
        for (const std::size_t k : {1u, 8u, 16u, 17u, 60u}) {
            for (const double radius : {0.05, 0.3, 2.0}) {
                const Eigen::Vector3d x = points[k];
                gnomon::detail::search_tree(index.tree(), x,
                                            {.k = k, .squared_radius = radius * radius}, found,
                                            distance_of_every{{}, every});
                expected.clear();
                for (gnomon::point_index i = 0; i < points.size(); ++i) {
                    const Eigen::Vector3d d = x - points[i];
                    const double squared = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
                    if (every > 0 && i % every == 0 && squared <= radius * radius)
                        expected.push_back({squared, i});
                }
                std::sort(expected.begin(), expected.end());
                expected.resize(std::min(expected.size(), k));
                ASSERT_EQ(found.size(), expected.size());
                for (std::size_t i = 0; i < found.size(); ++i) {
                    EXPECT_EQ(found[i].index, expected[i].index);
                    EXPECT_EQ(found[i].squared_distance, expected[i].squared_distance);
                }
            }
        }
    }
}

}  // namespace

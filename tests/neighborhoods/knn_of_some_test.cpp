// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/detail/knn_of_some.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace {

using gnomon::adjacency, gnomon::knn;

adjacency rings_of(const std::vector<bool>& some, const clouds::cloud& points, const knn& nearest,
                   unsigned threads = 1) {
    return gnomon::detail::graph_of_some(nearest, some, points, gnomon::threads{threads},
                                         std::identity{});
}

/// The rings of those that are asked after are as in the whole graph, whoever else is.
TEST(knn_of_some, rings_are_those_of_knn) {
    gnomon::random_stream random(1);
    for (const clouds::cloud& points :
         {clouds::sheet(3000, 1), clouds::in_cube(2000, 2), clouds::on_grid(2000, 3),
          clouds::in_cube(20, 4), clouds::in_cube(1, 5), clouds::cloud{}}) {
        for (const double share : {0.0, 0.01, 0.3, 1.0}) {
            std::vector<bool> some(points.size());
            for (std::size_t i = 0; i < some.size(); ++i) some[i] = random.uniform() < share;
            for (const std::size_t k : {1u, 5u, 20u, 200u}) {
                const knn nearest{.k = k};
                const adjacency all = nearest(points), found = rings_of(some, points, nearest);
                ASSERT_EQ(found.size(), points.size());
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const auto ring = found[i], expected = all[i];
                    ASSERT_EQ(std::vector(ring.begin(), ring.end()),
                              some[i] ? std::vector(expected.begin(), expected.end())
                                      : std::vector<gnomon::point_index>());
                }
                EXPECT_EQ(rings_of(some, points, nearest, 2), found);
            }
        }
    }
}

TEST(knn_of_some, rings_are_right_where_many_points_coincide) {
    clouds::cloud points = clouds::in_cube(200, 1);
    points.resize(400, Eigen::Vector3d(0.5, 0.5, 0.5));
    std::vector<bool> some(points.size(), false);
    some[7] = some[300] = true;
    const adjacency all = knn{.k = 9}(points), found = rings_of(some, points, {.k = 9});
    for (const std::size_t i : {7u, 300u})
        EXPECT_EQ(std::vector(found[i].begin(), found[i].end()),
                  std::vector(all[i].begin(), all[i].end()));
}

TEST(knn_of_some, refuses_no_neighbors) {
    const clouds::cloud points = clouds::in_cube(20, 1);
    EXPECT_THROW(static_cast<void>(rings_of(std::vector<bool>(20), points, {.k = 0})),
                 std::invalid_argument);
}

}  // namespace

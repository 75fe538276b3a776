// SPDX-License-Identifier: BSL-1.0
/// The neighbors that leaves find for all points at once are those that nanoflann finds one by one.
/// Compiled once more for each set of instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "neighborhoods/sweep_clouds.hpp"
#include "oracles/nanoflann_index.hpp"
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace {

using gnomon::knn, gnomon::tie_rule;
using gnomon::detail::distances_from_points, gnomon::detail::leaf_search, gnomon::detail::leaf_tree;
using found_neighbors = gnomon::detail::found_neighbors<leaf_tree>;
using gnomon::detail::place_visitor;

void expect_the_same_neighbors(const clouds::cloud& points, std::size_t k,
                               tie_rule ties = tie_rule::by_index) {
    const auto found = knn{.k = k, .ties = ties}(points);
    const auto expected = oracles::knn_graph(points, k, ties);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_TRUE(std::ranges::equal(found[i], expected[i])) << "k " << k << ", point " << i;
}

TEST(leaf_search, matches_nanoflann) {
    for (const auto& [name, points] : clouds::to_sweep()) {
        SCOPED_TRACE(name);
        for (const std::size_t k : {1u, 8u, 19u, 26u, 130u}) expect_the_same_neighbors(points, k);
    }
}

TEST(leaf_search, keeps_the_ties_that_nanoflann_keeps) {
    for (const auto& [name, points] : clouds::to_sweep()) {
        SCOPED_TRACE(name);
        for (const std::size_t k : {1u, 17u}) expect_the_same_neighbors(points, k, tie_rule::all);
    }
}

/// As few as are compared all with all, one more, and many: all as far from one point, for they are
/// whole numbers whose squares have the same sum.
TEST(leaf_search, breaks_ties_of_equal_distances) {
    clouds::cloud shell;
    for (int x = -12; x <= 12; ++x)
        for (int y = -12; y <= 12; ++y)
            for (int z = -12; z <= 12; ++z)
                if (x * x + y * y + z * z == 146) shell.emplace_back(x, y, z);
    ASSERT_EQ(shell.size(), 192u);
    for (const std::ptrdiff_t many : {16, 17, 31, 32, 33, 192}) {
        clouds::cloud points(shell.begin(), shell.begin() + many);
        for (int i = 0; i < 12; ++i) points.emplace_back(i, 0, 0);
        for (int i = 0; i < 300; ++i) points.emplace_back(20 + i, i % 7, i % 5);
        const auto last = static_cast<std::size_t>(many) + 11;
        SCOPED_TRACE(std::to_string(many) + " as far");
        for (const std::size_t k : {std::size_t{11}, std::size_t{12}, last / 2, last - 1, last}) {
            expect_the_same_neighbors(points, k);
            expect_the_same_neighbors(points, k, tie_rule::all);
        }
    }
}

/// About full leaves and groups, and for more neighbors than there are.
TEST(leaf_search, matches_nanoflann_for_any_number_of_points) {
    for (const std::size_t n :
         {0u, 1u, 2u, 3u, 31u, 32u, 33u, 63u, 64u, 65u, 127u, 128u, 129u, 160u, 161u, 1000u}) {
        for (const auto& points : {clouds::in_cube(n, n), clouds::on_grid(n, n)}) {
            SCOPED_TRACE(std::to_string(n) + " points");
            for (const std::size_t k : {1u, 2u, 3u, 31u, 32u, 33u, 127u})
                expect_the_same_neighbors(points, k);
            for (const std::size_t k : {n - 1, n, n + 1, 2 * n + 7})
                if (k > 0) expect_the_same_neighbors(points, k);
        }
    }
}

/// These clouds are searched by leaves, except those with crowded leaves: else the comparisons in
/// this file would test the search by places instead.
TEST(leaf_search, searches_all_clouds_without_crowded_leaves) {
    std::size_t left_out = 0;
    for (const auto& [name, points] : clouds::to_sweep()) {
        const bool crowded = gnomon::spatial_index(points).tree().crowded();
        left_out += crowded;
        EXPECT_TRUE(!crowded || name.find("equal") != name.npos ||
                    name.find("origin") != name.npos || name.find("heap") != name.npos ||
                    name.find("tiny") != name.npos)
            << name;
    }
    EXPECT_GT(left_out, 0u);
}

/// What one search finds for point i, by point, in the order of the tree.
struct finding {
    std::vector<gnomon::neighbor> neighbors;
    gnomon::detail::neighborhood_sums sums;

    friend bool operator==(const finding& a, const finding& b) {
        return a.neighbors == b.neighbors && a.sums.about_point.sum == b.sums.about_point.sum &&
               a.sums.about_point.outer == b.sums.about_point.outer &&
               a.sums.mean_distance == b.sums.mean_distance;
    }
};

/// The initial search radius comes from earlier queries; results do not depend on it, to the last
/// bit.
TEST(leaf_search, does_not_depend_on_earlier_queries) {
    for (const auto& [name, points] : clouds::to_sweep()) {
        const leaf_tree tree(gnomon::position_view<clouds::cloud>(points), gnomon::sequential{});
        if (tree.size() == 0 || tree.crowded()) continue;
        SCOPED_TRACE(name);
        for (const std::size_t k : {5u, 20u}) {
            std::vector<finding> once(points.size()), afresh(points.size());
            const auto into = [&tree](std::vector<finding>& all) {
                return place_visitor(tree, [&all](std::size_t i, const found_neighbors& found) {
                    EXPECT_TRUE(all[i].neighbors.empty()) << "visited twice";
                    all[i].sums = found.summed();
                    found.sort_into(all[i].neighbors);
                });
            };
            leaf_search learning(tree, {k}, distances_from_points(tree));
            for (std::size_t g = tree.groups(); g-- > 0;) learning(g, into(once));
            for (std::size_t g = 0; g < tree.groups(); ++g)
                leaf_search(tree, {k}, distances_from_points(tree))(g, into(afresh));
            EXPECT_EQ(once, afresh);
        }
    }
}

/// Moments and mean distance of the neighbors, against plain sums.
TEST(leaf_search, accumulates_the_moments_of_the_neighbors) {
    const auto points = clouds::sheet(1000, 3);
    const leaf_tree tree(gnomon::position_view<clouds::cloud>(points), gnomon::sequential{});
    for (const std::size_t k : {1u, 3u, 4u, 5u, 7u, 8u, 9u, 20u}) {
        const auto visit = [&](std::size_t i, const found_neighbors& found) {
            ASSERT_EQ(found.size(), k);
            gnomon::moments expected;
            double distance = 0.0;
            std::vector<gnomon::neighbor> neighbors;
            found.sort_into(neighbors);
            for (const gnomon::neighbor& neighbor : neighbors) {
                const Eigen::Vector3d& q = points[neighbor.index];
                ASSERT_EQ(neighbor.squared_distance, gnomon::squared_distance(points[i], q));
                expected.add(q - points[i]);
                distance += (q - points[i]).norm() / static_cast<double>(k);
            }
            const auto [m, mean_distance] = found.summed();
            ASSERT_EQ(m.count, k);
            ASSERT_LE((m.sum - expected.sum).norm(), 1e-14 * distance * double(k));
            ASSERT_LE((m.outer - expected.outer).norm(), 1e-14 * expected.outer.norm());
            ASSERT_NEAR(mean_distance, distance, 1e-14 * distance);
        };
        leaf_search search(tree, {k}, distances_from_points(tree));
        place_visitor show(tree, visit);
        for (std::size_t g = 0; g < tree.groups(); ++g) search(g, show);
    }
}

TEST(leaf_search, is_the_same_for_any_number_of_threads) {
    const auto points = clouds::on_grid(9000, 4, 0.05);
    const auto expected = knn{.k = 20}(points);
    for (const unsigned t : {1u, 2u, 4u})
        EXPECT_EQ(knn{.k = 20}(points, gnomon::threads{t}), expected);
}

}  // namespace

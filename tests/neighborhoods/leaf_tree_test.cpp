// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>

namespace {

using gnomon::detail::leaf_box, gnomon::detail::leaf_tree;

leaf_tree tree_of(const clouds::cloud& points) {
    return {gnomon::position_view<clouds::cloud>(points), gnomon::sequential{}};
}

std::size_t end_of(const leaf_tree& tree, std::size_t leaf) {
    return std::min(tree.size(), (leaf + 1) * leaf_tree::leaf_size);
}

std::vector<clouds::named_cloud> planted_clouds() {
    auto all = clouds::degenerate();
    for (const std::size_t n : {31u, 32u, 33u, 127u, 128u, 129u, 4000u, 5000u})
        all.push_back({std::to_string(n) + " in a cube", clouds::in_cube(n, n)});
    all.push_back({"grid", clouds::on_grid(3000, 1, 0.1)});
    return all;
}

TEST(leaf_tree, holds_every_finite_point_once) {
    for (const auto& [name, points] : planted_clouds()) {
        SCOPED_TRACE(name);
        const leaf_tree tree = tree_of(points);
        std::set<std::size_t> held(tree.index(), tree.index() + tree.size());
        EXPECT_EQ(held.size(), tree.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            EXPECT_EQ(held.contains(i), gnomon::is_finite(points[i]));
        for (std::size_t at = 0; at < tree.size(); ++at) {
            const Eigen::Vector3d& p = points[tree.index()[at]];
            ASSERT_EQ(tree.position(at), (std::array{p[0], p[1], p[2]}));
        }
    }
}

/// Each leaf within a distance of a box, in their order, with the box of its points.
TEST(leaf_tree, gives_all_leaves_near_a_box) {
    for (const auto& [name, points] : planted_clouds()) {
        SCOPED_TRACE(name);
        const leaf_tree tree = tree_of(points);
        std::vector<leaf_box> boxes;
        for (std::size_t leaf = 0; leaf < tree.leaves(); ++leaf) {
            const std::size_t first = leaf * leaf_tree::leaf_size;
            leaf_box box{tree.position(first), tree.position(first)};
            for (std::size_t at = first; at < end_of(tree, leaf); ++at) box.add(tree.position(at));
            boxes.push_back(box);
        }
        for (std::size_t leaf = 0; leaf < tree.leaves(); leaf += 7) {
            for (const double distance : {0.0, 0.13, 0.57, 1e200}) {
                std::vector<std::size_t> expected, found;
                for (std::size_t l = 0; l < boxes.size(); ++l)
                    if (boxes[l].squared_distance_to(boxes[leaf]) <= distance * distance)
                        expected.push_back(l);
                tree.for_each_leaf_near(boxes[leaf], distance, [&](std::size_t l, const auto& b) {
                    found.push_back(l);
                    EXPECT_TRUE(b.low == boxes[l].low && b.high == boxes[l].high);
                });
                ASSERT_EQ(found, expected);
            }
        }
    }
}

/// Walks through the nodes below one, and holds their boxes against the points in them.
/// @return the next in preorder
std::size_t walk(const leaf_tree& tree, const leaf_tree::subtree& t) {
    const std::size_t first = t.first * leaf_tree::leaf_size;
    leaf_box box{tree.position(first), tree.position(first)};
    for (std::size_t at = first; at < end_of(tree, t.last - 1); ++at) box.add(tree.position(at));
    EXPECT_TRUE(tree.box(t).low == box.low && tree.box(t).high == box.high);
    if (t.is_leaf()) return t.node + 1;
    const auto [left, right] = t.children();
    EXPECT_EQ(left.node, t.node + 1);
    EXPECT_EQ(left.first, t.first);
    EXPECT_EQ(left.last, right.first);
    EXPECT_EQ(right.last, t.last);
    EXPECT_EQ(walk(tree, left), right.node);
    return walk(tree, right);
}

TEST(leaf_tree, can_be_walked_through_in_preorder) {
    for (const auto& [name, points] : planted_clouds()) {
        SCOPED_TRACE(name);
        const leaf_tree tree = tree_of(points);
        if (tree.size() == 0) continue;
        EXPECT_EQ(walk(tree, tree.root()), tree.nodes());
    }
}

/// Six leaves are split into four and two, not into halves: what is longest, x, parts the groups.
TEST(leaf_tree, splits_between_groups_before_it_splits_groups) {
    auto points = clouds::in_cube(6 * leaf_tree::leaf_size, 6);
    for (auto& p : points) p = {1.1 * p.x(), p.y(), 0.0};
    const leaf_tree tree = tree_of(points);
    ASSERT_EQ(tree.groups(), 2u);
    const double* const x = tree.at(0);
    EXPECT_LT(*std::max_element(x, x + 128), *std::min_element(x + 128, x + tree.size()));
}

TEST(leaf_tree, is_the_same_for_any_number_of_threads) {
    const auto points = clouds::on_grid(20'000, 4, 0.05);
    const leaf_tree expected = tree_of(points);
    for (const unsigned t : {2u, 4u}) {
        const leaf_tree tree(gnomon::position_view<clouds::cloud>(points), gnomon::threads{t});
        EXPECT_TRUE(std::equal(tree.index(), tree.index() + tree.size(), expected.index()));
    }
}

/// Fewer points than a leaf holds cannot fill one. More may share leaves with others, but not many
/// more.
TEST(leaf_tree, reports_crowded_leaves) {
    for (const std::size_t heap : {31u, 2000u}) {
        auto points = clouds::in_cube(5000, 5);
        std::fill_n(points.begin() + 100, heap, Eigen::Vector3d(0.5, 0.5, 0.5));
        EXPECT_EQ(tree_of(points).crowded(), heap > 31);
    }
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/recognition/random_trees.hpp>
#include <gnomon/recognition/random_trees_options.hpp>

namespace rec = gnomon::recognition;

namespace {

constexpr std::size_t columns = 16;

/// Two classes that overlap, so that options matter.
rec::labeled_samples overlapping_samples() {
    gnomon::random_stream random(1);
    rec::labeled_samples s;
    for (std::size_t i = 0; i < 120; ++i) {
        const auto c = static_cast<std::uint32_t>(i % 2);
        std::vector<double> x(columns);
        for (double& value : x) value = random.gaussian() + 0.5 * c;
        s.add(x, c);
    }
    return s;
}

std::vector<double> use_with(const rec::random_trees_options& options) {
    return rec::random_trees(overlapping_samples(), 2, options).use_of_columns(columns);
}

TEST(random_trees_options, no_features_per_split_stands_for_twice_the_root_of_all) {
    EXPECT_EQ(use_with({.trees = 10}), use_with({.trees = 10, .features_per_split = 8}));
    EXPECT_NE(use_with({.trees = 10}), use_with({.trees = 10, .features_per_split = 4}));
}

TEST(random_trees_options, seeds_differ_and_one_seed_gives_the_same_trees) {
    EXPECT_EQ(use_with({.trees = 10, .seed = 5}), use_with({.trees = 10, .seed = 5}));
    EXPECT_NE(use_with({.trees = 10, .seed = 5}), use_with({.trees = 10, .seed = 6}));
}

TEST(random_trees_options, nodes_below_min_split_are_leaves) {
    const std::vector<double> none(columns, 0.0);
    EXPECT_EQ(use_with({.trees = 10, .min_split = 121}), none);
    EXPECT_NE(use_with({.trees = 10, .min_split = 120}), none);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/random_trees.hpp>

namespace rec = gnomon::recognition;

namespace {

/// Gaussian samples of `classes` classes, whose means differ by `apart` in two of six features.
rec::labeled_samples tree_samples(std::size_t n, std::uint32_t classes, double apart,
                                  std::uint64_t seed) {
    gnomon::random_stream random(seed);
    rec::labeled_samples s;
    for (std::size_t i = 0; i < n; ++i) {
        const auto c = static_cast<std::uint32_t>(i % classes);
        std::vector<double> x(6);
        for (double& value : x) value = random.gaussian();
        x[1] += apart * c;
        x[4] -= apart * c;
        s.add(x, c);
    }
    return s;
}

std::vector<double> tree_probability(const rec::random_trees& trees, std::span<const double> x) {
    std::vector<double> p(trees.classes(), 0.0);
    trees.add_probability(x, p);
    return p;
}

double tree_accuracy(const rec::random_trees& trees, const rec::labeled_samples& s) {
    double right = 0.0;
    for (std::size_t i = 0; i < s.rows(); ++i) {
        const auto p = tree_probability(trees, s.row(i));
        right += std::max_element(p.begin(), p.end()) - p.begin() == s.classes[i];
    }
    return right / static_cast<double>(s.rows());
}

TEST(random_trees, separate_planted_classes) {
    const rec::random_trees trees(tree_samples(150, 3, 6.0, 1), 3, {.trees = 60});
    EXPECT_GT(tree_accuracy(trees, tree_samples(300, 3, 6.0, 2)), 0.99);
}

/// Overlapping classes: the best rule is right in Phi(sqrt(2) / 2 * 1.5) = 0.856 of all cases.
TEST(random_trees, come_near_the_best_rule_where_classes_overlap) {
    const rec::random_trees trees(tree_samples(600, 2, 1.5, 1), 2, {.trees = 100, .min_split = 10});
    const double accuracy = tree_accuracy(trees, tree_samples(2000, 2, 1.5, 2));
    EXPECT_GT(accuracy, 0.82);
    EXPECT_LT(accuracy, 0.88);
}

TEST(random_trees, use_the_columns_that_separate) {
    const rec::random_trees trees(tree_samples(150, 3, 6.0, 1), 3, {.trees = 60});
    const auto use = trees.use_of_columns(6);
    double sum = 0.0;
    for (std::size_t k = 0; k < use.size(); ++k) {
        sum += use[k];
        if (k == 1 || k == 4) continue;
        EXPECT_LT(10.0 * use[k], std::min(use[1], use[4])) << k;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    rec::labeled_samples same;
    same.add(std::vector<double>(2, 1.0), 0);
    same.add(std::vector<double>(2, 1.0), 1);
    EXPECT_EQ(rec::random_trees(same, 2).use_of_columns(2), std::vector<double>(2, 0.0));
}

TEST(random_trees, fit_their_own_samples) {
    const auto s = tree_samples(100, 4, 0.2, 3);
    EXPECT_EQ(tree_accuracy(rec::random_trees(s, 4, {.trees = 20}), s), 1.0);
}

TEST(random_trees, have_probabilities_that_sum_to_one) {
    const rec::random_trees trees(tree_samples(90, 3, 1.0, 4), 5, {.trees = 37, .min_split = 8});
    const auto s = tree_samples(200, 3, 1.0, 5);
    for (std::size_t i = 0; i < s.rows(); ++i) {
        const auto p = tree_probability(trees, s.row(i));
        double sum = 0.0;
        for (const double x : p) {
            EXPECT_GE(x, 0.0);
            sum += x;
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
        EXPECT_EQ(p[3] + p[4], 0.0);  // classes without samples
    }
}

TEST(random_trees, do_not_depend_on_threads) {
    const auto s = tree_samples(120, 3, 1.0, 6), other = tree_samples(50, 3, 1.0, 7);
    const rec::random_trees one(s, 3, {.trees = 30});
    for (const unsigned n : {1u, 2u, 4u}) {
        const rec::random_trees many(s, 3, {.trees = 30}, gnomon::threads{n});
        for (std::size_t i = 0; i < other.rows(); ++i)
            EXPECT_EQ(tree_probability(one, other.row(i)), tree_probability(many, other.row(i)));
    }
}

TEST(random_trees, depend_on_the_seed_alone) {
    const auto s = tree_samples(60, 2, 0.5, 8);
    const rec::random_trees a(s, 2, {.trees = 10, .seed = 5}), same(s, 2, {.trees = 10, .seed = 5}),
        b(s, 2, {.trees = 10, .seed = 6});
    const auto other = tree_samples(100, 2, 0.5, 9);
    bool differs = false;
    for (std::size_t i = 0; i < other.rows(); ++i) {
        const auto p = tree_probability(a, other.row(i));
        EXPECT_EQ(p, tree_probability(same, other.row(i)));
        differs = differs || p != tree_probability(b, other.row(i));
    }
    EXPECT_TRUE(differs);
}

/// Constant features cannot be split: the shares of the classes remain.
TEST(random_trees, give_the_shares_of_the_classes_without_a_split) {
    rec::labeled_samples s;
    for (const std::uint32_t c : {0u, 0u, 1u, 0u}) s.add(std::vector<double>{1.0, -2.0}, c);
    const auto p = tree_probability(rec::random_trees(s, 2, {.trees = 5}), s.row(0));
    EXPECT_NEAR(p[0], 0.75, 1e-15);
    EXPECT_NEAR(p[1], 0.25, 1e-15);

    const auto varied = tree_samples(40, 2, 1.0, 10);
    const rec::random_trees leaves(varied, 2, {.trees = 5, .min_split = 100});
    EXPECT_NEAR(tree_probability(leaves, varied.row(0))[0], 0.5, 1e-15);
}

TEST(random_trees, have_one_class_or_one_sample) {
    rec::labeled_samples s;
    s.add(std::vector<double>{3.0}, 0);
    const rec::random_trees one(s, 1);
    EXPECT_NEAR(tree_probability(one, std::vector<double>{-1e9})[0], 1.0, 1e-12);
    EXPECT_EQ(rec::random_trees{}.classes(), 0u);
}

/// The next number above a value is another value.
TEST(random_trees, separate_values_that_differ_in_the_last_bit) {
    rec::labeled_samples s;
    s.add(std::vector<double>{1.0}, 0);
    s.add(std::vector<double>{std::nextafter(1.0, 2.0)}, 1);
    EXPECT_EQ(tree_accuracy(rec::random_trees(s, 2, {.trees = 10}), s), 1.0);
    rec::labeled_samples wide;
    wide.add(std::vector<double>{-1e308}, 0);
    wide.add(std::vector<double>{1e308}, 1);
    const auto p = tree_probability(rec::random_trees(wide, 2, {.trees = 10}), wide.row(0));
    EXPECT_NEAR(p[0] + p[1], 1.0, 1e-12);
}

TEST(random_trees, refuse_what_they_cannot_grow_on) {
    const auto s = tree_samples(10, 2, 1.0, 11);
    EXPECT_THROW(rec::random_trees(rec::labeled_samples{}, 2), std::invalid_argument);
    EXPECT_THROW(rec::random_trees(s, 1), std::invalid_argument);
    for (const std::size_t trees : {std::size_t{0}, std::numeric_limits<std::size_t>::max()})
        EXPECT_THROW(rec::random_trees(s, 2, {.trees = trees}), std::invalid_argument);
    rec::labeled_samples no_columns;
    no_columns.add({}, 0);
    EXPECT_THROW(rec::random_trees(no_columns, 1), std::invalid_argument);
}

TEST(random_trees, refuse_samples_that_do_not_fit_together) {
    auto s = tree_samples(10, 2, 1.0, 12);
    s.values.resize(s.values.size() - s.columns);
    s.values.reserve(1000);
    EXPECT_THROW(rec::random_trees(s, 2, {.trees = 1}), std::invalid_argument);
    auto nan = tree_samples(10, 2, 1.0, 12);
    nan.values[7] = std::nan("");
    EXPECT_THROW(rec::random_trees(nan, 2, {.trees = 1}), std::invalid_argument);
}

}  // namespace

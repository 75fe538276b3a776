// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>

#include <gtest/gtest.h>

#include "samples.hpp"
#include <gnomon/recognition/x_means.hpp>

namespace {

using gnomon::recognition::x_means;
using gnomon::recognition::x_means_options;

/// Normal clusters on a grid, well apart: their number is found, and their members.
TEST(x_means, finds_planted_clusters) {
    for (const std::size_t side : {2u, 3u, 4u}) {
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
            gnomon::random_stream random(seed);
            samples::rows<3> p;
            std::vector<std::ptrdiff_t> truth;
            for (std::size_t i = 0; i < 60 * side * side; ++i) {
                const std::size_t c = i % (side * side);
                p.push_back({static_cast<double>(c / side), static_cast<double>(c % side), 0.5});
                for (double& value : p.back()) value += 0.05 * random.gaussian();
                truth.push_back(static_cast<std::ptrdiff_t>(c));
            }
            const auto found = x_means(p, {.seed = seed});
            EXPECT_EQ(found.clusters.size(), side * side);
            EXPECT_GT(samples::adjusted_rand_index(found.labels, truth), 0.98);
        }
    }
}

TEST(x_means, does_not_split_one_normal_distribution) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        gnomon::random_stream random(seed);
        const auto p = samples::gaussian<5>(400, random);
        EXPECT_EQ(x_means(p, {.min_clusters = 1, .seed = seed}).clusters.size(), 1u);
    }
}

TEST(x_means, statistics_and_labels_agree) {
    const auto [p, truth] = samples::planted<5>(9, 40, 0.03, 2);
    const auto found = x_means(p, {.seed = 3});
    std::size_t count = 0;
    for (std::size_t c = 0; c < found.clusters.size(); ++c) {
        gnomon::recognition::cluster_statistics<5> grown;
        for (const std::size_t i : found.members(static_cast<std::ptrdiff_t>(c))) grown.add(p[i]);
        EXPECT_EQ(grown, found.clusters[c]);
        count += grown.count;
        if (c > 0) {
            EXPECT_LT(found.members(static_cast<std::ptrdiff_t>(c) - 1).front(),
                      found.members(static_cast<std::ptrdiff_t>(c)).front());
        }
    }
    EXPECT_EQ(count, p.size());
    EXPECT_EQ(x_means(p, {.seed = 3}).labels, found.labels);
}

TEST(x_means, keeps_to_its_range_of_clusters) {
    const auto [p, truth] = samples::planted<2>(16, 40, 0.005, 8);
    EXPECT_LE(x_means(p, {.max_clusters = 5}).clusters.size(), 5u);
    EXPECT_EQ(x_means(p, {.min_clusters = 30, .max_clusters = 30}).clusters.size(), 30u);
    EXPECT_EQ(x_means(p, {.min_clusters = 1, .max_clusters = 1}).clusters.size(), 1u);
}

/// With room for one split, that of the clusters that are farther apart is made.
TEST(x_means, splits_where_most_is_gained) {
    gnomon::random_stream random(1);
    samples::rows<1> p;
    for (const double center : {0.0, 0.5, 100.0, 104.0})
        for (int i = 0; i < 50; ++i) p.push_back({center + 0.01 * random.gaussian()});
    const auto found = x_means(p, {.max_clusters = 3});
    ASSERT_EQ(found.clusters.size(), 3u);
    EXPECT_EQ(found.labels[0], found.labels[50]);
    EXPECT_NE(found.labels[100], found.labels[150]);
}

/// The criterion against its definition as a sum of log densities of the mixture's components.
TEST(x_means, information_criterion_is_that_of_the_likelihood) {
    gnomon::random_stream random(6);
    std::vector<samples::rows<3>> groups{samples::gaussian<3>(40, random),
                                         samples::gaussian<3>(25, random)};
    std::vector<gnomon::recognition::cluster_statistics<3>> clusters(2);
    for (std::size_t c = 0; c < 2; ++c)
        for (const auto& x : groups[c]) clusters[c].add(x);
    double squares = 0.0, log_likelihood = 0.0;
    const auto squared = [&](const auto& x, std::size_t c) {
        return gnomon::recognition::detail::squared_distance(x, clusters[c].mean);
    };
    for (std::size_t c = 0; c < 2; ++c)
        for (const auto& x : groups[c]) squares += squared(x, c);
    const double variance = squares / (3.0 * 63.0);
    for (std::size_t c = 0; c < 2; ++c)
        for (const auto& x : groups[c])
            log_likelihood += std::log(static_cast<double>(groups[c].size()) / 65.0) -
                              1.5 * std::log(2.0 * std::acos(-1.0) * variance) -
                              0.5 * squared(x, c) / variance;
    EXPECT_NEAR(gnomon::recognition::detail::information_criterion(clusters),
                log_likelihood - 0.5 * 8.0 * std::log(65.0), 1e-9);
}

TEST(x_means, of_degenerate_samples) {
    using rows = samples::rows<2>;
    EXPECT_TRUE(x_means(rows{}).clusters.empty());
    EXPECT_EQ(x_means(rows{{1, 2}}).clusters.size(), 1u);
    EXPECT_EQ(x_means(rows(20, {1, 2})).clusters.size(), 1u);
    rows two(20, {1, 2});
    for (std::size_t i = 0; i < 10; ++i) two[i] = {3, 2};
    for (const std::size_t least : {1u, 2u}) {
        const auto found = x_means(two, {.min_clusters = least});
        EXPECT_EQ(found.clusters.size(), 2u);
        EXPECT_EQ(found.clusters[0].scatter[0][0], 0.0);
    }
}

TEST(x_means, refuses_bad_input) {
    samples::rows<2> p(5, {1, 2});
    EXPECT_THROW((void)x_means(p, {.min_clusters = 0}), std::invalid_argument);
    EXPECT_THROW((void)x_means(p, {.min_clusters = 3, .max_clusters = 2}), std::invalid_argument);
    p[1][1] = samples::nan;
    EXPECT_THROW((void)x_means(p), std::invalid_argument);
}

}  // namespace

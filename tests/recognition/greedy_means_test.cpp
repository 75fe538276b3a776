// SPDX-License-Identifier: BSL-1.0
#include <cstdio>
#include <span>
#include <stdexcept>

#include <gtest/gtest.h>

#include "samples.hpp"
#include <gnomon/recognition/greedy_means.hpp>

namespace {

using gnomon::recognition::cluster_statistics;
using gnomon::recognition::clustering;
using gnomon::recognition::greedy_means;
using gnomon::recognition::greedy_means_options;
using gnomon::recognition::streaming_greedy_means;

using part_rows = samples::rows<5>;

greedy_means_options<5> thesis_options(double rho) {
    return {.max_distance = rho, .min_members = 4, .distance = {{.30, .30, .13, .13, .13}}};
}

/// Alg. 5.1, line by line, on lists of members: the oracle of labels.
std::vector<std::ptrdiff_t> printed_algorithm(const part_rows& p,
                                              const greedy_means_options<5>& o) {
    std::vector<std::vector<std::size_t>> c(p.size());
    part_rows m = p;
    for (std::size_t i = 0; i < p.size(); ++i) c[i] = {i};
    for (std::size_t i = 0; i < c.size(); ++i) {
        for (std::size_t j = i + 1; j < c.size(); ++j) {
            if (o.distance(m[i], m[j]) > o.max_distance) continue;
            const auto a = static_cast<double>(c[i].size()), b = static_cast<double>(c[j].size());
            c[i].insert(c[i].end(), c[j].begin(), c[j].end());
            for (std::size_t k = 0; k < 5; ++k)
                m[i][k] = a / (a + b) * m[i][k] + b / (a + b) * m[j][k];
            c.erase(c.begin() + static_cast<std::ptrdiff_t>(j));
            m.erase(m.begin() + static_cast<std::ptrdiff_t>(j));
            --j;
        }
    }
    std::vector<std::ptrdiff_t> labels(p.size(), -1);
    std::ptrdiff_t label = 0;
    for (const auto& members : c) {
        if (members.size() < o.min_members) continue;
        for (const std::size_t i : members) labels[i] = label;
        ++label;
    }
    return labels;
}

TEST(greedy_means, is_the_printed_algorithm) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto [p, truth] = samples::planted<5>(8, 25, 0.05, seed);
        for (const double rho : {0.0, 0.03, 0.10, 0.5}) {
            const auto found = greedy_means(p, thesis_options(rho));
            EXPECT_EQ(found.labels, printed_algorithm(p, thesis_options(rho)));
        }
        auto printed = thesis_options(0.01);
        printed.distance.sum = gnomon::recognition::difference_sum::as_printed;
        EXPECT_EQ(greedy_means(p, printed).labels, printed_algorithm(p, printed));
    }
}

/// Members in their order lead to the statistics, and each was within rho_max of the mean then.
void expect_merges_within(const part_rows& p, const clustering<5>& found,
                          const greedy_means_options<5>& o) {
    for (std::size_t c = 0; c < found.clusters.size(); ++c) {
        cluster_statistics<5> grown;
        for (const std::size_t i : found.members(static_cast<std::ptrdiff_t>(c))) {
            if (grown.count > 0) {
                EXPECT_LE(o.distance(grown.mean, p[i]), o.max_distance);
            }
            grown.add(p[i]);
        }
        EXPECT_EQ(grown, found.clusters[c]);
    }
}

TEST(greedy_means, merges_within_the_distance_of_the_mean) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto [p, truth] = samples::planted<5>(10, 30, 0.06, seed);
        const auto options = thesis_options(0.05);
        expect_merges_within(p, greedy_means(p, options), options);
        streaming_greedy_means<5> stream(options);
        clustering<5> streamed;
        for (const auto& x : p)
            streamed.labels.push_back(static_cast<std::ptrdiff_t>(stream.add(x)));
        streamed.clusters = stream.clusters();
        expect_merges_within(p, streamed, options);
    }
}

TEST(greedy_means, prunes_clusters_with_fewer_than_the_least_number) {
    const samples::rows<1> p{{0.0}, {1.0}, {0.0}, {2.0}, {1.0}, {0.0}};
    const auto found = greedy_means(p, {.max_distance = 0.1, .min_members = 2});
    EXPECT_EQ(found.labels, (std::vector<std::ptrdiff_t>{0, 1, 0, -1, 1, 0}));
    ASSERT_EQ(found.clusters.size(), 2u);
    EXPECT_EQ(found.clusters[0].count, 3u);
    EXPECT_EQ(found.members(found.pruned), (std::vector<std::size_t>{3}));
    EXPECT_EQ(greedy_means(p, {.max_distance = 0.1, .min_members = 4}).clusters.size(), 0u);
}

/// Batch visits all samples per cluster: the mean of {0, .08, .16} reaches .16 only after .08 was
/// merged. Streaming takes the nearest mean.
TEST(greedy_means, batch_and_streaming_differ) {
    const samples::rows<1> p{{0.0}, {0.15}, {0.08}};
    const greedy_means_options<1> options{.max_distance = 0.1, .min_members = 1};
    EXPECT_EQ(greedy_means(p, options).labels, (std::vector<std::ptrdiff_t>{0, 1, 0}));
    streaming_greedy_means<1> stream(options);
    EXPECT_EQ(stream.add(p[0]), 0u);
    EXPECT_EQ(stream.add(p[1]), 1u);
    EXPECT_EQ(stream.add(p[2]), 1u);
    EXPECT_EQ(stream.clusters()[1].count, 2u);
}

/// Of two equally near means the oldest; the threshold itself is within.
TEST(streaming_greedy_means, ties) {
    streaming_greedy_means<1> stream({.max_distance = 0.5});
    EXPECT_EQ(stream.add({0.0}), 0u);
    EXPECT_EQ(stream.add({1.0}), 1u);
    EXPECT_EQ(stream.add({0.5}), 0u);
    EXPECT_EQ(stream.add({1.5}), 1u);
    EXPECT_EQ(stream.add({10.0}), 2u);
}

/// Interrupted, stored and continued: the same clusters, to the last bit.
TEST(streaming_greedy_means, continues_where_it_was_interrupted) {
    const auto [p, truth] = samples::planted<5>(12, 50, 0.05, 4);
    const auto options = thesis_options(0.03);
    streaming_greedy_means<5> whole(options);
    std::vector<std::size_t> labels, continued;
    for (const auto& x : p) labels.push_back(whole.add(x));
    std::vector<cluster_statistics<5>> stored;
    for (std::size_t first = 0; first < p.size(); first += 77) {
        streaming_greedy_means<5> part(options, stored);
        for (std::size_t i = first; i < std::min(first + 77, p.size()); ++i)
            continued.push_back(part.add(p[i]));
        stored = part.clusters();
    }
    EXPECT_EQ(labels, continued);
    EXPECT_EQ(whole.clusters(), stored);
}

/// The order of the samples changes the clusters "slightly" (Sec. 5.2.3): little where clusters are
/// apart. The figures for clusters that overlap are only printed.
TEST(greedy_means, depends_little_on_the_order_of_separate_clusters) {
    for (const double sigma : {0.01, 0.05}) {
        double least_batch = 1.0, least_stream = 1.0;
        const auto [p, truth] = samples::planted<5>(20, 40, sigma, 5);
        const auto options = thesis_options(0.10);
        const auto first = greedy_means(p, options).labels;
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const auto order = samples::permutation(p.size(), seed);
            part_rows permuted;
            for (const std::size_t i : order) permuted.push_back(p[i]);
            const auto found = greedy_means(permuted, options).labels;
            streaming_greedy_means<5> stream(options);
            std::vector<std::ptrdiff_t> batch(p.size()), streamed(p.size());
            for (std::size_t i = 0; i < order.size(); ++i) {
                batch[order[i]] = found[i];
                streamed[order[i]] = static_cast<std::ptrdiff_t>(stream.add(permuted[i]));
            }
            least_batch = std::min(least_batch, samples::adjusted_rand_index(first, batch));
            least_stream = std::min(least_stream, samples::adjusted_rand_index(first, streamed));
        }
        std::printf("sigma %.2f: least adjusted Rand index of batch %.3f, of streaming %.3f\n",
                    sigma, least_batch, least_stream);
        if (sigma > 0.02) continue;
        EXPECT_GE(least_batch, 0.8);
        EXPECT_GE(least_stream, 0.8);
    }
}

TEST(greedy_means, of_degenerate_samples) {
    EXPECT_TRUE(greedy_means(part_rows{}).clusters.empty());
    EXPECT_TRUE(greedy_means(part_rows{}).labels.empty());
    const part_rows constant(10, {1, 2, 3, 4, 5});
    const auto found = greedy_means(constant, {.max_distance = 0.0});
    ASSERT_EQ(found.clusters.size(), 1u);
    EXPECT_EQ(found.clusters[0].mean, constant[0]);
    EXPECT_EQ(found.clusters[0].covariance()[2][3], 0.0);
    EXPECT_EQ(greedy_means(part_rows{constant[0]}, {.min_members = 1}).labels[0], 0);
    EXPECT_EQ(greedy_means(std::span(constant)).labels, found.labels);
}

TEST(greedy_means, refuses_bad_input) {
    const part_rows one{{1, 2, 3, 4, 5}};
    for (const double bad : {samples::nan, samples::infinity, -samples::infinity, 1e101}) {
        part_rows p = one;
        p[0][3] = bad;
        EXPECT_THROW((void)greedy_means(p), std::invalid_argument);
        streaming_greedy_means<5> stream;
        stream.add(one[0]);
        EXPECT_THROW(stream.add(p[0]), std::invalid_argument);
        EXPECT_EQ(stream.clusters().size(), 1u);
        EXPECT_EQ(stream.clusters()[0].count, 1u);
    }
    for (const double bad : {-0.1, samples::nan, samples::infinity}) {
        EXPECT_THROW((void)greedy_means(one, {.max_distance = bad}), std::invalid_argument);
        EXPECT_THROW(streaming_greedy_means<5>({.max_distance = bad}), std::invalid_argument);
    }
    EXPECT_THROW((void)greedy_means(one, {.distance = {{-1, 1, 1, 1, 1}}}), std::invalid_argument);
    EXPECT_THROW((void)greedy_means(one, {.distance = {{0, 0, 0, 0, 0}}}), std::invalid_argument);
    std::vector<cluster_statistics<5>> broken(1);
    EXPECT_THROW(streaming_greedy_means<5>({}, broken), std::invalid_argument);
    broken[0].add(one[0]);
    broken[0].scatter[1][1] = samples::nan;
    EXPECT_THROW(streaming_greedy_means<5>({}, broken), std::invalid_argument);
}

}  // namespace

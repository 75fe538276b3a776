// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/recognition/detail/chi_squared.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/relation_words.hpp>

namespace rec = gnomon::recognition;

namespace {

/// Values of an angle and of a distance: planted ones, or spread over all bins.
std::array<double, 2> planted_relation(double angle, double distance,
                                       gnomon::random_stream& random) {
    return {angle + 0.02 * random.gaussian(), distance + 0.01 * random.gaussian()};
}
std::array<double, 2> spread_relation(std::size_t i, std::size_t n) {
    const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    return {3.14 * at, 2.0 * at};  // 36 and 40 bins
}

/// Sec. 5.2.4, Fig. 5.1: the pair with one angle is found, that with any angle is not.
TEST(relation_words, finds_a_planted_relation_only) {
    gnomon::random_stream random(1);
    rec::relation_statistics<2> statistics;
    for (std::size_t i = 0; i < 200; ++i) {
        statistics.add(10, 3, planted_relation(1.56, 0.42, random));
        auto angle_only = spread_relation(i, 200);
        angle_only[0] = 0.5 + 0.02 * random.gaussian();
        statistics.add(1, 2, angle_only);
        statistics.add(4, 5, spread_relation(i, 200));
    }
    const auto words = statistics.words(rec::thesis_relations, 4);
    ASSERT_EQ(words.size(), 3u);
    EXPECT_EQ(words[0].first, 1u);
    EXPECT_EQ(words[0].second, 2u);
    EXPECT_EQ(words[0].relation, 0u);
    for (std::size_t r = 0; r < 2; ++r) {
        const auto& w = words[1 + r];
        EXPECT_EQ(w.first, 3u);
        EXPECT_EQ(w.second, 10u);
        EXPECT_EQ(w.relation, r);
        EXPECT_NEAR(w.mean, r == 0 ? 1.56 : 0.42, 0.01);
    }
    EXPECT_EQ(words[1].deviation, rec::normal_angle{}.min_deviation);
}

TEST(relation_words, has_mean_and_deviation_of_the_values) {
    rec::relation_statistics<2> statistics;
    for (const double x : {1.0, 1.2, 1.4}) statistics.add(0, 1, {x, x});
    const auto words = statistics.words(rec::thesis_relations, 3);
    ASSERT_EQ(words.size(), 2u);
    for (const auto& w : words) {
        EXPECT_NEAR(w.mean, 1.2, 1e-12);
        EXPECT_NEAR(w.deviation, std::sqrt(0.08 / 3.0), 1e-12);
    }
}

/// All n (n + 1) / 2 pairs, those of a word with itself among them, in either order.
TEST(relation_words, counts_pairs_of_all_words) {
    gnomon::random_stream random(2);
    constexpr std::size_t n = 6;
    rec::relation_statistics<2> statistics, reversed;
    for (int i = 0; i < 10; ++i) {
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = a; b < n; ++b) {
                const auto values = planted_relation(1.0, 0.5, random);
                statistics.add(a, b, values);
                reversed.add(b, a, values);
            }
        }
    }
    const auto words = statistics.words(rec::thesis_relations, 4);
    const auto same = reversed.words(rec::thesis_relations, 4);
    ASSERT_EQ(words.size(), 2 * n * (n + 1) / 2);
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < words.size(); ++i) {
        EXPECT_LE(words[i].first, words[i].second);
        EXPECT_EQ(words[i].mean, same[i].mean);
        pairs.emplace(words[i].first, words[i].second);
    }
    EXPECT_EQ(pairs.size(), n * (n + 1) / 2);
    EXPECT_TRUE(pairs.contains({2, 2}));
}

TEST(relation_words, need_support) {
    rec::relation_statistics<2> statistics;
    for (int i = 0; i < 3; ++i) statistics.add(0, 1, {1.0, 0.5});
    EXPECT_TRUE(statistics.words(rec::thesis_relations, 4).empty());
    EXPECT_EQ(statistics.words(rec::thesis_relations, 3).size(), 2u);
    EXPECT_TRUE(rec::relation_statistics<2>{}.words(rec::thesis_relations, 0).empty());
}

/// The fullest bin must hold more than the critical mass, not just as much.
TEST(relation_words, need_more_than_the_critical_mass) {
    const auto one = boost::hana::make_tuple(rec::centroid_distance{.bin = 1.0, .mass = 0.5});
    rec::relation_statistics<1> statistics;
    for (const double x : {0.5, 0.6, 5.5, 7.5}) statistics.add(0, 1, {x});
    EXPECT_TRUE(statistics.words(one, 1).empty());
    statistics.add(0, 1, {0.7});
    EXPECT_EQ(statistics.words(one, 1).size(), 1u);
}

/// Eq. (5.4), Sec. 5.6.2: 99 % of Gaussian values within 2.576 deviations.
TEST(relation_word, detects_the_wanted_share_of_inliers) {
    const double delta = std::sqrt(rec::detail::chi_squared_quantile(0.99, 1));
    EXPECT_NEAR(delta, 2.5758, 1e-4);
    const rec::relation_word word{.mean = 1.2, .deviation = 0.3};
    gnomon::random_stream random(3);
    int inside = 0;
    for (int i = 0; i < 100000; ++i) inside += word.detects(1.2 + 0.3 * random.gaussian(), delta);
    EXPECT_NEAR(inside / 100000.0, 0.99, 0.001);
    EXPECT_FALSE(word.detects(std::nan(""), delta));
}

TEST(relation_words, work_without_relations) {
    rec::relation_statistics<0> statistics;
    statistics.add(0, 1, {});
    EXPECT_TRUE(statistics.words(rec::no_relations, 1).empty());
}

}  // namespace

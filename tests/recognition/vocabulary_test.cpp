// SPDX-License-Identifier: BSL-1.0
#include <cstdio>
#include <stdexcept>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "samples.hpp"
#include <gnomon/recognition/greedy_means.hpp>
#include <gnomon/recognition/vocabulary.hpp>

namespace {

using gnomon::recognition::cluster_statistics;
using gnomon::recognition::covariance_repair;
using gnomon::recognition::make_vocabulary;
using gnomon::recognition::vocabulary_options;

template <std::size_t D>
cluster_statistics<D> cluster_of(const samples::rows<D>& p) {
    cluster_statistics<D> c;
    for (const auto& x : p) c.add(x);
    return c;
}

template <std::size_t D>
auto as_matrix(const std::array<std::array<double, D>, D>& a) {
    Eigen::Matrix<double, static_cast<int>(D), static_cast<int>(D)> m;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) m(static_cast<int>(i), static_cast<int>(j)) = a[i][j];
    return m;
}

constexpr covariance_repair both[] = {covariance_repair::pooled, covariance_repair::diagonal};

/// 99 % of new samples of a cluster are detected, where the added variance is small.
TEST(vocabulary, detects_the_given_part_of_normal_samples) {
    for (const double p : {0.99, 0.9}) {
        for (const covariance_repair repair : both) {
            gnomon::random_stream random(11);
            std::vector<cluster_statistics<5>> clusters;
            std::vector<samples::rows<5>> fresh;
            for (int c = 0; c < 4; ++c) {
                const auto all =
                    samples::correlated<5>(16'000, 2.0, {10.0 * c, 0, 0, 0, 0}, random);
                clusters.push_back(cluster_of(samples::rows<5>(all.begin(), all.begin() + 8000)));
                fresh.emplace_back(all.begin() + 8000, all.end());
            }
            const auto words =
                make_vocabulary(clusters, {.repair = repair, .inlier_probability = p});
            std::size_t inliers = 0, count = 0;
            for (std::size_t c = 0; c < 4; ++c) {
                for (const auto& x : fresh[c]) {
                    ++count;
                    for (const auto& d : words.detections(x)) inliers += d.word == c ? 1 : 0;
                }
            }
            const double rate = static_cast<double>(inliers) / static_cast<double>(count);
            EXPECT_NEAR(rate, p, p == 0.99 ? 0.005 : 0.01);
        }
    }
}

/// Words of four members in five dimensions, of one repeated member, and of one constant feature:
/// every covariance can be inverted and is positive definite.
TEST(vocabulary, has_positive_definite_covariances_only) {
    for (const covariance_repair repair : both) {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            gnomon::random_stream random(seed);
            std::vector<cluster_statistics<5>> clusters;
            for (int c = 0; c < 6; ++c)
                clusters.push_back(cluster_of(samples::correlated<5>(4, 0.02, {}, random)));
            clusters.push_back(cluster_of(samples::rows<5>(4, {1, 2, 3, 4, 5})));
            auto flat = samples::correlated<5>(4, 1e5, {}, random);
            for (auto& x : flat) x[2] = 0.5;
            if (seed % 2 == 0) clusters.push_back(cluster_of(flat));
            const auto words = make_vocabulary(clusters, {.repair = repair});
            ASSERT_EQ(words.words.size(), clusters.size());
            for (const auto& w : words.words) {
                const auto inverse = as_matrix(w.inverse_covariance);
                EXPECT_TRUE(inverse.allFinite());
                EXPECT_EQ(inverse, inverse.transpose());
                const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 5, 5>> solver(inverse);
                // A value of 1e-12 of the largest is that of a feature 1e6 times as wide.
                EXPECT_GT(solver.eigenvalues()[0], -1e-15 * solver.eigenvalues()[4]);
                if (seed % 2 == 1) {
                    EXPECT_GT(solver.eigenvalues()[0], 0.0);
                }
            }
        }
    }
}

/// Both forms of the covariance against their formulas, inverted by Eigen.
TEST(vocabulary, covariances_are_those_of_the_formulas) {
    gnomon::random_stream random(5);
    const std::vector<cluster_statistics<3>> clusters{
        cluster_of(samples::correlated<3>(6, 0.2, {}, random)),
        cluster_of(samples::correlated<3>(40, 0.1, {1, 1, 1}, random))};
    const Eigen::Matrix3d pooled =
        (as_matrix(clusters[0].scatter) + as_matrix(clusters[1].scatter)) / 44.0 +
        1e-6 * Eigen::Matrix3d::Identity();
    const auto shrunk = make_vocabulary(clusters, {.pooled_members = 3.0});
    const auto thesis =
        make_vocabulary(clusters, {.repair = covariance_repair::diagonal, .max_distance = 0.06});
    const auto least =
        make_vocabulary(clusters, {.repair = covariance_repair::diagonal, .max_distance = 0.0});
    for (std::size_t w = 0; w < 2; ++w) {
        const auto n = static_cast<double>(clusters[w].count);
        const Eigen::Matrix3d s = as_matrix(clusters[w].scatter);
        const auto error = [&](const auto& words, const Eigen::Matrix3d& covariance) {
            return (as_matrix(words.words[w].inverse_covariance) * covariance -
                    Eigen::Matrix3d::Identity())
                .norm();
        };
        EXPECT_LT(error(shrunk, (s + 3.0 * pooled) / (n + 2.0)), 1e-11);
        EXPECT_LT(error(thesis, s / n + 4e-4 * Eigen::Matrix3d::Identity()), 1e-11);
        EXPECT_LT(error(least, s / n + 1e-4 * Eigen::Matrix3d::Identity()), 1e-11);
    }
}

TEST(vocabulary, thresholds_are_those_of_the_thesis) {
    // Sec. 5.6.2: 3.88 and 2.58.
    EXPECT_NEAR(make_vocabulary(std::vector<cluster_statistics<5>>{}).max_distance, 3.88, 0.005);
    EXPECT_NEAR(make_vocabulary(std::vector<cluster_statistics<1>>{}).max_distance, 2.58, 0.005);
}

TEST(vocabulary, detects_several_words_or_none) {
    gnomon::random_stream random(8);
    std::vector<cluster_statistics<2>> clusters;
    for (const double x : {0.0, 0.1, 5.0})
        clusters.push_back(cluster_of(samples::correlated<2>(30, 0.1, {x, 0.0}, random)));
    clusters.insert(clusters.begin() + 1, cluster_of(samples::rows<2>(3, {9.0, 9.0})));  // too few
    const auto words = make_vocabulary(clusters);
    ASSERT_EQ(words.words.size(), 3u);
    EXPECT_EQ(words.words[0].cluster, 0u);
    EXPECT_EQ(words.words[1].cluster, 2u);
    EXPECT_EQ(words.words[2].cluster, 3u);
    EXPECT_EQ(words.words[2].statistics, clusters[3]);

    const auto two = words.detections({0.05, 0.0});
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(two[0].word, 0u);
    EXPECT_EQ(two[1].word, 1u);
    EXPECT_TRUE(words.detections({2.0, 3.0}).empty());
    const auto nearest = words.nearest({4.0, 0.0});
    ASSERT_TRUE(nearest.has_value());
    EXPECT_EQ(nearest->word, 2u);
    const Eigen::Vector2d d(4.0 - clusters[3].mean[0], -clusters[3].mean[1]);
    const double squared = d.dot(as_matrix(words.words[2].inverse_covariance) * d);
    EXPECT_NEAR(nearest->distance, std::sqrt(squared), 1e-12);
    EXPECT_GT(nearest->distance, words.max_distance);
}

/// Of words with few members in more dimensions, the pooled covariance of many gives nearly the
/// wanted part of inliers: printed, with that of the thesis's mode.
TEST(vocabulary, pools_the_covariance_of_small_words) {
    double rates[2] = {0.0, 0.0};
    for (std::size_t mode = 0; mode < 2; ++mode) {
        std::size_t inliers = 0, count = 0;
        gnomon::random_stream random(3);
        std::vector<cluster_statistics<5>> clusters;
        std::vector<samples::rows<5>> fresh;
        for (int c = 0; c < 60; ++c) {
            auto p = samples::gaussian<5>(204, random);
            for (auto& x : p)
                for (double& value : x) value *= 0.03;
            clusters.push_back(cluster_of(samples::rows<5>(p.begin(), p.begin() + 4)));
            fresh.emplace_back(p.begin() + 4, p.end());
        }
        const auto words = make_vocabulary(clusters, {.repair = both[mode], .max_distance = 0.03});
        for (std::size_t c = 0; c < clusters.size(); ++c) {
            for (const auto& x : fresh[c]) {
                ++count;
                for (const auto& d : words.detections(x)) inliers += d.word == c ? 1 : 0;
            }
        }
        rates[mode] = static_cast<double>(inliers) / static_cast<double>(count);
    }
    std::printf("inliers of words of four members: pooled %.3f, diagonal %.3f\n", rates[0],
                rates[1]);
    EXPECT_GT(rates[0], 0.9);
    EXPECT_GT(rates[0], rates[1]);
}

TEST(vocabulary, without_words_detects_nothing) {
    const auto words = make_vocabulary(std::vector<cluster_statistics<5>>{});
    EXPECT_TRUE(words.detections({}).empty());
    EXPECT_FALSE(words.nearest({}).has_value());
}

TEST(vocabulary, refuses_bad_input) {
    std::vector<cluster_statistics<2>> c{cluster_of(samples::rows<2>(5, {1, 2}))};
    const auto words = make_vocabulary(c);
    EXPECT_THROW((void)words.detections({samples::nan, 0.0}), std::invalid_argument);
    EXPECT_THROW((void)words.nearest({0.0, samples::infinity}), std::invalid_argument);
    for (const vocabulary_options& bad : {vocabulary_options{.min_members = 0},
                                          {.pooled_members = 0.0},
                                          {.pooled_members = samples::nan},
                                          {.min_deviation = 0.0},
                                          {.min_deviation = -1.0},
                                          {.max_distance = -1.0},
                                          {.max_distance = samples::nan},
                                          {.inlier_probability = 1.0},
                                          {.inlier_probability = 0.0},
                                          {.inlier_probability = samples::nan}})
        EXPECT_THROW((void)make_vocabulary(c, bad), std::invalid_argument);
    c[0].scatter[0][0] = samples::nan;
    EXPECT_THROW((void)make_vocabulary(c), std::invalid_argument);
    // No enlargement makes a negative variance positive, nor a correlation of 5 possible.
    c[0].scatter = {{{-1.0, 0.0}, {0.0, 1.0}}};
    EXPECT_THROW((void)make_vocabulary(c), std::invalid_argument);
    c[0].scatter = {{{1.0, 5.0}, {5.0, 1.0}}};
    EXPECT_THROW((void)make_vocabulary(c), std::invalid_argument);
}

}  // namespace

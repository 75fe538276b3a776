// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/size_preference_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace {

/// Every compiler deduces the preference, though not from designated initialisers.
static_assert(std::same_as<decltype(gnomon::adaptive_knn{5, 40, 2.0, gnomon::prefer_low_entropy{}}),
                           gnomon::adaptive_knn<gnomon::prefer_low_entropy>>);

/// Scan lines 10 cm apart with a point every 2 mm, as a vertical sweep leaves them on a wall.
clouds::cloud scan_lines() {
    gnomon::random_stream random(1);
    clouds::cloud points;
    for (int line = 0; line < 12; ++line) {
        for (int i = 0; i < 400; ++i)
            points.push_back({0.002 * i, 0.1 * line, 1e-4 * random.gaussian()});
    }
    return points;
}

TEST(adaptive_knn, doubles_until_the_next_scan_line_is_reached) {
    const auto points = scan_lines();
    const auto graph = gnomon::adaptive_knn<>{.min_k = 10, .max_k = 320}(points);
    std::size_t more = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t k = graph[i].size();
        EXPECT_TRUE(k == 10 || k == 20 || k == 40 || k == 80 || k == 160 || k == 320);
        more += k >= 80;  // 80 neighbors of a point within a line reach 8 cm, not yet the next one
    }
    EXPECT_GT(more, points.size() * 9 / 10);
    // A sheet that is sampled evenly needs no more than the least.
    const auto sheet = clouds::sheet(2000, 3);
    const auto even = gnomon::adaptive_knn<>{.min_k = 30, .max_k = 240}(sheet);
    std::size_t least = 0;
    for (std::size_t i = 0; i < sheet.size(); ++i) least += even[i].size() == 30;
    EXPECT_EQ(least, sheet.size());
}

/// Two sheets that meet at a right angle, with noise: what is right far from the edge blurs it.
TEST(adaptive_knn, takes_fewer_neighbors_near_an_edge) {
    gnomon::random_stream random(2);
    clouds::cloud points;
    constexpr double sigma = 0.001;
    for (int i = 0; i < 20'000; ++i) {
        const double a = random.uniform();
        const double b = random.uniform();
        const double e = sigma * random.gaussian();
        points.push_back(i % 2 ? Eigen::Vector3d(a, b, e) : Eigen::Vector3d(a, e, b));
    }
    const gnomon::adaptive_knn<gnomon::prefer_small_error> policy{
        .min_k = 8,
        .max_k = 128,
        .growth = 1.3,
        .preference = {.noise = gnomon::constant_noise{sigma}}};
    const auto graph = policy(points);
    double near = 0.0;
    double far = 0.0;
    int near_count = 0;
    int far_count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double distance = std::hypot(points[i].y(), points[i].z());
        if (distance < 0.03) {
            near += static_cast<double>(graph[i].size());
            ++near_count;
        } else if (distance > 0.2) {
            far += static_cast<double>(graph[i].size());
            ++far_count;
        }
    }
    EXPECT_LT(near / near_count, 50.0);
    EXPECT_GT(far / far_count, 100.0);
}

/// The neighborhoods are beginnings of the neighborhoods of knn, and the preference saw each size
/// that was offered.
TEST(adaptive_knn, is_a_beginning_of_knn) {
    const auto points = clouds::sheet(500, 4);
    const auto all = gnomon::knn{.k = 60}(points);
    const auto graph = gnomon::adaptive_knn<gnomon::prefer_low_entropy>{
        .min_k = 7, .max_k = 60, .growth = 1.5}(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_GE(graph[i].size(), 7u);
        for (std::size_t j = 0; j < graph[i].size(); ++j) ASSERT_EQ(graph[i][j], all[i][j]);
    }
    const auto first = [](const gnomon::neighborhood_shape& s) { return static_cast<double>(s.k); };
    const auto last = [](const gnomon::neighborhood_shape& s) { return -static_cast<double>(s.k); };
    const auto fewest = gnomon::adaptive_knn<decltype(first)>{.min_k = 7, .max_k = 60}(points);
    const auto most = gnomon::adaptive_knn<decltype(last)>{.min_k = 7, .max_k = 60}(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(fewest[i].size(), 7u);
        ASSERT_EQ(most[i].size(), 60u);
    }
}

TEST(adaptive_knn, refuses_sizes_that_make_no_series) {
    const auto points = clouds::in_cube(10, 1);
    using policy = gnomon::adaptive_knn<>;
    EXPECT_THROW((void)(policy{.min_k = 0}(points)), std::invalid_argument);
    EXPECT_THROW((void)(policy{.min_k = 9, .max_k = 8}(points)), std::invalid_argument);
    EXPECT_THROW((void)(policy{.growth = 1.0}(points)), std::invalid_argument);
    EXPECT_THROW((void)(policy{.growth = clouds::nan}(points)), std::invalid_argument);
    // Sizes beyond all numbers mean: all neighbors.
    constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
    EXPECT_EQ((policy{.min_k = all, .max_k = all}(points))[0].size(), 9u);
    EXPECT_EQ((policy{.min_k = 2, .growth = 1e300}(points)).size(), 10u);
}

static_assert(!gnomon::size_preference<double>);

TEST(size_preference, models_obey_the_laws) {
    laws::costs_are_comparable(gnomon::prefer_isotropic{});
    laws::costs_are_comparable(gnomon::prefer_low_entropy{});
    laws::costs_are_comparable(gnomon::prefer_small_error{});
    laws::costs_are_comparable(gnomon::prefer_small_error{.noise = gnomon::constant_noise{0.0}});
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/filters/remove_outliers.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::radius_outliers;
using gnomon::statistical_outliers;

/// A dense sheet, isolated points, duplicates, and points that are not finite.
clouds::cloud dirty_cloud(std::uint64_t seed) {
    clouds::cloud points = clouds::sheet(900, seed);
    for (const Eigen::Vector3d& p : clouds::in_cube(60, seed + 1)) points.push_back(3.0 * p);
    for (int i = 0; i < 40; ++i) points.push_back({2, 2, 2});
    for (int i = 0; i < 20; ++i) points.push_back({3, 3, 3 + 0.25 * i});  // exact distances
    points[11] = {clouds::nan, 0, 0};
    points.insert(points.begin() + 500, Eigen::Vector3d(0, clouds::infinity, 0));
    return points;
}

/// For each point the squared distances to all others, ascending; nothing for points that are not
/// finite.
std::vector<std::vector<double>> all_squares(const clouds::cloud& points) {
    std::vector<std::vector<double>> distances(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < points.size(); ++j)
            if (i != j && points[i].allFinite() && points[j].allFinite())
                distances[i].push_back(gnomon::squared_distance(points[i], points[j]));
        std::sort(distances[i].begin(), distances[i].end());
    }
    return distances;
}

TEST(remove_outliers, keeps_what_brute_force_keeps_by_statistics) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const clouds::cloud points = dirty_cloud(seed);
        const auto squares_of = all_squares(points);
        for (const std::size_t k : {1u, 7u, 30u, 2000u}) {
            std::vector<double> means;
            double sum = 0, squares = 0, n = 0;
            for (const auto& d : squares_of) {
                const std::size_t count = std::min(k, d.size());
                means.push_back(-1);
                if (d.empty()) continue;
                means.back() = 0;
                for (std::size_t j = 0; j < count; ++j) means.back() += std::sqrt(d[j]);
                means.back() /= static_cast<double>(count);
                sum += means.back();
                n += 1;
            }
            for (const double d : means)
                if (d >= 0) squares += (d - sum / n) * (d - sum / n);
            for (const double factor : {0.0, 1.0, 2.5}) {
                const double threshold = sum / n + factor * std::sqrt(squares / (n - 1));
                std::vector<gnomon::point_index> expected;
                for (std::size_t i = 0; i < means.size(); ++i)
                    if (means[i] >= 0 && means[i] <= threshold)
                        expected.push_back(static_cast<gnomon::point_index>(i));
                ASSERT_LT(expected.size(), points.size() - 2);
                const statistical_outliers options{.k = k, .factor = factor};
                EXPECT_EQ(gnomon::remove_outliers(points, options), expected) << k << " " << factor;
                EXPECT_EQ(gnomon::remove_outliers(gnomon::spatial_index(points), options),
                          expected);
            }
        }
    }
}

TEST(remove_outliers, keeps_what_brute_force_keeps_by_radius) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const clouds::cloud points = dirty_cloud(seed);
        const auto squares_of = all_squares(points);
        for (const double radius : {0.0, 0.25, 0.05, 0.3, 1.0, 20.0}) {
            for (const std::size_t least : {0u, 1u, 5u, 39u, 40u, 200u, 5000u}) {
                std::vector<gnomon::point_index> expected;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const auto& d = squares_of[i];
                    const auto within =
                        std::upper_bound(d.begin(), d.end(), radius * radius) - d.begin();
                    if (!d.empty() && static_cast<std::size_t>(within) >= least)
                        expected.push_back(static_cast<gnomon::point_index>(i));
                }
                const radius_outliers options{.radius = radius, .min_neighbors = least};
                EXPECT_EQ(gnomon::remove_outliers(points, options), expected)
                    << radius << " " << least;
            }
        }
    }
}

/// Points of a box that is smaller than the radius are counted without a search: a leaf has 32.
TEST(remove_outliers, counts_the_others_in_a_small_box) {
    for (const std::size_t n : {32u, 64u}) {
        const clouds::cloud points = clouds::in_cube(n, 1);
        const auto kept = [&](std::size_t least) {
            return gnomon::remove_outliers(points,
                                           radius_outliers{.radius = 2.0, .min_neighbors = least})
                .size();
        };
        EXPECT_EQ(kept(n - 1), n);
        EXPECT_EQ(kept(n), 0u);
    }
}

TEST(remove_outliers, removes_isolated_points_far_from_the_origin) {
    clouds::cloud points =
        clouds::moved(clouds::sheet(2000, 1), Eigen::Matrix3d::Identity(), {4e5, 5e6, 500});
    points.push_back(points[0] + Eigen::Vector3d(0, 0, 3));
    const auto by_statistics = gnomon::remove_outliers(points, statistical_outliers{.factor = 5});
    EXPECT_EQ(by_statistics.size(), 2000u);
    EXPECT_EQ(by_statistics.back(), 1999u);
    const auto by_radius = gnomon::remove_outliers(points, radius_outliers{.radius = 0.2});
    EXPECT_EQ(by_radius.size(), 2000u);
    EXPECT_EQ(by_radius.back(), 1999u);
}

TEST(remove_outliers, does_not_depend_on_threads) {
    clouds::cloud points = dirty_cloud(1);
    for (std::uint64_t seed = 10; seed < 20; ++seed) {
        const clouds::cloud more = dirty_cloud(seed);
        points.insert(points.end(), more.begin(), more.end());
    }
    const auto statistical = gnomon::remove_outliers(points, statistical_outliers{});
    const auto radius = gnomon::remove_outliers(points, radius_outliers{});
    for (const unsigned n : {2u, 5u}) {
        EXPECT_EQ(gnomon::remove_outliers(points, statistical_outliers{}, gnomon::threads{n}),
                  statistical);
        EXPECT_EQ(gnomon::remove_outliers(points, radius_outliers{}, gnomon::threads{n}), radius);
    }
}

TEST(remove_outliers, has_a_result_for_degenerate_clouds) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto finite = static_cast<std::size_t>(
            std::count_if(points.begin(), points.end(), gnomon::is_finite));
        EXPECT_LE(gnomon::remove_outliers(points, statistical_outliers{}).size(), finite);
        EXPECT_LE(gnomon::remove_outliers(points, radius_outliers{}).size(), finite);
        EXPECT_EQ(gnomon::remove_outliers(points, radius_outliers{.min_neighbors = 0}).size(),
                  finite);
    }
    EXPECT_TRUE(gnomon::remove_outliers(clouds::cloud(), statistical_outliers{}).empty());
    EXPECT_TRUE(gnomon::remove_outliers(clouds::cloud(), radius_outliers{}).empty());
    // A single point has no neighbor to be far from; copies of a point are no outliers.
    EXPECT_EQ(gnomon::remove_outliers(clouds::cloud(1, {1, 2, 3}), statistical_outliers{}).size(),
              1u);
    EXPECT_EQ(
        gnomon::remove_outliers(clouds::cloud(5000, {1, 2, 3}), statistical_outliers{}).size(),
        5000u);
    EXPECT_EQ(gnomon::remove_outliers(clouds::cloud(5000, {1, 2, 3}), radius_outliers{.radius = 0})
                  .size(),
              5000u);
}

TEST(remove_outliers, refuses_options_out_of_range) {
    const clouds::cloud points = clouds::in_cube(10, 1);
    const auto refuse = [&](const auto& options) {
        EXPECT_THROW(static_cast<void>(gnomon::remove_outliers(points, options)),
                     std::invalid_argument);
    };
    refuse(statistical_outliers{.k = 0});
    refuse(statistical_outliers{.factor = -1});
    refuse(statistical_outliers{.factor = clouds::nan});
    refuse(radius_outliers{.radius = -1});
    refuse(radius_outliers{.radius = clouds::nan});
    refuse(radius_outliers{.radius = clouds::infinity});
}

}  // namespace

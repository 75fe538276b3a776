// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/neighborhood_laws.hpp"
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/noise_knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::constant_noise, gnomon::noise_knn, gnomon::point_index, gnomon::quadratic_noise;

/// Policies that take all of the k nearest, few of them, and the fewest.
const std::vector<noise_knn>& policies() {
    static const std::vector<noise_knn> all{
        noise_knn{},
        {.noise = constant_noise{1.0}, .k = 9},
        {.noise = constant_noise{0.02}, .k = 40, .fewest = 3},
        {.noise = constant_noise{0.0}, .k = 20, .fewest = 5},
        {.noise = quadratic_noise{0.0, 0.01, 0.02}, .k = 30, .fewest = 0, .deviations = 4.0},
        {.noise = constant_noise{0.02}, .k = 5, .fewest = 100}};
    return all;
}

TEST(noise_knn, models_obey_the_laws) {
    for (const noise_knn& policy : policies()) {
        for (const auto& [name, points] : clouds::degenerate()) {
            SCOPED_TRACE(name);
            laws::neighborhood_laws(policy, points);
            laws::neighbors_are_in_canonical_order(policy, points);
        }
        laws::neighborhood_laws(policy, clouds::in_cube(500, 2));
    }
    // Infinity times no noise is no distance.
    laws::neighborhood_laws(noise_knn{.noise = constant_noise{0.0}, .deviations = clouds::infinity},
                            clouds::in_cube(100, 3));
}

/// All points by their distance, ties by index: those within the reach of the noise, at most k, and
/// at least the fewest.
std::vector<point_index> by_brute_force(const noise_knn& policy, const clouds::cloud& points,
                                        const Eigen::Vector3d& viewpoint, std::size_t i) {
    std::vector<point_index> ranks;
    for (std::size_t j = 0; j < points.size(); ++j)
        if (j != i && gnomon::is_finite(points[j])) ranks.push_back(static_cast<point_index>(j));
    const auto distance = [&](point_index j) {
        return gnomon::squared_distance(points[i], points[j]);
    };
    std::stable_sort(ranks.begin(), ranks.end(),
                     [&](auto a, auto b) { return distance(a) < distance(b); });
    ranks.resize(std::min(ranks.size(), policy.k));
    const double reach = policy.deviations * policy.noise((points[i] - viewpoint).norm());
    const auto near = std::count_if(ranks.begin(), ranks.end(),
                                    [&](auto j) { return distance(j) <= reach * reach; });
    ranks.resize(std::min(ranks.size(), std::max(static_cast<std::size_t>(near), policy.fewest)));
    return ranks;
}

TEST(noise_knn, agrees_with_brute_force) {
    const Eigen::Vector3d eye(-1.0, 0.5, 2.0);
    std::size_t limited_by_noise = 0, by_number = 0, few = 0;
    for (noise_knn policy : policies()) {
        policy.sees_across_lines = false;
        for (const auto& points :
             {clouds::in_cube(300, 1), clouds::sheet(300, 2), clouds::on_grid(300, 3)}) {
            const auto graph = policy(gnomon::with_viewpoint(points, eye));
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto expected = by_brute_force(policy, points, eye, i);
                ASSERT_EQ(std::vector(graph[i].begin(), graph[i].end()), expected);
                by_number += expected.size() == policy.k ? 1 : 0;
                few += expected.size() == policy.fewest ? 1 : 0;
                limited_by_noise +=
                    expected.size() < policy.k && expected.size() > policy.fewest ? 1 : 0;
            }
        }
    }
    EXPECT_GT(std::min({limited_by_noise, by_number, few}), 100u) << "each case occurs";
}

/// Each point has the reach of its own range, from its own view point.
TEST(noise_knn, reaches_farther_where_noise_is_greater) {
    clouds::cloud line, eyes;
    for (int i = 0; i < 400; ++i) {
        line.emplace_back(0.001 * i, 0.0, 0.0);
        eyes.emplace_back(0.001 * i, 0.0, i < 200 ? 1.0 : 4.0);
    }
    const noise_knn policy{.noise = quadratic_noise{0.0, 0.001, 0.0},
                           .k = 300,
                           .fewest = 0,
                           .deviations = 5.4,
                           .sees_across_lines = false};
    const auto graph = policy(gnomon::with_viewpoints(line, gnomon::viewpoint_table(eyes)));
    EXPECT_EQ(graph[100].size(), 10u);  // 5.4 mm to either side
    EXPECT_EQ(graph[300].size(), 42u);  // 21.6 mm
}

TEST(noise_knn, is_knn_where_noise_is_great) {
    const auto points = clouds::sheet(400, 6);
    const noise_knn policy{.noise = constant_noise{10.0}, .k = 25};
    EXPECT_EQ(policy(points), gnomon::knn{.k = 25}(points));
}

TEST(noise_knn, refuses_bad_parameters) {
    const auto points = clouds::in_cube(20, 1);
    EXPECT_THROW((void)noise_knn{.k = 0}(points), std::invalid_argument);
    EXPECT_THROW((void)noise_knn{.deviations = -1.0}(points), std::invalid_argument);
    EXPECT_THROW((void)noise_knn{.deviations = clouds::nan}(points), std::invalid_argument);
    const gnomon::spatial_index index(points);
    std::vector<gnomon::neighbor> found;
    EXPECT_THROW(noise_knn{.k = 0}.find(index, 0, found), std::invalid_argument);
    EXPECT_NO_THROW((void)(noise_knn{.fewest = 0, .deviations = 0.0}(points)));
    EXPECT_NO_THROW((void)(noise_knn{.deviations = clouds::infinity}(points)));
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "filters/boards.hpp"
#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/filters/remove_mixed_points.hpp>
#include <gnomon/filters/subset.hpp>
#include <gnomon/segmentation/euclidean_clusters.hpp>

namespace {

using boards::all_of, boards::beam, boards::scan_of, boards::spacing;
using gnomon::radians;
using gnomon::remove_mixed_points;

const std::vector<boards::board> near_and_far{{2.0, 0.15, 0.2}, {4.0, 0.8, 1.0}};

TEST(remove_mixed_points, removes_what_is_between_two_surfaces_and_nothing_else) {
    const gnomon::scan scan = scan_of(near_and_far, beam);
    const auto kept = remove_mixed_points(scan, {.divergence = radians(beam)});
    const auto is_between = [&](gnomon::point_index i) {
        return scan.points[i].x() > 2.03 && scan.points[i].x() < 3.97;
    };
    ASSERT_GT(std::ranges::count_if(all_of(scan), is_between), 100);
    std::vector<gnomon::point_index> expected = all_of(scan);
    std::erase_if(expected, is_between);
    EXPECT_EQ(kept, expected);
}

TEST(remove_mixed_points, separates_an_object_from_the_wall_behind_it) {
    const gnomon::scan scan = scan_of({{2.0, 0.15, 0.2}, {2.3, 0.5, 0.5}}, beam);
    const auto groups_in = [](const gnomon::scan& some) {
        return gnomon::euclidean_clusters(some, {.radius = 0.1, .min_points = 10}).size();
    };
    ASSERT_EQ(groups_in(scan), 1u);
    EXPECT_EQ(groups_in(gnomon::subset(scan, remove_mixed_points(scan))), 2u);
}

TEST(remove_mixed_points, surfaces_nearer_than_a_step_are_one) {
    const gnomon::scan scan = scan_of({{3.0, 0.2, 0.4}, {3.05, 0.5, 0.7}}, beam);
    const gnomon::constant_noise none{0.0};
    EXPECT_LT(remove_mixed_points(scan, {.noise = none, .min_step = 0.01}).size(), scan.size());
    EXPECT_EQ(remove_mixed_points(scan, {.noise = none, .min_step = 0.05}), all_of(scan));
    // The noise makes steps, too.
    const gnomon::constant_noise of_steps{0.01};
    EXPECT_EQ(remove_mixed_points(scan, {.noise = of_steps, .min_step = 0.0}), all_of(scan));
}

/// A raster of rays on a plane, with normal noise along the rays.
gnomon::scan scan_of_plane(const Eigen::Vector3d& normal, double distance, double sigma,
                           gnomon::random_stream& random) {
    gnomon::scan scan;
    scan.viewpoints = Eigen::Vector3d(0, 0, 0);
    for (int j = -30; j <= 30; ++j) {
        for (int i = -30; i <= 30; ++i) {
            const Eigen::Vector3d ray = Eigen::Vector3d(1.0, spacing * i, spacing * j).normalized();
            const double range = distance / normal.dot(ray);
            if (range > 0.0 && range < 20.0)
                scan.points.push_back((range + sigma * random.gaussian()) * ray);
        }
    }
    return scan;
}

TEST(remove_mixed_points, planes_are_kept_at_any_incidence) {
    gnomon::random_stream random(4);
    for (int trial = 0; trial < 30; ++trial) {
        const double incidence = random.uniform(0.0, 1.5), turn = random.uniform(-3.2, 3.2);
        const Eigen::Vector3d normal(std::cos(incidence), std::sin(incidence) * std::cos(turn),
                                     std::sin(incidence) * std::sin(turn));
        const double distance = random.uniform(0.2, 4.0) * normal.x();
        const gnomon::scan exact = scan_of_plane(normal, distance, 0.0, random);
        EXPECT_EQ(remove_mixed_points(exact), all_of(exact)) << incidence;
        const gnomon::scan noisy = scan_of_plane(normal, distance, 0.02, random);
        const auto kept = remove_mixed_points(noisy, {.noise = gnomon::constant_noise{0.02}});
        EXPECT_GE(kept.size() + noisy.size() / 200, noisy.size()) << incidence;
    }
}

TEST(remove_mixed_points, noise_that_is_not_given_counts_as_mixed) {
    gnomon::random_stream random(5);
    const gnomon::scan noisy = scan_of_plane({1.0, 0.0, 0.0}, 3.0, 0.03, random);
    EXPECT_LT(remove_mixed_points(noisy).size(), noisy.size() / 2);
}

TEST(remove_mixed_points, result_does_not_depend_on_threads_or_place) {
    const gnomon::scan scan = scan_of(near_and_far, beam);
    const auto kept = remove_mixed_points(scan);
    for (const unsigned n : {1u, 2u, 4u})
        EXPECT_EQ(remove_mixed_points(scan, {}, gnomon::threads{n}), kept);
    const Eigen::Vector3d shift(524288.0, 4194304.0, 128.0);  // at UTM coordinates
    gnomon::scan far;
    far.viewpoints = shift;
    for (const Eigen::Vector3d& p : scan.points) far.points.push_back(p + shift);
    EXPECT_EQ(remove_mixed_points(far), kept);
}

TEST(remove_mixed_points, a_single_scan_line_is_kept) {
    const gnomon::scan scan = scan_of(near_and_far, beam, 0);
    ASSERT_GT(scan.size(), 50u);
    EXPECT_EQ(remove_mixed_points(scan), all_of(scan));
}

TEST(remove_mixed_points, points_without_a_ray_are_left_out) {
    gnomon::scan scan = scan_of(near_and_far, beam);
    const auto kept = remove_mixed_points(scan);
    boards::add_points_without_a_ray(scan);
    EXPECT_EQ(remove_mixed_points(scan), kept);
}

TEST(remove_mixed_points, few_points_and_echoes_of_one_ray) {
    EXPECT_TRUE(remove_mixed_points(gnomon::scan{}).empty());
    for (int n = 1; n < 8; ++n) {
        gnomon::scan scan;
        for (int i = 0; i < n; ++i) scan.points.emplace_back(3.0, 0.01 * i, 0.02 * i * i);
        EXPECT_EQ(remove_mixed_points(scan), all_of(scan)) << n;
        for (std::size_t i = 0; i < scan.size(); ++i)
            scan.points[i] = (1.0 + static_cast<double>(i)) * Eigen::Vector3d(3.0, 1.0, 1.0);
        EXPECT_EQ(remove_mixed_points(scan), all_of(scan)) << n;
    }
}

TEST(remove_mixed_points, options_are_checked) {
    const gnomon::scan scan = scan_of({{3.0, 0.1, 0.1}}, beam);
    EXPECT_THROW((void)remove_mixed_points(scan, {.divergence = radians(-1.0)}),
                 std::invalid_argument);
    EXPECT_THROW((void)remove_mixed_points(scan, {.divergence = radians(clouds::nan)}),
                 std::invalid_argument);
    EXPECT_THROW((void)remove_mixed_points(scan, {.divergence = gnomon::degrees(91)}),
                 std::invalid_argument);
    EXPECT_THROW((void)remove_mixed_points(scan, {.min_step = -0.1}), std::invalid_argument);
    EXPECT_THROW((void)remove_mixed_points(scan, {.min_step = clouds::nan}), std::invalid_argument);
}

}  // namespace

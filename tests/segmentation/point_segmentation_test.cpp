// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include <gnomon/segmentation/point_segmentation.hpp>
#include <gnomon/simulation/box_and_cylinder.hpp>

namespace {

/// Blobs of many sizes, some closer than the radius, and strays between them.
clouds::cloud blobs(std::uint64_t seed) {
    gnomon::random_stream random(seed);
    clouds::cloud points;
    for (int blob = 0; blob < 12; ++blob) {
        const Eigen::Vector3d center(random.uniform(), random.uniform(), random.uniform());
        const auto n = static_cast<int>(20 + random.bits() % 100);
        for (int i = 0; i < n; ++i)
            points.push_back(center + 0.04 * clouds::gaussian_vector(random));
    }
    for (const auto& p : clouds::in_cube(80, seed + 1)) points.push_back(p);
    return points;
}

std::vector<std::int32_t> oracle(const clouds::cloud& points, double r, std::size_t min_points) {
    const auto linked = [&](std::size_t i, std::size_t j) {
        return gnomon::is_finite(points[i]) && gnomon::is_finite(points[j]) &&
               gnomon::squared_distance(points[i], points[j]) <= r * r;
    };
    return laws::expected_labels(laws::components_by_brute_force(points.size(), linked), min_points,
                                 [&](std::size_t i) { return gnomon::is_finite(points[i]); });
}

TEST(segment_points, exact_equals_the_connected_components_of_the_r_graph) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto points = blobs(seed);
        for (const double r : {0.01, 0.03, 0.05, 0.2}) {
            for (const std::size_t min_points : {1u, 5u, 30u}) {
                const gnomon::point_segmentation options{.radius = r, .min_points = min_points};
                const auto expected = oracle(points, r, min_points);
                for (const unsigned t : {1u, 2u, 4u}) {
                    ASSERT_EQ(gnomon::segment_points(points, options, gnomon::threads{t}).labels(),
                              expected);
                }
            }
        }
    }
}

TEST(segment_points, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const double r : {0.0, 0.25, 1.0}) {
            const gnomon::point_segmentation exact{.radius = r, .min_points = 1};
            EXPECT_EQ(gnomon::segment_points(points, exact).labels(), oracle(points, r, 1));
            (void)gnomon::segment_points(points, {.radius = r, .min_points = 1, .greedy = true});
        }
    }
}

/// What the shortcut costs on a scan is next to nothing.
TEST(segment_points, greedy_hardly_differs_on_a_scan) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto scan = gnomon::simulate(gnomon::box_and_cylinder{.seed = seed}).scan;
        for (const double r : {0.03, 0.05, 0.1}) {
            const auto exact = gnomon::segment_points(scan, {.radius = r, .min_points = 1});
            const auto greedy =
                gnomon::segment_points(scan, {.radius = r, .min_points = 1, .greedy = true});
            EXPECT_GE(laws::rand_index(greedy.labels(), exact.labels()), 0.99);
        }
    }
}

/// Greedy segments lie within exact ones, also where points are few and far between.
TEST(segment_points, greedy_splits_but_never_joins) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto points = blobs(seed);
        const auto exact = gnomon::segment_points(points, {.radius = 0.05, .min_points = 1});
        const auto greedy =
            gnomon::segment_points(points, {.radius = 0.05, .min_points = 1, .greedy = true});
        for (std::size_t g = 0; g < greedy.size(); ++g) {
            for (const auto i : greedy[g]) {
                ASSERT_EQ(exact.labels()[i], exact.labels()[greedy[g].front()]);
            }
        }
    }
}

/// Invalid returns at the origin, as many as there are others: one segment, in no time.
TEST(segment_points, takes_a_hundred_thousand_points_at_one_place) {
    auto points = clouds::in_cube(200'000, 9);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % 2)
            points[i].setZero();
        else
            points[i].x() += 2.0;
    }
    for (const bool greedy : {false, true}) {
        const auto found = gnomon::segment_points(points, {.radius = 0.05, .greedy = greedy});
        ASSERT_EQ(found.size(), 2u);
        EXPECT_EQ(found[0].size(), 100'000u);
        EXPECT_EQ(found[1].size(), 100'000u);
    }
}

TEST(segment_points, refuses_what_is_no_radius) {
    const auto points = clouds::in_cube(5, 1);
    for (const double r : {-0.1, clouds::nan, clouds::infinity}) {
        EXPECT_THROW((void)gnomon::segment_points(points, {.radius = r}), std::invalid_argument);
    }
}

}  // namespace

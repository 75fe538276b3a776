// SPDX-License-Identifier: BSL-1.0
/// Compiled once more for each set of instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include <gnomon/segmentation/euclidean_clusters.hpp>
#include <gnomon/simulation/box_and_cylinder.hpp>

namespace {

/// Blobs of many sizes, some closer than the radius, with outliers between them.
clouds::cloud blobs(std::uint64_t seed) {
    gnomon::random_stream random(seed);
    clouds::cloud points;
    for (int blob = 0; blob < 12; ++blob) {
        const Eigen::Vector3d center(random.uniform(), random.uniform(), random.uniform());
        const auto n = static_cast<int>(20 + random.below(100));
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

TEST(euclidean_clusters, exact_equals_the_connected_components_of_the_r_graph) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto points = blobs(seed);
        for (const double r : {0.01, 0.03, 0.05, 0.2}) {
            for (const std::size_t min_points : {1u, 5u, 30u}) {
                const gnomon::euclidean_clusters_options options{.radius = r,
                                                                 .min_points = min_points};
                const auto expected = oracle(points, r, min_points);
                for (const unsigned t : {1u, 2u, 4u}) {
                    ASSERT_EQ(
                        gnomon::euclidean_clusters(points, options, gnomon::threads{t}).labels(),
                        expected);
                }
            }
        }
    }
}

/// A cloud, and radii to segment it by.
struct planted {
    std::string name;
    clouds::cloud points;
    std::vector<double> radii;
};

/// n heaps of up to 99 points, one in five of them a single point, with normally distributed
/// coordinates of standard deviation `width`.
clouds::cloud heaps(std::size_t n, std::uint64_t seed, double width) {
    gnomon::random_stream random(seed, 1);
    clouds::cloud points;
    for (const auto& p : clouds::in_cube(n, seed)) {
        const std::size_t copies = random.below(5) == 0 ? 1 : random.below(100);
        for (std::size_t i = 0; i < copies; ++i)
            points.push_back(p + width * clouds::gaussian_vector(random));
    }
    return points;
}

/// Each point that often.
clouds::cloud repeated(const clouds::cloud& points, std::size_t times) {
    clouds::cloud all;
    for (const auto& p : points) all.insert(all.end(), times, p);
    return all;
}

/// Corner cases of the traversal: distances equal to the radius, leaves entirely within the radius,
/// leaves entirely outside of it, coordinates whose squares overflow.
std::vector<planted> planted_clouds() {
    const auto cube = clouds::in_cube(2000, 1);
    const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d utm(6e5, 4.8e6, 100.0);
    std::vector<planted> all{
        {"sparse to dense", cube, {0.0, 0.01, 0.03, 0.05, 0.06, 0.07, 0.1, 0.3, 1.0, 3.0}},
        {"many", clouds::in_cube(7000, 8), {0.02, 0.04, 0.05}},
        {"as many at a place as a leaf holds",
         repeated(clouds::in_cube(200, 9), 32),
         {0.13, 0.15, 0.17}},
        {"at UTM coordinates", clouds::moved(cube, upright, utm), {0.03, 0.06, 0.3}},
        {"heaps", heaps(50, 2, 1e-3), {0.0, 1e-4, 1e-3, 0.05, 0.15, 0.2}},
        {"points of heaps alike", heaps(50, 3, 0.0), {0.0, 1e-200, 0.05, 0.15, 0.2}},
        {"heaps at UTM coordinates", clouds::moved(heaps(50, 4, 1e-3), upright, utm), {1e-3, 0.2}},
        {"a sheet and far outliers", clouds::sheet(1500, 5), {0.01, 0.02, 0.04, 1e3, 1e200}},
    };
    for (std::size_t i = 0; i < 1500; i += 15) all.back().points[i] *= 1e3 * static_cast<double>(i);
    // The distances on a grid, and some that differ from them by rounding only.
    const double d = 0.01;
    for (const double origin : {0.0, 5e5}) {
        planted grid{"grid from " + std::to_string(origin), clouds::on_grid(1500, 6, 0.125), {}};
        for (auto& p : grid.points) p = d * (8.0 * p) + Eigen::Vector3d::Constant(origin);
        for (const double r : {d, d * std::sqrt(2.0), d * std::sqrt(3.0)})
            for (const double off : {-1e-13, -2e-16, -1e-16, 0.0, 2e-16, 4e-16, 1e-13})
                grid.radii.push_back((1.0 + off) * r);
        all.push_back(grid);
    }
    for (const double scale : {1e-161, 1e-160, 1e-155, 1e-146, 1e-145, 1e-144, 0.9e150}) {
        planted scaled{
            "times " + std::to_string(std::log10(scale)), clouds::on_grid(1500, 7, 0.125), {}};
        for (auto& p : scaled.points) p *= scale / 2.0;
        for (const double r : {0.0, 0.0624, 0.0625, 0.0884, 0.1, 0.108, 1.0})
            scaled.radii.push_back(r * scale);
        all.push_back(scaled);
    }
    for (const std::size_t n : {31u, 32u, 33u, 64u, 65u, 97u, 129u})  // what fills leaves, or not
        all.push_back({std::to_string(n), clouds::in_cube(n, n), {0.1, 0.2, 0.3, 2.0}});
    for (auto& c : all)
        for (std::size_t i = 0; i < c.points.size(); i += 97) c.points[i].y() = clouds::nan;
    return all;
}

TEST(euclidean_clusters, exact_is_exact_at_any_density_and_scale) {
    for (const auto& [name, points, radii] : planted_clouds()) {
        for (const double r : radii) {
            SCOPED_TRACE(name + ", radius " + std::to_string(r));
            const auto expected = oracle(points, r, 1);
            for (const unsigned t : {1u, 2u, 4u}) {
                const gnomon::euclidean_clusters_options options{.radius = r, .min_points = 1};
                const auto found = gnomon::euclidean_clusters(points, options, gnomon::threads{t});
                ASSERT_EQ(found.labels(), expected);
            }
        }
    }
}

TEST(euclidean_clusters, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const double r : {0.0, 0.25, 1.0}) {
            const gnomon::euclidean_clusters_options exact{.radius = r, .min_points = 1};
            EXPECT_EQ(gnomon::euclidean_clusters(points, exact).labels(), oracle(points, r, 1));
            (void)gnomon::euclidean_clusters(points,
                                             {.radius = r, .min_points = 1, .greedy = true});
        }
    }
}

/// On a scan the labels of the greedy variant have a Rand index of at least 0.99 with the exact
/// ones.
TEST(euclidean_clusters, greedy_hardly_differs_on_a_scan) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto scan =
            gnomon::simulation::simulate(gnomon::simulation::box_and_cylinder{.seed = seed}).scan;
        for (const double r : {0.03, 0.05, 0.1}) {
            const auto exact = gnomon::euclidean_clusters(scan, {.radius = r, .min_points = 1});
            const auto greedy =
                gnomon::euclidean_clusters(scan, {.radius = r, .min_points = 1, .greedy = true});
            EXPECT_GE(laws::rand_index(greedy.labels(), exact.labels()), 0.99);
        }
    }
}

/// Greedy segments lie within exact ones, also where points are few and far between.
TEST(euclidean_clusters, greedy_splits_but_never_joins) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto points = blobs(seed);
        const auto exact = gnomon::euclidean_clusters(points, {.radius = 0.05, .min_points = 1});
        const auto greedy =
            gnomon::euclidean_clusters(points, {.radius = 0.05, .min_points = 1, .greedy = true});
        for (std::size_t g = 0; g < greedy.size(); ++g) {
            for (const auto i : greedy[g]) {
                ASSERT_EQ(exact.labels()[i], exact.labels()[greedy[g].front()]);
            }
        }
    }
}

/// Invalid returns at the origin, as many as there are others: one segment, in no time.
TEST(euclidean_clusters, takes_a_hundred_thousand_points_at_one_place) {
    auto points = clouds::in_cube(200'000, 9);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % 2)
            points[i].setZero();
        else
            points[i].x() += 2.0;
    }
    for (const bool greedy : {false, true}) {
        const auto found = gnomon::euclidean_clusters(points, {.radius = 0.05, .greedy = greedy});
        ASSERT_EQ(found.size(), 2u);
        EXPECT_EQ(found[0].size(), 100'000u);
        EXPECT_EQ(found[1].size(), 100'000u);
    }
    const auto coincident = gnomon::euclidean_clusters(points, {.radius = 0.0});
    ASSERT_EQ(coincident.size(), 1u);
    EXPECT_EQ(coincident[0].size(), 100'000u);
    std::fill(points.begin(), points.end(), Eigen::Vector3d(1.0, 2.0, 3.0));
    const auto alike = gnomon::euclidean_clusters(points, {.radius = 0.0});
    EXPECT_EQ(alike.labels(), std::vector<std::int32_t>(200'000, 0));
}

TEST(euclidean_clusters, rejects_invalid_radii) {
    const auto points = clouds::in_cube(5, 1);
    for (const double r : {-0.1, clouds::nan, clouds::infinity}) {
        EXPECT_THROW((void)gnomon::euclidean_clusters(points, {.radius = r}),
                     std::invalid_argument);
    }
}

}  // namespace

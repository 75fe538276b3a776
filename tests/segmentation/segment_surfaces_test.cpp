// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include "segmentation/unit_scenes.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/simulation/box_and_cylinder.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::knn, gnomon::plane_pca, gnomon::segment_surfaces_options;

TEST(segment_surfaces, has_the_defaults_of_the_thesis) {
    const segment_surfaces_options options;
    EXPECT_DOUBLE_EQ(options.max_angle.degrees(), 5.0);
    EXPECT_DOUBLE_EQ(options.max_distance, 0.30);
    EXPECT_EQ(options.min_points, 30u);
}

/// Alg. 4.2 on noisy room-like data against components over all pairs of
/// |p_i - p_j| <= max(rho_s,i, rho_s,j) and |<n_i, n_j>| >= cos alpha_max.
TEST(segment_surfaces, equals_the_brute_force_components_on_any_number_of_threads) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto truth =
            sim::simulate(sim::box_and_cylinder{.sigma = 0.01, .points = 1500, .seed = seed});
        auto points = truth.scan.points;
        for (std::size_t i = 0; i < points.size(); i += 50) points[i].x() = clouds::nan;
        auto surface = gnomon::estimate_normals(points, knn{20}, plane_pca{});
        const segment_surfaces_options options{.max_angle = gnomon::degrees(8),
                                               .max_distance = 0.05};
        const auto rho = [&](std::size_t i) { return std::min(surface[i].mean_distance, 0.05); };
        const auto linked = [&](std::size_t i, std::size_t j) {
            const double reach = std::max(rho(i), rho(j));
            return gnomon::squared_distance(points[i], points[j]) <= reach * reach &&
                   std::abs(surface[i].normal.dot(surface[j].normal)) >= cos(options.max_angle);
        };
        const auto expected = laws::expected_labels(
            laws::components_by_brute_force(points.size(), linked), options.min_points,
            [&](std::size_t i) { return gnomon::is_finite(points[i]); });
        for (const unsigned t : {1u, 2u, 4u}) {
            ASSERT_EQ(
                gnomon::segment_surfaces(points, surface, options, gnomon::threads{t}).labels(),
                expected);
        }
    }
}

/// The stored graph lists every point within rho_bar, so both overloads agree; after a repair the
/// graph has fewer links.
TEST(segment_surfaces, over_the_graph_of_the_normals_equals_the_search) {
    const auto truth = sim::simulate(sim::box_and_cylinder{});
    const auto graph = knn{}(truth.scan, gnomon::threads{});
    const auto surface =
        gnomon::estimate_normals(truth.scan, graph, plane_pca{}, gnomon::threads{});
    const auto searched = gnomon::segment_surfaces(truth.scan, surface, {}, gnomon::threads{});
    for (const unsigned t : {1u, 2u, 4u}) {
        EXPECT_EQ(gnomon::segment_surfaces(truth.scan, graph, surface, {}, gnomon::threads{t}),
                  searched);
    }
}

TEST(segment_surfaces, finds_the_surfaces_of_box_and_cylinder) {
    const auto truth = sim::simulate(sim::box_and_cylinder{.sigma = 0.005});
    const auto surface =
        gnomon::estimate_normals(truth.scan, knn{}, plane_pca{}, gnomon::threads{});
    const auto parts = gnomon::segment_surfaces(truth.scan, surface);
    ASSERT_GE(parts.size(), 3u);
    for (std::size_t s = 0; s < 3; ++s) {  // the mantle and the two visible sides of the box
        std::map<int, std::size_t> votes;
        for (const auto i : parts[s]) ++votes[truth.surfaces[i]];
        std::size_t best = 0;
        for (const auto& [surface_id, n] : votes) best = std::max(best, n);
        EXPECT_GE(static_cast<double>(best), 0.95 * static_cast<double>(parts[s].size()));
    }
}

/// Fig. 4.2 (b)-(d)
TEST(segment_surfaces, separates_corners_and_steps_and_keeps_smooth_surfaces) {
    const auto count = [](const unit_scenes::scene& s) {
        return gnomon::segment_surfaces(s.points, s.surface).size();
    };
    EXPECT_EQ(count(unit_scenes::corner()), 2u);
    EXPECT_EQ(count(unit_scenes::step()), 2u);
    EXPECT_EQ(count(unit_scenes::smooth()), 1u);
}

/// Fig. 4.3: the bound on the distance keeps outliers from joining two seats.
TEST(segment_surfaces, max_distance_breaks_the_bridge_of_outliers) {
    const auto s = unit_scenes::outlier_bridge();
    constexpr double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(gnomon::segment_surfaces(s.points, s.surface, {.max_distance = 0.25}).size(), 2u);
    EXPECT_EQ(gnomon::segment_surfaces(s.points, s.surface, {.max_distance = inf}).size(), 1u);
}

/// The two sides of a thin board, seen from both sides.
TEST(segment_surfaces, oriented_keeps_the_sides_of_a_board_apart) {
    unit_scenes::scene board;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) {
            board.add({0.01 * i, 0.01 * j, 0.0}, {0, 0, -1});
            board.add({0.01 * i, 0.01 * j, 0.01}, {0, 0, 1});
        }
    }
    EXPECT_EQ(gnomon::segment_surfaces(board.points, board.surface).size(), 1u);
    EXPECT_EQ(gnomon::segment_surfaces(board.points, board.surface, {.oriented = true}).size(), 2u);
}

/// Spec of Sec. 4.2.5: about half of the neighbors lie within the mean distance (4/9 in the plane).
TEST(segment_surfaces, radius_holds_about_half_of_the_neighbors) {
    const auto points = clouds::sheet(4000, 3);
    const auto graph = knn{50}(points);
    const auto surface = gnomon::estimate_normals(points, graph, plane_pca{});
    double within = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const auto j : graph[i])
            within += (points[i] - points[j]).norm() <= surface[i].mean_distance;
    }
    const double share = within / (50.0 * static_cast<double>(points.size()));
    EXPECT_GT(share, 0.40);
    EXPECT_LT(share, 0.55);
}

/// Order, place and attitude of the cloud do not matter where no ties are.
TEST(segment_surfaces, partition_survives_permutation_translation_and_rotation) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto points =
            sim::simulate(sim::box_and_cylinder{.points = 5000, .seed = seed}).scan.points;
        const auto labels = [](const clouds::cloud& cloud) {
            auto surface = gnomon::estimate_normals(cloud, knn{30}, plane_pca{});
            gnomon::repair_anisotropic(cloud, knn{30}, surface, plane_pca{});
            return gnomon::segment_surfaces(cloud, surface).labels();
        };
        const auto expected = labels(points);
        std::vector<std::size_t> order;
        const auto shuffled = labels(clouds::permuted(points, seed, order));
        std::vector<std::int32_t> restored(points.size());
        for (std::size_t i = 0; i < order.size(); ++i) restored[order[i]] = shuffled[i];
        EXPECT_EQ(laws::rand_index(restored, expected), 1.0);
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        EXPECT_EQ(labels(clouds::moved(points, r, {1, -2, 3})), expected);
    }
}

/// A regular grid, where every neighbor is exactly as far as the mean: turning it changes nothing.
TEST(segment_surfaces, partition_of_a_grid_survives_rotation) {
    clouds::cloud grid;
    for (int i = 0; i < 40; ++i) {
        for (int j = 0; j < 40; ++j) grid.push_back({0.1 * i, 0.1 * j, 0.0});
    }
    const knn policy{.k = 4, .ties = gnomon::tie_rule::all};
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const auto turned = clouds::moved(grid, clouds::random_rotation(seed), {1, 2, 3});
        const auto surface = gnomon::estimate_normals(turned, policy, plane_pca{});
        EXPECT_EQ(gnomon::segment_surfaces(turned, surface, {.min_points = 1}).size(), 1u);
    }
}

/// At the ends of the range of angles: equal normals are equal, and anything goes at 90 degrees.
TEST(segment_surfaces, is_exact_at_thresholds_of_0_and_90_degrees) {
    auto s = unit_scenes::corner();
    EXPECT_EQ(
        gnomon::segment_surfaces(s.points, s.surface, {.max_angle = gnomon::degrees(0)}).size(),
        2u);
    EXPECT_EQ(
        gnomon::segment_surfaces(s.points, s.surface, {.max_angle = gnomon::degrees(90)}).size(),
        1u);
}

/// A negative or NaN distance in a surface made by hand joins nothing.
TEST(segment_surfaces, joins_nothing_within_no_distance) {
    for (const double bad : {-5.0, clouds::nan}) {
        auto s = unit_scenes::smooth();
        for (auto& e : s.surface) e.mean_distance = bad;
        EXPECT_TRUE(gnomon::segment_surfaces(s.points, s.surface).empty());
        EXPECT_TRUE(gnomon::segment_surfaces(s.points, knn{5}(s.points), s.surface).empty());
    }
}

TEST(segment_surfaces, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto surface = gnomon::estimate_normals(points, knn{10}, plane_pca{});
        const auto parts = gnomon::segment_surfaces(
            points, surface, {.max_angle = gnomon::degrees(90), .min_points = 0});
        ASSERT_EQ(parts.labels().size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(parts.labels()[i] == gnomon::unlabeled, !gnomon::is_finite(points[i]));
        }
    }
}

TEST(segment_surfaces, refuses_bad_arguments) {
    const auto s = unit_scenes::smooth();
    const auto call = [&](const segment_surfaces_options& options) {
        (void)gnomon::segment_surfaces(s.points, s.surface, options);
    };
    EXPECT_THROW(call({.max_angle = gnomon::degrees(91)}), std::invalid_argument);
    EXPECT_THROW(call({.max_angle = gnomon::degrees(-1)}), std::invalid_argument);
    EXPECT_THROW(call({.max_angle = gnomon::radians(clouds::nan)}), std::invalid_argument);
    EXPECT_THROW(call({.max_distance = clouds::nan}), std::invalid_argument);
    const auto fewer = clouds::in_cube(3, 1);
    EXPECT_THROW((void)gnomon::segment_surfaces(fewer, s.surface), std::invalid_argument);
    auto surface = s.surface;  // nor where there is no normal
    surface[1].normal.setZero();
    std::vector<std::vector<gnomon::point_index>> astray(s.points.size());
    astray[1] = {static_cast<gnomon::point_index>(s.points.size())};
    EXPECT_THROW((void)gnomon::segment_surfaces(s.points, astray, surface), std::invalid_argument);
    EXPECT_THROW((void)gnomon::segment_surfaces(s.points, knn{5}(fewer), s.surface),
                 std::invalid_argument);
}

}  // namespace

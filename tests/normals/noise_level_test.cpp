// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/normals/noise_level.hpp>

namespace {

using gnomon::noise_level;

/// A plane of 2 m x 2 m, with noise across.
clouds::cloud noisy_square(std::size_t n, double sigma, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    clouds::cloud points;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = 2.0 * random.uniform(), y = 2.0 * random.uniform();
        points.emplace_back(x, y, sigma * random.gaussian());
    }
    return points;
}

/// The quantile that edges call for reads a few per cent too little on one plane.
TEST(noise_level, is_the_deviation_across_a_plane) {
    for (const double sigma : {1e-3, 5e-3, 2e-2}) {
        SCOPED_TRACE(sigma);
        const double found = noise_level(noisy_square(20000, sigma, 3));
        EXPECT_GT(found, 0.8 * sigma);
        EXPECT_LT(found, 1.02 * sigma);
    }
}

TEST(noise_level, is_zero_for_clean_flat_pieces_with_edges) {
    clouds::cloud points = noisy_square(10000, 0.0, 5);
    for (std::size_t i = 0; i < points.size(); i += 2)
        points[i] = {points[i].x(), 0.0, points[i].y()};
    EXPECT_LT(noise_level(points), 1e-9);
}

/// A plane would read the bend of a ball of points as noise of about half a percent of its radius.
TEST(noise_level, is_nearly_zero_on_clean_bends) {
    gnomon::random_stream random(11);
    clouds::cloud points;
    for (int i = 0; i < 2000; ++i) points.push_back(clouds::gaussian_vector(random).normalized());
    EXPECT_LT(noise_level(points), 2e-4);
}

/// Edges add nothing.
TEST(noise_level, is_not_fooled_by_an_edge) {
    clouds::cloud points = noisy_square(20000, 5e-3, 7);
    for (std::size_t i = 0; i < points.size(); i += 2)
        points[i] = {points[i].x(), points[i].z(), points[i].y()};
    EXPECT_NEAR(noise_level(points), 5e-3, 1e-3);
}

TEST(noise_level, follows_size_and_place) {
    const clouds::cloud points = noisy_square(5000, 0.01, 9);
    const double sigma = noise_level(points);
    const Eigen::Matrix3d turn = clouds::random_rotation(4);
    EXPECT_NEAR(noise_level(clouds::moved(points, turn, {6e5, 4.8e6, 100})), sigma, 1e-6);
    EXPECT_NEAR(noise_level(clouds::moved(points, 1e-3 * turn, {0, 0, 0})), 1e-3 * sigma, 1e-12);
}

TEST(noise_level, survives_degenerate_clouds) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        EXPECT_GE(noise_level(points), 0.0);  // no NaN
    }
    EXPECT_EQ(noise_level(clouds::cloud{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 0.0);
}

}  // namespace

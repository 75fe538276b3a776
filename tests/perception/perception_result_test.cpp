// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/supervised.hpp>
#include <gnomon/neighborhoods/noise_knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/perception/perception.hpp>
#include <gnomon/perception/perception_result.hpp>

namespace {

/// A square wall, seen from the origin.
gnomon::scan wall() {
    gnomon::scan scan;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) scan.points.emplace_back(2.0, 0.02 * i, 0.02 * j);
    return scan;
}

TEST(perception_result, begins_empty) {
    const gnomon::perception_result<gnomon::plane_fit> none;
    EXPECT_FALSE(none.floor || none.ceiling);
    EXPECT_TRUE(none.kept.empty() && none.surface.empty() && none.gaps.empty());
    EXPECT_TRUE(none.initial_segments.empty() && none.surfaces.empty());
    EXPECT_EQ(none.index.size(), 0u);
    EXPECT_TRUE(none.planes.empty() && none.steps.empty());
    EXPECT_EQ(none.seconds(), 0.0);
    EXPECT_FALSE(none.noise.is_across_surface);
    EXPECT_TRUE(none.noise.curve.is_zero() && none.noise.of_planes.is_zero());
}

/// Copies and moved results are values like any other, and can be used for the next call.
TEST(perception_result, is_a_value) {
    const std::vector<Eigen::Vector3d> points = wall().points;
    const gnomon::perception<> chain;
    auto first = chain(points);
    ASSERT_EQ(first.surfaces.size(), 1u);
    auto copy = first;
    const auto moved = std::move(first);
    EXPECT_EQ(copy.surfaces, moved.surfaces);
    chain.into(copy, points);
    EXPECT_EQ(copy.surfaces, moved.surfaces);
    first = std::move(copy);
    chain.into(first, points);
    EXPECT_EQ(first.surfaces, moved.surfaces);
    copy = first;
    chain.into(copy, points, gnomon::team(2));
    EXPECT_EQ(copy.surfaces, moved.surfaces);
}

/// The result of one call holds nothing of the call before.
TEST(perception_result, has_no_index_if_one_was_given) {
    const gnomon::scan scan = wall();
    const gnomon::perception<> chain;
    auto result = chain(scan);
    EXPECT_EQ(result.index.size(), scan.size());
    chain.into(result, gnomon::spatial_index(scan));
    EXPECT_EQ(result.index.size(), 0u);
    EXPECT_EQ(result.surfaces.size(), 1u);
}

/// Its own index is an index like any other.
TEST(perception_result, gives_its_index_to_the_next_call) {
    const gnomon::scan scan = wall();
    const gnomon::perception<> chain;
    auto result = chain(scan);
    const auto surfaces = result.surfaces;
    for (int call = 0; call < 2; ++call) {
        chain.into(result, result.index);
        EXPECT_EQ(result.surfaces, surfaces);
        EXPECT_EQ(result.index.size(), scan.size());
    }
}

/// A caller who follows the progress hears of as many steps as were announced, which are those of
/// the result.
TEST(perception_result, comes_after_as_many_steps_as_announced) {
    const gnomon::scan scan = wall();
    const auto expect_all = [&](const auto& chain, std::size_t expected) {
        std::vector<std::string> names;
        std::size_t all = 0;
        const auto on_step = [&](const char* name, std::size_t step, std::size_t steps) {
            names.emplace_back(name);
            EXPECT_EQ(step, names.size());
            all = steps;
        };
        const auto result = chain(scan, gnomon::supervised(gnomon::sequential{}, {}, on_step));
        EXPECT_EQ(names.size(), expected);
        EXPECT_EQ(all, expected);
        ASSERT_EQ(result.steps.size(), expected);
        double sum = 0.0;
        for (std::size_t s = 0; s < expected; ++s) {
            EXPECT_EQ(result.steps[s].name, names[s]);
            EXPECT_GE(result.steps[s].seconds, 0.0);
            sum += result.steps[s].seconds;
        }
        EXPECT_DOUBLE_EQ(result.seconds(), sum);
    };
    using gnomon::conservative, gnomon::no_merging, gnomon::noise_knn, gnomon::plane_pca,
        gnomon::planes_on_cells, gnomon::smooth_surfaces;
    expect_all(gnomon::perception<>{}, 9);
    expect_all(gnomon::perception{noise_knn{}, plane_pca{}, no_merging{}}, 8);
    expect_all(gnomon::perception{noise_knn{}, plane_pca{}, conservative{}, smooth_surfaces{}}, 7);
    expect_all(gnomon::perception{noise_knn{}, plane_pca{}, no_merging{}, smooth_surfaces{}}, 6);
}

}  // namespace

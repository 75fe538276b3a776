// SPDX-License-Identifier: BSL-1.0
/// How many trees an algorithm builds. An executable of its own: the count is compiled in only
/// where GNOMON_COUNT_TREES is defined.
#include <cstddef>

#include <gtest/gtest.h>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

namespace {

namespace sim = gnomon::simulation;

const gnomon::scan& kitchen() {
    static const gnomon::scan scan = [] {
        const sim::scene world = sim::scenes::kitchen();
        return sim::simulate(world, sim::rotational{.mount = world.sensor},
                             sim::densities::medium(), {.sigma = 0.015, .seed = 1})
            .scan;
    }();
    return scan;
}

std::size_t trees_built_by(auto&& work) {
    const std::size_t before = gnomon::detail::trees_built;
    work();
    return gnomon::detail::trees_built - before;
}

const gnomon::noise_curve noise = gnomon::constant_noise{0.015};

const gnomon::noise_knn along_lines{.sees_across_lines = false};

/// One of the points, and one of their cells; one of the points' directions, where planes of cells
/// are measured, as some points have all neighbors on one scan line.
TEST(one_tree, serves_all_steps_of_perception) {
    const gnomon::perception<> chain{.neighborhood = along_lines, .noise = noise};
    EXPECT_EQ(trees_built_by([&] { EXPECT_GT(chain(kitchen()).surfaces.size(), 5u); }), 3u);
    EXPECT_EQ(trees_built_by([&] { (void)chain(kitchen(), gnomon::threads{2}); }), 3u);
    const gnomon::perception<> above_floor{
        .neighborhood = along_lines, .noise = noise, .leave_out = gnomon::floor_and_ceiling{}};
    EXPECT_EQ(
        trees_built_by([&] { EXPECT_LT(above_floor(kitchen()).kept.size(), kitchen().size()); }),
        3u);
    const gnomon::perception<gnomon::knn, gnomon::plane_pca, gnomon::conservative,
                             gnomon::smooth_surfaces>
        on_points{.noise = noise};
    EXPECT_EQ(trees_built_by([&] { (void)on_points(kitchen()); }), 1u);
}

/// One more, of the directions of the cells.
TEST(one_tree, is_joined_by_one_of_directions_where_lines_are_far_apart) {
    EXPECT_EQ(trees_built_by([&] { (void)gnomon::perception<>{.noise = noise}(kitchen()); }), 4u);
    EXPECT_EQ(trees_built_by([&] { (void)gnomon::perception<>{}(kitchen()); }), 4u);
    const gnomon::spatial_index index(kitchen());
    EXPECT_EQ(trees_built_by([&] { (void)gnomon::noise_knn{}(index, gnomon::threads{4}); }), 1u);
    EXPECT_EQ(trees_built_by([&] { (void)gnomon::noise_knn{}(index); }), 0u);
}

TEST(one_tree, is_not_built_where_an_index_is_given) {
    const gnomon::spatial_index index(kitchen());
    const gnomon::perception<> chain{.neighborhood = along_lines, .noise = noise};
    EXPECT_EQ(trees_built_by([&] { (void)chain(index); }), 2u) << "of cells and directions";
    EXPECT_EQ(trees_built_by([&] {
                  auto surface = gnomon::estimate_normals(index);
                  gnomon::repair_anisotropic(index, gnomon::knn{.k = 30}, surface,
                                             gnomon::plane_pca{});
                  const auto parts = gnomon::segment_surfaces(index, surface);
                  (void)gnomon::euclidean_clusters(index);
                  const auto graph = along_lines(index);
                  (void)gnomon::segment_planes(index, graph, surface);
                  (void)gnomon::split_outliers(index, parts, noise);
                  (void)gnomon::assign_unlabeled(index, graph, parts, noise);
                  (void)gnomon::estimate_planes(index, parts, noise);
                  (void)gnomon::merge_occluded(index, parts, gnomon::visibility(index));
                  (void)gnomon::noise_level(index);
                  (void)gnomon::knn{.k = 10}(index);
                  (void)gnomon::radius{.r = 0.05}(index);
                  (void)gnomon::delaunay{}(index);
                  (void)gnomon::estimate_normals(index, gnomon::feature_preserving{});
              }),
              0u);
    EXPECT_EQ(trees_built_by([&] { (void)gnomon::estimate_normals(kitchen()); }), 1u);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include "segmentation/unit_scenes.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation/extend_segments.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>

namespace {

using gnomon::knn, gnomon::segments, gnomon::unlabeled;

/// A strip of points along x of which the first ten and the last ten are segments.
struct strip : unit_scenes::scene {
    std::vector<std::int32_t> labels;

    explicit strip(auto&& height) {
        for (int i = 0; i < 40; ++i) {
            for (int j = 0; j < 5; ++j) {
                add({0.01 * i, 0.01 * j, height(i)}, {0, 0, 1});
                labels.push_back(i < 10 ? 0 : i >= 30 ? 1 : unlabeled);
            }
        }
    }
    [[nodiscard]] segments extended(const gnomon::extend_segments_options& options = {}) const {
        return gnomon::extend_segments(points, knn{8}(points), surface, segments(labels), options);
    }
};

/// Where two segments meet, what decides is the distance from their planes.
TEST(extend_segments, gives_points_to_the_plane_they_lie_on) {
    strip scene([](int i) { return i < 22 ? 0.0 : 0.005; });
    for (std::size_t i = 0; i < 200; ++i) scene.labels[i] = i < 100 ? 0 : i >= 115 ? 1 : unlabeled;
    const segments found = scene.extended();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].size(), 110u);
    EXPECT_EQ(found[1].size(), 90u);
    EXPECT_EQ(found[0].back(), 109u);
}

TEST(extend_segments, respects_its_limits) {
    const strip scene([](int) { return 0.0; });
    EXPECT_EQ(scene.extended({.neighborhoods = 0}), segments(scene.labels));
    const segments once = scene.extended({.neighborhoods = 1});
    EXPECT_GE(once[0].size() + once[1].size(), 110u);  // 8 neighbors reach one column, or two
    EXPECT_LE(once[0].size() + once[1].size(), 120u);
    const segments all = scene.extended({.neighborhoods = 40});
    EXPECT_EQ(all[0].size() + all[1].size(), 200u);
}

TEST(extend_segments, skips_points_with_different_or_missing_normals) {
    strip scene([](int) { return 0.0; });
    for (std::size_t i = 50; i < 75; ++i) scene.surface[i].normal = {1, 0, 0};
    for (std::size_t i = 75; i < 100; ++i) scene.surface[i].normal.setZero();
    const segments found = scene.extended({.neighborhoods = 40});
    for (std::size_t i = 50; i < 100; ++i) EXPECT_EQ(found.labels()[i], unlabeled);
    EXPECT_EQ(found[0].size(), 100u);  // the segment at the far end, relabeled
    EXPECT_EQ(found.labels()[199], 0);
}

TEST(extend_segments, keeps_labels_and_recovers_edges) {
    const auto scene = unit_scenes::corner();
    const auto graph = knn{12}(scene.points);
    const auto surface = gnomon::estimate_normals(scene.points, knn{40}, gnomon::plane_pca{});
    const auto found = gnomon::segment_surfaces(scene.points, surface);
    const auto more = gnomon::extend_segments(scene.points, graph, surface, found,
                                              {.max_angle = gnomon::degrees(30)});
    std::size_t before = 0, after = 0;
    std::vector<std::int32_t> had, has;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
        before += found.labels()[i] != unlabeled;
        after += more.labels()[i] != unlabeled;
        if (found.labels()[i] == unlabeled) continue;
        EXPECT_NE(more.labels()[i], unlabeled);
        had.push_back(found.labels()[i]);
        has.push_back(more.labels()[i]);
    }
    EXPECT_EQ(laws::rand_index(has, had), 1.0);
    EXPECT_GT(after, before);
}

/// Who has no normal has no say, however wide the angle.
TEST(extend_segments, counts_only_neighbors_with_a_normal) {
    const clouds::cloud points{{0, 0, 0}, {0.1, 0, 0.3}, {0.1, 0, 0.2}};
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface(3);
    surface[0].normal = surface[2].normal = Eigen::Vector3d::UnitZ();
    const auto labels = gnomon::extend_segments(points, knn{2}(points), surface,
                                                gnomon::segments({unlabeled, 0, 1}),
                                                {.max_angle = gnomon::degrees(90)})
                            .labels();
    EXPECT_EQ(labels[0], labels[2]);
    EXPECT_NE(labels[0], labels[1]);
}

TEST(extend_segments, is_the_same_on_any_threads_and_survives_permutation_and_motion) {
    const auto points = clouds::sheet(3000, 4, 0.003);
    const auto labels = [](const clouds::cloud& cloud, unsigned t) {
        const auto graph = knn{12}(cloud);
        const auto surface = gnomon::estimate_normals(cloud, graph, gnomon::plane_pca{});
        const auto found = gnomon::segment_surfaces(cloud, surface);
        return gnomon::extend_segments(cloud, graph, surface, found, {}, gnomon::threads{t})
            .labels();
    };
    const auto expected = labels(points, 1);
    EXPECT_EQ(labels(points, 4), expected);
    std::vector<std::size_t> order;
    const auto shuffled = labels(clouds::permuted(points, 2, order), 1);
    std::vector<std::int32_t> restored(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) restored[order[i]] = shuffled[i];
    EXPECT_GT(laws::rand_index(restored, expected), 0.9999);
    const auto moved = clouds::moved(points, clouds::random_rotation(3), {1, 2, 3});
    EXPECT_GT(laws::rand_index(labels(moved, 1), expected), 0.9999);
}

TEST(extend_segments, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto graph = knn{10}(points);
        const auto surface = gnomon::estimate_normals(points, graph, gnomon::plane_pca{});
        std::vector<std::int32_t> labels(points.size(), unlabeled);
        if (!labels.empty() && gnomon::is_finite(points[0])) labels[0] = 0;
        const auto found =
            gnomon::extend_segments(points, graph, surface, segments(std::move(labels)));
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (gnomon::is_finite(points[i])) continue;
            EXPECT_EQ(found.labels()[i], unlabeled);
        }
    }
}

TEST(extend_segments, refuses_bad_arguments) {
    const strip scene([](int) { return 0.0; });
    EXPECT_THROW((void)scene.extended({.max_angle = gnomon::degrees(91)}), std::invalid_argument);
    const auto graph = knn{8}(scene.points);
    const segments found(scene.labels);
    const auto fewer = clouds::sheet(50, 1);
    EXPECT_THROW((void)gnomon::extend_segments(fewer, graph, scene.surface, found),
                 std::invalid_argument);
    EXPECT_THROW((void)gnomon::extend_segments(fewer, knn{8}(fewer), scene.surface, found),
                 std::invalid_argument);
    EXPECT_THROW((void)gnomon::extend_segments(scene.points, graph, scene.surface,
                                               segments(std::vector<std::int32_t>(3, 0))),
                 std::invalid_argument);
    const std::vector<std::vector<gnomon::point_index>> astray(scene.points.size(), {1000});
    EXPECT_THROW((void)gnomon::extend_segments(scene.points, astray, scene.surface, found),
                 std::invalid_argument);
}

}  // namespace

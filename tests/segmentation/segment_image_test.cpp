// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/images.hpp"
#include "shared_file.hpp"
#include <gnomon/core/range_noise.hpp>
#include <gnomon/io/read_pcd.hpp>
#include <gnomon/neighborhoods/raster.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/ray_ls.hpp>
#include <gnomon/segmentation/segment_image.hpp>

namespace {

using gnomon::plane_pca, gnomon::raster;

const Eigen::Vector3d optical_axis(0.0, 0.0, 1.0);
const gnomon::noise_curve kinect(gnomon::noises::structured_light(), optical_axis);

/// A corner of a room with a board before the wall, as the first Kinect measures it.
struct room_corner {
    static constexpr std::size_t width = 320, height = 240;
    std::vector<int> truth;
    clouds::cloud image = images::of_planes(
        {{{0, 0, 1}, 3.5}, {{0, 1, 0}, 0.7}, {{1, 0, 0.2}, 1.3}, {{-0.6, 0, 0.8}, 2.9}}, width,
        height, &truth);

    explicit room_corner(double lost = 0.05) {
        for (std::size_t y = 40; y < 100; ++y) {
            for (std::size_t x = 60; x < 140; ++x) {
                image[y * width + x] = 2.0 * images::ray(x, y, width, height);
                truth[y * width + x] = 4;
            }
        }
        // Half of the noise of the model, as the other half are the steps.
        image = images::measured(
            std::move(image), [](double z) { return 0.5 * kinect(z); }, lost, 1);
        images::quantize(image);
    }
};

/// The share of the points that are labeled, and share a segment with most of its true plane.
double share_right(const std::vector<int>& truth, const gnomon::segments& parts, std::size_t n) {
    std::size_t right = 0;
    std::map<int, std::size_t> best;  // segment of each plane
    for (std::size_t s = 0; s < parts.size(); ++s) {
        std::map<int, std::size_t> counts;
        for (const auto i : parts[s]) ++counts[truth[i]];
        for (const auto& [plane, count] : counts)
            if (2 * count > parts[s].size()) best[plane] = std::max(best[plane], count);
    }
    for (const auto& [plane, count] : best) right += count;
    return static_cast<double>(right) / static_cast<double>(n);
}

std::size_t returns(const clouds::cloud& image) {
    std::size_t n = 0;
    for (const Eigen::Vector3d& p : image) n += gnomon::is_finite(p) ? 1 : 0;
    return n;
}

TEST(image_surfaces, of_a_depth_camera_are_whole_in_spite_of_noise_and_steps) {
    const room_corner scene;
    const raster pixels{.width = scene.width, .noise = kinect};
    const auto surface = gnomon::estimate_normals(scene.image, pixels, plane_pca{});
    const auto parts = gnomon::segment_surfaces(scene.image, pixels, surface);
    EXPECT_GE(share_right(scene.truth, parts, returns(scene.image)), 0.97);
    EXPECT_LE(parts.size(), 10u);
    for (const unsigned t : {2u, 4u})
        EXPECT_EQ(gnomon::segment_surfaces(scene.image, pixels, surface, {}, gnomon::threads{t}),
                  parts);
    // An estimate without the variances of windows is enough.
    const auto bare = gnomon::estimate_normals(scene.image, pixels, gnomon::ray_ls{});
    const auto alike = gnomon::segment_surfaces(scene.image, pixels, bare);
    EXPECT_GE(share_right(scene.truth, alike, returns(scene.image)), 0.95);
}

TEST(image_surfaces, are_the_same_far_from_the_origin) {
    const room_corner scene;
    const Eigen::Vector3d far(6e5, 4.8e6, 300.0);
    const auto moved = clouds::moved(scene.image, Eigen::Matrix3d::Identity(), far);
    const raster pixels{.width = scene.width, .noise = kinect};
    const auto surface = gnomon::estimate_normals(scene.image, pixels, plane_pca{});
    EXPECT_EQ(gnomon::segment_surfaces(gnomon::with_viewpoint(moved, far), pixels, surface),
              gnomon::segment_surfaces(scene.image, pixels, surface));
}

TEST(image_surfaces, end_at_jumps_at_long_links_and_where_normals_turn) {
    constexpr std::size_t width = 60;
    const gnomon::constant_noise sigma{0.001};
    const auto parts_of = [&](const clouds::cloud& image,
                              const gnomon::segment_surfaces_options& options = {}) {
        const raster pixels{.width = width, .noise = sigma};
        const auto surface = gnomon::estimate_normals(image, pixels, plane_pca{});
        return gnomon::segment_surfaces(image, pixels, surface, options).size();
    };
    auto wall = images::of_planes({{{0, 0, 1}, 2.0}}, width, width);
    EXPECT_EQ(parts_of(wall), 1u);
    EXPECT_EQ(parts_of(wall, {.max_distance = 0.003}), 0u);  // pixels are 3.8 mm apart
    EXPECT_EQ(parts_of(wall, {.min_points = width * width + 1}), 0u);
    auto step = wall;
    for (std::size_t i = 0; i < step.size(); ++i)
        if (i % width >= width / 2) step[i] *= 1.1;
    EXPECT_EQ(parts_of(step), 2u);
    auto gap = images::of_planes({{{0, 0, 1}, 10.0}}, width, width);  // of 0.2 m
    for (std::size_t i = 0; i < gap.size(); ++i)
        if (i % width >= 25 && i % width < 35) gap[i].setConstant(clouds::nan);
    EXPECT_EQ(parts_of(gap), 1u);
    EXPECT_EQ(parts_of(gap, {.max_distance = 0.1}), 2u);
    auto sparse = wall;
    for (std::size_t i = 0; i < sparse.size(); ++i)
        if (i % 2 == 0 || i / width % 2 == 1) sparse[i].setConstant(clouds::nan);
    EXPECT_EQ(parts_of(sparse), 1u);
    for (const double slope : {0.3, 1.0}) {
        const auto edge =
            images::of_planes({{{slope, 0, 1}, 2.0}, {{-slope, 0, 1}, 2.0}}, width, width);
        EXPECT_EQ(parts_of(edge), 2u);
    }
}

TEST(image_surfaces, label_points_only) {
    const room_corner scene(0.3);
    const raster pixels{.width = scene.width, .noise = kinect};
    const auto surface = gnomon::estimate_normals(scene.image, pixels, plane_pca{});
    const auto labels = gnomon::segment_surfaces(scene.image, pixels, surface).labels();
    for (std::size_t i = 0; i < labels.size(); ++i)
        ASSERT_TRUE(gnomon::is_finite(scene.image[i]) || labels[i] == gnomon::unlabeled);
    const clouds::cloud nothing(12, Eigen::Vector3d::Constant(clouds::nan));
    const raster small{.width = 4};
    EXPECT_TRUE(
        gnomon::segment_surfaces(nothing, small, gnomon::estimate_normals(nothing, small)).empty());
}

TEST(image_surfaces, refuse_what_is_no_image) {
    const room_corner scene;
    const raster pixels{.width = scene.width, .noise = kinect};
    auto surface = gnomon::estimate_normals(scene.image, pixels, plane_pca{});
    const auto refuses = [&](const raster& wrong) {
        EXPECT_THROW((void)gnomon::segment_surfaces(scene.image, wrong, surface),
                     std::invalid_argument);
    };
    refuses({});
    refuses({.width = 321});
    refuses({.width = scene.width, .radius = 0});
    EXPECT_THROW((void)gnomon::segment_surfaces(scene.image, pixels, surface,
                                                {.max_angle = gnomon::degrees(91)}),
                 std::invalid_argument);
    surface.pop_back();
    refuses(pixels);
}

/// Walls and floor are one segment each.
TEST(image_surfaces, of_a_real_frame_are_few_and_large) {
    const auto file = shared_file("scans/pcl_office1_kinect.pcd");
    if (file.empty()) GTEST_SKIP() << "needs shared data";
    const gnomon::scan scan = gnomon::io::read_pcd(gnomon::io::load(file));
    ASSERT_EQ(scan.width, 640u);
    const raster pixels{.noise = kinect};
    const auto surface = gnomon::estimate_normals(scan, pixels, plane_pca{});
    const auto parts = gnomon::segment_surfaces(scan, pixels, surface);
    std::size_t large = 0, labeled = 0;
    for (std::size_t s = 0; s < parts.size(); ++s) {
        labeled += parts[s].size();
        large += s < 10 ? parts[s].size() : 0;
    }
    const auto n = static_cast<double>(returns(scan.points));
    EXPECT_GE(static_cast<double>(labeled) / n, 0.95);
    EXPECT_GE(static_cast<double>(large) / n, 0.75);
    EXPECT_GE(static_cast<double>(parts[0].size()) / n, 0.25);
}

}  // namespace

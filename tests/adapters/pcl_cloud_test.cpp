// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/point_range_laws.hpp"
#include "pcl_cloud_like.hpp"
#include <gnomon/adapters/pcl_cloud.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace {

using pcl_like::cloud_of;
using pcl_like::point_normal;
using pcl_like::point_xyz;
using pcl_like::point_xyzl;

constexpr float pcl_no_number = std::numeric_limits<float>::quiet_NaN();

gnomon::scan sphere_scan(std::size_t points) {
    gnomon::random_stream random(11);
    gnomon::scan s;
    for (std::size_t i = 0; i < points; ++i)
        s.points.push_back(
            Eigen::Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5)
                .normalized());
    s.viewpoints = Eigen::Vector3d(0.25, -3, 8);
    return s;
}

TEST(adapters_pcl_cloud, points_of_a_cloud_are_a_point_range_with_its_sensor) {
    cloud_of<point_xyz> cloud;
    cloud.points.resize(6);
    for (std::size_t i = 0; i < 6; ++i) cloud.points[i].x = static_cast<float>(i);
    cloud.width = 6;
    cloud.height = 1;
    cloud.sensor_origin_ = {1, 2, -3, 0};
    const auto points = gnomon::pcl_points(cloud);
    laws::point_range_laws(points);
    laws::each_point_has_a_viewpoint(points);
    EXPECT_EQ(points.size(), 6U);
    EXPECT_EQ(points.viewpoints[5], Eigen::Vector3d(1, 2, -3));
    EXPECT_EQ(points.width, 0U);  // a list
    EXPECT_EQ(&*points.begin(), cloud.points.data());
    cloud.width = 3;
    cloud.height = 2;
    EXPECT_EQ(gnomon::pcl_points(cloud).width, 3U);
}

TEST(adapters_pcl_cloud, points_come_back) {
    gnomon::scan s = sphere_scan(12);
    s.points[4].x() = std::numeric_limits<double>::quiet_NaN();
    s.width = 4;
    const auto cloud = gnomon::to_pcl<cloud_of<point_xyz>>(s);
    EXPECT_EQ(cloud.width, 4U);
    EXPECT_EQ(cloud.height, 3U);
    EXPECT_FALSE(cloud.is_dense);
    const auto again = gnomon::pcl_points(cloud);
    EXPECT_EQ(again.width, 4U);
    EXPECT_EQ(again.viewpoints[0], s.viewpoints[0]);
    const gnomon::position_view positions(again);
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (i == 4)
            EXPECT_TRUE(std::isnan(positions[i].x()));
        else
            EXPECT_EQ(positions[i], s.points[i].cast<float>().cast<double>());
    }
    s.points.pop_back();  // no image any more
    EXPECT_EQ(gnomon::to_pcl<cloud_of<point_xyz>>(s).width, 11U);
    const auto empty = gnomon::to_pcl<cloud_of<point_xyz>>(std::vector<Eigen::Vector3d>{});
    EXPECT_EQ(empty.width * empty.height, 0U);
    EXPECT_TRUE(empty.is_dense);
}

TEST(adapters_pcl_cloud, coordinates_of_maps_need_an_origin) {
    gnomon::scan s;
    s.points = {{691234.125, 5335678.25, 515}};
    s.viewpoints = Eigen::Vector3d(691230, 5335670, 514);
    using cloud = cloud_of<point_xyz>;
    EXPECT_THROW(static_cast<void>(gnomon::to_pcl<cloud>(s)), std::invalid_argument);
    const auto local = gnomon::to_pcl<cloud>(s, {691000, 5335000, 500});
    EXPECT_EQ(local.points[0].x, 234.125F);
    EXPECT_EQ(local.points[0].y, 678.25F);
    EXPECT_EQ(local.sensor_origin_[1], 670.0F);
    s.points[0].x() = 1e300;
    EXPECT_THROW(static_cast<void>(gnomon::to_pcl<cloud>(s)), std::invalid_argument);
}

/// Normals go into a cloud and come back as unit vectors; missing ones as NaN.
TEST(adapters_pcl_cloud, normals_come_back) {
    gnomon::scan s = sphere_scan(500);
    s.points[7].y() = std::numeric_limits<double>::quiet_NaN();
    const auto surface = gnomon::estimate_normals(s, gnomon::knn{.k = 12}, gnomon::plane_pca{});
    auto cloud = gnomon::to_pcl<cloud_of<point_normal>>(s);
    gnomon::put_normals(cloud, surface);
    EXPECT_FALSE(cloud.is_dense);
    EXPECT_TRUE(std::isnan(cloud.points[7].normal_x));
    EXPECT_TRUE(std::isnan(cloud.points[7].curvature));
    const std::vector<gnomon::pcl_surfel> again = gnomon::pcl_surface(cloud);
    static_assert(gnomon::normal_range<std::vector<gnomon::pcl_surfel>>);
    ASSERT_EQ(again.size(), s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (i == 7) {
            EXPECT_TRUE(gnomon::is_missing(again[i].normal));
            EXPECT_EQ(again[i].trust, gnomon::trust::not_finite);
            continue;
        }
        EXPECT_EQ(again[i].trust, gnomon::trust::good);
        EXPECT_NEAR((again[i].normal - surface[i].normal).norm(), 0, 2e-7);
        EXPECT_NEAR(again[i].normal.norm(), 1, 1e-15);
        EXPECT_EQ(again[i].curvature, static_cast<float>(surface[i].surface_variation()));
        EXPECT_EQ(again[i].surface_variation(), again[i].curvature);  // as put_normals() takes it
    }
}

TEST(adapters_pcl_cloud, degenerate_normals_are_missing) {
    cloud_of<point_normal> cloud;
    cloud.points.resize(4);
    cloud.points[1].normal_y = 2;  // not of unit length
    cloud.points[2].normal_z = pcl_no_number;
    cloud.points[3].normal_z = std::numeric_limits<float>::infinity();
    const auto surface = gnomon::pcl_surface(cloud);
    EXPECT_EQ(surface[0].trust, gnomon::trust::degenerate);
    EXPECT_EQ(surface[1].normal, Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(surface[2].trust, gnomon::trust::not_finite);
    EXPECT_EQ(surface[3].trust, gnomon::trust::not_finite);
    for (const std::size_t i : {0U, 2U, 3U}) EXPECT_TRUE(gnomon::is_missing(surface[i].normal));
}

TEST(adapters_pcl_cloud, labels_come_back) {
    const gnomon::segments parts(std::vector<std::int32_t>{-1, 0, 2, 1, 0, -1});
    auto cloud = gnomon::to_pcl<cloud_of<point_xyzl>>(std::vector<Eigen::Vector3d>(6, {1, 2, 3}));
    gnomon::put_labels(cloud, parts);
    EXPECT_EQ(cloud.points[0].label, 4294967295U);
    EXPECT_EQ(cloud.points[2].label, 2U);
    EXPECT_EQ(gnomon::segments(gnomon::pcl_labels(cloud)), parts);
    cloud.points[3].label = 2147483647U;
    EXPECT_EQ(gnomon::pcl_labels(cloud)[3], 2147483647);
    for (const std::uint32_t label : {2147483648U, 4294967294U}) {
        cloud.points[3].label = label;
        EXPECT_THROW(static_cast<void>(gnomon::pcl_labels(cloud)), gnomon::error);
    }
}

TEST(adapters_pcl_cloud, refuses_other_sizes) {
    cloud_of<point_normal> normals;
    normals.points.resize(3);
    EXPECT_THROW(gnomon::put_normals(normals, std::vector<gnomon::pcl_surfel>(2)),
                 std::invalid_argument);
    cloud_of<point_xyzl> labels;
    labels.points.resize(3);
    EXPECT_THROW(gnomon::put_labels(labels, gnomon::segments({0, 1})), std::invalid_argument);
}

}  // namespace

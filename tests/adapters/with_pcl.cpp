// SPDX-License-Identifier: BSL-1.0
// The adapter and the PCD files with PCL itself; built where GNOMON_TEST_PCL is on.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/adapters/pcl_cloud.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/label_properties.hpp>
#include <gnomon/io/read_pcd.hpp>
#include <gnomon/io/write_pcd.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace {

gnomon::scan bumpy_plane() {
    gnomon::random_stream random(8);
    gnomon::scan s;
    for (int i = 0; i < 400; ++i) s.points.emplace_back(i % 20, i / 20, 0.1 * random.uniform());
    s.points[5].z() = std::nan("");
    s.viewpoints = Eigen::Vector3d(1, 2, 30);
    s.width = 20;
    return s;
}

TEST(with_pcl, clouds_go_both_ways) {
    const gnomon::scan s = bumpy_plane();
    auto cloud = gnomon::to_pcl<pcl::PointCloud<pcl::PointXYZLNormal>>(s);
    const auto points = gnomon::pcl_points(cloud);
    EXPECT_EQ(points.width, 20u);
    EXPECT_EQ(points.viewpoints[0], Eigen::Vector3d(1, 2, 30));
    const auto surface = gnomon::estimate_normals(points, gnomon::knn{.k = 9}, gnomon::plane_pca{});
    std::vector<std::int32_t> labels(s.size(), -1);
    for (std::size_t i = 0; i < 300; ++i) labels[i] = static_cast<std::int32_t>(i % 3);
    const gnomon::segments parts(labels);
    gnomon::put_normals(cloud, surface);
    gnomon::put_labels(cloud, parts);
    EXPECT_TRUE(std::isnan(cloud[5].normal_x));
    EXPECT_EQ(cloud[300].label, 4294967295u);
    EXPECT_EQ(gnomon::segments(gnomon::pcl_labels(cloud)), parts);
    const auto again = gnomon::pcl_surface(cloud);
    for (std::size_t i = 0; i < s.size(); ++i)
        EXPECT_LE((again[i].normal - surface[i].normal).norm(), 2e-7);
}

TEST(with_pcl, reads_what_write_pcd_writes) {
    const gnomon::scan s = bumpy_plane();
    const auto surface = gnomon::estimate_normals(s, gnomon::knn{.k = 9}, gnomon::plane_pca{});
    std::vector<std::int32_t> labels;
    for (std::size_t i = 0; i < s.size(); ++i) labels.push_back(static_cast<std::int32_t>(i) - 1);
    for (const bool ascii : {false, true}) {
        const std::string path = testing::TempDir() + "with_pcl.pcd";
        gnomon::io::write_pcd(
            path, s, {gnomon::io::normal_properties(surface), gnomon::io::label_properties(labels)},
            {.ascii = ascii});
        pcl::PointCloud<pcl::PointXYZRGBNormal> colored;
        pcl::PointCloud<pcl::PointXYZL> labeled;
        ASSERT_EQ(pcl::io::loadPCDFile(path, colored), 0);
        ASSERT_EQ(pcl::io::loadPCDFile(path, labeled), 0);
        EXPECT_EQ(colored.width, 20u);
        EXPECT_EQ(colored.height, 20u);
        EXPECT_EQ(colored.sensor_origin_.head<3>(), Eigen::Vector3f(1, 2, 30));
        EXPECT_TRUE(std::isnan(colored[5].z));
        for (std::size_t i = 0; i < s.size(); ++i) {
            EXPECT_EQ(colored[i].x, static_cast<float>(s.points[i].x()));
            EXPECT_EQ(colored[i].normal_z, static_cast<float>(surface[i].normal.z()));
            EXPECT_EQ(colored[i].g, gnomon::io::label_color(labels[i])[1]);
            EXPECT_EQ(labeled[i].label, static_cast<std::uint32_t>(labels[i]));
        }
    }
}

TEST(with_pcl, writes_what_read_pcd_reads) {
    const auto cloud = gnomon::to_pcl<pcl::PointCloud<pcl::PointXYZ>>(bumpy_plane());
    const std::string path = testing::TempDir() + "of_pcl.pcd";
    ASSERT_EQ(pcl::io::savePCDFileBinaryCompressed(path, cloud), 0);
    const gnomon::scan again = gnomon::io::read_pcd(gnomon::io::load(path));
    EXPECT_EQ(again.width, 20u);
    EXPECT_EQ(again.viewpoints[0], Eigen::Vector3d(1, 2, 30));
    for (std::size_t i = 0; i < again.size(); ++i)
        if (i != 5) {
            EXPECT_EQ(again.points[i].cast<float>(), cloud[i].getVector3fMap());
        }
}

}  // namespace

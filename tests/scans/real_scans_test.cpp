// SPDX-License-Identifier: BSL-1.0
/// Real scans, through the whole chain. The files are not part of the repository; where they are
/// missing these tests, and no others, are passed over.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <gnomon/io/read.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/anisotropy.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/segmentation/surface_segmentation.hpp>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"

namespace {

using gnomon::knn, gnomon::plane_pca, gnomon::threads;

bool have_scans() {
    std::FILE* file = std::fopen(GNOMON_SHARED_DATA "/MANIFEST.tsv", "rb");
    return file != nullptr && std::fclose(file) == 0;
}

gnomon::scan read_scan(const std::string& name) {
    return gnomon::io::read(GNOMON_SHARED_DATA "/" + name);
}

/// The chain with the thesis's parameters.
gnomon::segments segment(const clouds::cloud& points) {
    auto surface = gnomon::estimate_normals(points, knn{}, plane_pca{}, threads{});
    gnomon::repair_anisotropic(points, surface, knn{}, plane_pca{}, {}, threads{});
    return gnomon::segment_surfaces(points, surface, {}, threads{});
}

/// Which points lie within a centimetre of the best of 500 random planes.
std::vector<bool> ransac_inliers(const clouds::cloud& points) {
    gnomon::random_stream random(1);
    const auto any = [&] { return points[random.bits() % points.size()]; };
    std::vector<bool> best(points.size(), false);
    std::size_t most = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const Eigen::Vector3d a = any(), b = any(), c = any();
        const Eigen::Vector3d n = (b - a).cross(c - a).normalized();
        std::vector<bool> inlier(points.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            inlier[i] = std::abs(n.dot(points[i] - a)) <= 0.01;
            count += inlier[i];
        }
        if (count > most) most = count, best = inlier;
    }
    return best;
}

class real_scans : public testing::Test {
  protected:
    void SetUp() override {
        if (!have_scans()) GTEST_SKIP() << "needs shared data";
    }
};

/// The largest segment is the floor, the next the table top, and what stands on it is separate.
TEST_F(real_scans, lms400_table_scene_gives_floor_table_and_object) {
    const auto scan = read_scan("scans/lms400_table_scene_1cm.pcd");
    ASSERT_EQ(scan.size(), 41'049u);
    const auto parts = segment(scan.points);
    ASSERT_GE(parts.size(), 3u);

    const auto floor = ransac_inliers(scan.points);
    std::size_t inliers = 0, found = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        inliers += floor[i];
        found += floor[i] && parts.labels()[i] == 0;
    }
    EXPECT_NEAR(static_cast<double>(inliers), 20'161.0, 200.0);
    EXPECT_GE(static_cast<double>(found), 0.9 * 20'161.0);
    EXPECT_NEAR(static_cast<double>(parts[1].size()), 12'000.0, 600.0);
    std::printf("  floor %zu (of %zu inliers %zu), table top %zu, next %zu, %zu segments\n",
                parts[0].size(), inliers, found, parts[1].size(), parts[2].size(), parts.size());
}

/// Every scan runs to its end; labels and trust keep their promises; NaN stay where they are.
TEST_F(real_scans, all_kinds_of_scanners_run_to_the_end) {
    for (const char* name :
         {"scans/pcl_room_scan1.pcd", "scans/pcl_office1_kinect.pcd", "scans/box_caixa.ply",
          "scans/asl_apartment_0.vtk", "scans/pcl_table_mug_stereo.pcd"}) {
        SCOPED_TRACE(name);
        const auto scan = read_scan(name);
        auto surface = gnomon::estimate_normals(scan, knn{}, plane_pca{}, threads{});
        gnomon::repair_anisotropic(scan, surface, knn{}, plane_pca{}, {}, threads{});
        gnomon::orient_normals(scan, surface);
        const auto parts = gnomon::segment_surfaces(scan, surface, {}, threads{});
        std::size_t valid = 0;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const bool finite = gnomon::is_finite(scan.points[i]);
            valid += finite;
            ASSERT_EQ(surface[i].trust == gnomon::trust::not_finite, !finite);
            ASSERT_TRUE(finite || parts.labels()[i] == gnomon::unlabeled);
            ASSERT_NEAR(surface[i].normal.norm(), gnomon::usable(surface[i].trust), 1e-12);
        }
        EXPECT_GE(parts.size(), 1u);
        std::printf("  %s: %zu points, %zu valid, %zu segments, largest %zu\n", name, scan.size(),
                    valid, parts.size(), parts[0].size());
    }
}

/// Order, place and attitude: the same partition; for quantised depth, where ties at the k-th place
/// go by the index, a Rand index of at least 0.999.
TEST_F(real_scans, partition_survives_permutation_translation_and_rotation) {
    struct {
        const char* name;
        double least;
    } const scans[] = {{"scans/lms400_table_scene_1cm.pcd", 1.0},
                       {"segmentation_truth/synpeb_test_100.pcd", 1.0},
                       {"scans/box_caixa.ply", 0.999},
                       {"scans/pcl_office1_kinect.pcd", 0.999}};
    for (const auto& [name, least] : scans) {
        SCOPED_TRACE(name);
        const auto points = read_scan(name).points;
        const auto expected = segment(points).labels();
        std::vector<std::size_t> order;
        const auto shuffled = segment(clouds::permuted(points, 1, order)).labels();
        std::vector<std::int32_t> restored(points.size());
        for (std::size_t i = 0; i < order.size(); ++i) restored[order[i]] = shuffled[i];
        const double permuted = laws::rand_index(restored, expected);
        const double shifted = laws::rand_index(
            segment(clouds::moved(points, Eigen::Matrix3d::Identity(), {10, -20, 5})).labels(),
            expected);
        const double turned = laws::rand_index(
            segment(clouds::moved(points, clouds::random_rotation(4), {0, 0, 0})).labels(),
            expected);
        std::printf("  %s: Rand index permuted %.6f, translated %.6f, rotated %.6f\n", name, permuted,
                    shifted, turned);
        EXPECT_GE(permuted, least);
        EXPECT_GE(shifted, least);
        EXPECT_GE(turned, least);
    }
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
/// Real scans, through the whole chain. The files are not part of the repository; where they are
/// missing these tests, and no others, are passed over.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/partitions.hpp"
#include "shared_file.hpp"
#include <gnomon/io/read.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>

namespace {

using gnomon::knn, gnomon::plane_pca, gnomon::threads;

bool have_scans() { return !shared_file("MANIFEST.tsv").empty(); }

gnomon::scan read_scan(const std::string& name) { return gnomon::io::read(shared_file(name)); }

/// The chain with the thesis's parameters.
gnomon::segments segment(const clouds::cloud& points, const knn& neighbors = {}) {
    auto surface = gnomon::estimate_normals(points, neighbors, plane_pca{}, threads{});
    gnomon::repair_anisotropic(points, neighbors, surface, plane_pca{}, {}, threads{});
    return gnomon::segment_surfaces(points, surface, {}, threads{});
}

/// Which points lie within a centimetre of the best of 500 random planes.
std::vector<bool> ransac_inliers(const clouds::cloud& points) {
    gnomon::random_stream random(1);
    const auto any = [&] { return points[random.below(points.size())]; };
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

/// Unlike simulated floors, these have points below them, and are rough or seen at grazing
/// incidence.
TEST_F(real_scans, have_floors) {
    const auto height_of = [](const std::string& name, const Eigen::Vector3d& up) {
        const auto floor = gnomon::find_floor(read_scan("scans/" + name), up);
        return floor ? floor->offset : clouds::nan;
    };
    const Eigen::Vector3d z(0, 0, 1);
    EXPECT_NEAR(height_of("asl_apartment_0.vtk", z), -0.25, 0.02);
    EXPECT_NEAR(height_of("kitti_000008_front.ply", z), -1.80, 0.05);
    EXPECT_NEAR(height_of("pcl_room_scan1.pcd", z), -1.27, 0.02);
    EXPECT_NEAR(height_of("pcl_office1_kinect.pcd", {0, -1, 0}), -1.33, 0.03);
}

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
        gnomon::repair_anisotropic(scan, knn{}, surface, plane_pca{}, {}, threads{});
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

/// How alike the partition of a cloud is to that of the same cloud shuffled, shifted and turned.
struct likeness {
    double shuffled, shifted, turned;
};

likeness likeness_of_partitions(const clouds::cloud& points, const knn& neighbors,
                                std::uint64_t seed) {
    const auto expected = segment(points, neighbors).labels();
    std::vector<std::size_t> order;
    const auto shuffled = segment(clouds::permuted(points, seed, order), neighbors).labels();
    std::vector<std::int32_t> restored(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) restored[order[i]] = shuffled[i];
    const auto moved = [&](const Eigen::Matrix3d& r, const Eigen::Vector3d& t) {
        return laws::rand_index(segment(clouds::moved(points, r, t), neighbors).labels(), expected);
    };
    return {laws::rand_index(restored, expected), moved(Eigen::Matrix3d::Identity(), {10, -20, 5}),
            moved(clouds::random_rotation(seed), {0, 0, 0})};
}

/// Order, place and attitude do not matter where no ties are.
TEST_F(real_scans, partition_survives_permutation_translation_and_rotation) {
    for (const char* name :
         {"scans/lms400_table_scene_1cm.pcd", "segmentation_truth/synpeb_test_100.pcd"}) {
        SCOPED_TRACE(name);
        const auto points = read_scan(name).points;
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
            const auto [shuffled, shifted, turned] = likeness_of_partitions(points, {}, seed);
            EXPECT_EQ(shuffled, 1.0);
            EXPECT_EQ(shifted, 1.0);
            EXPECT_EQ(turned, 1.0);
        }
    }
}

/// Depth cameras quantise, and ties at the k-th place fall to one point or another. With all ties
/// taken in, the partition stays the same; by the index it only nearly does.
TEST_F(real_scans, partition_of_quantized_scans_survives_with_all_ties) {
    for (const char* name : {"scans/box_caixa.ply", "scans/pcl_office1_kinect.pcd"}) {
        SCOPED_TRACE(name);
        const auto [shuffled, shifted, turned] =
            likeness_of_partitions(read_scan(name).points, {.ties = gnomon::tie_rule::all}, 1);
        std::printf("  %s: Rand index shuffled %.6f, shifted %.6f, turned %.6f\n", name, shuffled,
                    shifted, turned);
        EXPECT_GE(shuffled, 0.999);
        EXPECT_GE(shifted, 0.999);
        EXPECT_GE(turned, 0.999);
    }
    const auto by_index = likeness_of_partitions(read_scan("scans/box_caixa.ply").points, {}, 1);
    std::printf("  with ties by index, box_caixa: shuffled %.6f, shifted %.6f, turned %.6f\n",
                by_index.shuffled, by_index.shifted, by_index.turned);
}

}  // namespace

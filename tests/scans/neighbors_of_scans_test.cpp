// SPDX-License-Identifier: BSL-1.0
/// The two ways of finding neighbors, and the normals that follow, on whole scans. Where the files
/// of real ones are missing, only simulated ones are tried. Compiled once more for each set of
/// instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include "oracles/nanoflann_index.hpp"
#include "shared_file.hpp"
#include <gnomon/io/read.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::knn, gnomon::plane_pca, gnomon::threads;

/// Quantized scans have many ties: with 8 and with 50 neighbors the canonical ones are found.
void expect_both_ways_agree(const gnomon::scan& scan) {
    for (const std::size_t k : {8u, 50u}) {
        const auto found = knn{.k = k}(scan, threads{});
        const auto expected = oracles::knn_graph(scan, k);
        ASSERT_EQ(found, expected);
        const auto swept = gnomon::estimate_normals(scan, knn{.k = k}, plane_pca{}, threads{});
        const auto stored = gnomon::estimate_normals(scan, expected, plane_pca{}, threads{});
        for (std::size_t i = 0; i < scan.size(); ++i) {
            const Eigen::Vector3d lambda = stored[i].spectrum.lambda;
            const double gap = (lambda[1] - lambda[2]) / lambda[0];
            ASSERT_EQ(swept[i].trust, stored[i].trust) << i;
            ASSERT_TRUE(!gnomon::usable(swept[i].trust) ||
                        laws::angle_between(swept[i].normal, stored[i].normal) <=
                            oracles::allowed(gap))
                << i;
        }
    }
}

TEST(neighbors_of_scans, of_a_simulated_kitchen) {
    const sim::scene kitchen = sim::scenes::kitchen();
    expect_both_ways_agree(
        sim::simulate(kitchen, sim::rotational{.mount = kitchen.sensor}, sim::densities::high())
            .scan);
}

TEST(neighbors_of_scans, of_a_million_points_with_gaps) {
    auto points = clouds::in_cube(1'000'000, 1);
    for (std::size_t i = 0; i < points.size(); i += 13) points[i][i % 3] = clouds::nan;
    const auto expected = oracles::knn_graph(points, 20);
    ASSERT_EQ(knn{.k = 20}(points, threads{}), expected);
}

TEST(neighbors_of_scans, of_all_kinds_of_scanners) {
    for (const char* name : {"lms400_table_scene_1cm.pcd", "pcl_room_scan1.pcd", "box_caixa.ply",
                             "pcl_office1_kinect.pcd", "pcl_table_mug_stereo.pcd"}) {
        SCOPED_TRACE(name);
        const std::string path = shared_file(std::string("scans/") + name);
        if (path.empty()) GTEST_SKIP() << "needs shared data";
        expect_both_ways_agree(gnomon::io::read(path));
    }
}

}  // namespace

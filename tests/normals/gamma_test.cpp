// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/gamma.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/simulation/box_and_cylinder.hpp>

namespace {

TEST(gamma, is_the_cosine_whatever_the_sign) {
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    EXPECT_DOUBLE_EQ(gnomon::gamma(z, -z), 1.0);
    EXPECT_DOUBLE_EQ(gnomon::gamma(z, Eigen::Vector3d::UnitX()), 0.0);
    EXPECT_DOUBLE_EQ(gnomon::gamma({0, 0.6, -0.8}, z), 0.8);
}

TEST(gamma, counts_a_missing_normal_as_nothing) {
    std::vector<gnomon::normal_fit> surface(2);
    surface[0].normal = {0, 0, 1};
    const std::vector<Eigen::Vector3d> truth(2, Eigen::Vector3d::UnitZ());
    EXPECT_DOUBLE_EQ(gnomon::mean_gamma(surface, truth), 0.5);
    surface.clear();
    EXPECT_THROW((void)gnomon::mean_gamma(surface, truth), std::invalid_argument);
    EXPECT_TRUE(std::isnan(gnomon::mean_gamma(surface, std::vector<Eigen::Vector3d>())));
}

/// Scenario I, Fig. 3.5(a): at sigma = 15 mm the quality of plane_pca grows with k from 10 to 50.
TEST(gamma, grows_with_k_on_scenario_1_for_every_seed_and_scale) {
    for (const double scale : {0.85, 1.0, 1.15}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const auto truth = gnomon::simulation::simulate(
                gnomon::simulation::box_and_cylinder{.sigma = 0.015, .scale = scale, .seed = seed});
            double last = 0.0;
            for (std::size_t k = 10; k <= 50; k += 5) {
                const double quality = gnomon::mean_gamma(
                    gnomon::estimate_normals(truth.scan, gnomon::knn{k}, gnomon::plane_pca{},
                                             gnomon::threads{}),
                    truth.normals);
                EXPECT_GT(quality, last) << "scale " << scale << " seed " << seed << " k " << k;
                last = quality;
                if (k % 20 == 10) {
                    RecordProperty("gamma_scale_" + std::to_string(scale) + "_seed_" +
                                       std::to_string(seed) + "_k_" + std::to_string(k),
                                   std::to_string(quality));
                }
            }
        }
    }
}

}  // namespace

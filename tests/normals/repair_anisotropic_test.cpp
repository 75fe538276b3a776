// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/gamma.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>

namespace {

using gnomon::knn, gnomon::plane_pca, gnomon::threads;

/// A floor seen in scan lines: 2 mm from point to point, `gap` from line to line.
clouds::cloud scan_lines(double gap, double sigma = 0.001) {
    gnomon::random_stream random(1);
    clouds::cloud points;
    for (int line = 0; line < 40; ++line) {
        for (int i = 0; i < 100; ++i)
            points.push_back({0.002 * i, gap * line, sigma * random.gaussian()});
    }
    return points;
}

TEST(anisotropy, repair_reaches_the_next_scan_line) {
    const auto points = scan_lines(0.035);
    const std::vector<Eigen::Vector3d> truth(points.size(), Eigen::Vector3d::UnitZ());
    const knn policy{.k = 30};
    auto surface = gnomon::estimate_normals(points, policy, plane_pca{});
    const auto before = surface;
    const std::size_t flagged = gnomon::repair_anisotropic(points, policy, surface, plane_pca{});
    EXPECT_GT(flagged, points.size() / 2);
    EXPECT_LT(gnomon::mean_gamma(before, truth), 0.8);
    EXPECT_GT(gnomon::mean_gamma(surface, truth), gnomon::mean_gamma(before, truth) + 0.15);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool was_anisotropic = before[i].aspect_ratio() < 0.1;
        changed += was_anisotropic;
        EXPECT_EQ(surface[i].neighbors, was_anisotropic ? 60u : 30u);
        // The mean distance is renewed with the normal, which Eq. (4.3) relies on.
        if (was_anisotropic)
            EXPECT_GT(surface[i].mean_distance, before[i].mean_distance);
        else
            EXPECT_EQ(surface[i].normal, before[i].normal);
    }
    EXPECT_EQ(changed, flagged);
}

TEST(anisotropy, applies_the_given_number_of_doublings_and_leaves_the_rest_weak) {
    const auto points = scan_lines(0.2, 0.0001);
    const knn policy{.k = 10};
    auto once = gnomon::estimate_normals(points, policy, plane_pca{});
    auto thrice = once;
    gnomon::repair_anisotropic(points, policy, once, plane_pca{});
    gnomon::repair_anisotropic(points, policy, thrice, plane_pca{}, {.doublings = 3}, threads{2});
    EXPECT_EQ(once[2050].neighbors, 20u);
    EXPECT_EQ(once[2050].trust, gnomon::trust::weak);
    EXPECT_EQ(thrice[2050].neighbors, 80u);
}

TEST(anisotropy, repair_is_the_same_on_any_number_of_threads) {
    const auto points = scan_lines(0.035);
    const knn policy{.k = 30};
    auto one = gnomon::estimate_normals(points, policy, plane_pca{});
    auto four = one;
    gnomon::repair_anisotropic(points, policy, one, plane_pca{});
    gnomon::repair_anisotropic(points, policy, four, plane_pca{}, {}, threads{4});
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(one[i].normal, four[i].normal);
}

TEST(anisotropy, doubles_even_the_largest_k) {
    const auto points = clouds::sheet(50, 1);
    const knn policy{.k = ~std::size_t{0} / 2 + 1};
    auto surface = gnomon::estimate_normals(points, policy, plane_pca{});
    gnomon::repair_anisotropic(points, policy, surface, plane_pca{},
                               {.min_aspect_ratio = 1.0, .doublings = 3});
    EXPECT_EQ(surface[0].neighbors, 49u);
}

TEST(anisotropy, refuses_bad_options) {
    const auto points = clouds::sheet(50, 1);
    auto surface = gnomon::estimate_normals(points, knn{5}, plane_pca{});
    for (const gnomon::repair_anisotropic_options& bad :
         {gnomon::repair_anisotropic_options{.min_aspect_ratio = NAN},
          gnomon::repair_anisotropic_options{.min_aspect_ratio = -0.1},
          gnomon::repair_anisotropic_options{.doublings = -1}})
        EXPECT_THROW(gnomon::repair_anisotropic(points, knn{5}, surface, plane_pca{}, bad),
                     std::invalid_argument);
}

TEST(anisotropy, refuses_k_zero) {
    const auto points = clouds::sheet(50, 1);
    auto surface = gnomon::estimate_normals(points, knn{5}, plane_pca{});
    EXPECT_THROW(gnomon::repair_anisotropic(points, knn{0}, surface, plane_pca{}),
                 std::invalid_argument);
}

TEST(anisotropy, survives_every_cloud_and_refuses_a_foreign_surface) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        auto surface = gnomon::estimate_normals(points, knn{5}, plane_pca{});
        gnomon::repair_anisotropic(points, knn{5}, surface, plane_pca{}, {.doublings = 3});
        for (const auto& s : surface) ASSERT_TRUE(s.normal.allFinite());
    }
    auto surface = gnomon::estimate_normals(clouds::sheet(10, 1), knn{5}, plane_pca{});
    EXPECT_THROW(gnomon::repair_anisotropic(clouds::sheet(9, 1), knn{5}, surface, plane_pca{}),
                 std::invalid_argument);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/ray_knn.hpp>
#include <gnomon/normals/normal_quality.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/robust_ray_ls.hpp>
#include <gnomon/normals/wanted_precision.hpp>
#include <gnomon/normals/with_covariance.hpp>

namespace {

using gnomon::constant_noise, gnomon::degrees, gnomon::ray_knn, gnomon::robust_ray_ls,
    gnomon::trust, gnomon::wanted_precision;

constexpr double wall_sigma = 0.01;
const Eigen::Vector3d wall_viewpoint(0.0, 0.0, 0.0);

/// Two walls that meet at an edge 4 m before the wall_viewpoint, with noise along the rays.
clouds::cloud walls() {
    gnomon::random_stream random(1);
    clouds::cloud points;
    for (int row = 0; row < 40; ++row)
        for (int column = -60; column < 60; ++column) {
            const Eigen::Vector3d u =
                Eigen::Vector3d(1.0, 0.004 * column + 0.002, 0.004 * row).normalized();
            const double side = column < 0 ? -1.0 : 1.0;  // the planes x + 2 side y = 4
            points.push_back((4.0 / (u.x() + side * 0.7 * u.y()) + wall_sigma * random.gaussian()) *
                             u);
        }
    return points;
}

const ray_knn first_neighborhood{.k = 16, .noise = constant_noise{wall_sigma}};
const robust_ray_ls robust_estimator{.noise = constant_noise{wall_sigma}};

/// Each point has the first k that is precise enough, or the best one until then.
TEST(wanted_precision, grows_neighborhoods_by_doublings) {
    const auto points = walls();
    const auto seen = gnomon::with_viewpoint(points, wall_viewpoint);
    const wanted_precision wanted{degrees(3.0), 128};
    const double most = wanted.deviation.radians() * wanted.deviation.radians();
    const auto grown = gnomon::estimate_normals(seen, first_neighborhood, robust_estimator, wanted);
    ASSERT_EQ(grown.size(), points.size());
    std::vector<std::vector<gnomon::surfel<gnomon::estimate_t<robust_ray_ls>>>> of_k;
    for (std::size_t k = 16; k <= 128; k *= 2) {
        ray_knn wider = first_neighborhood;
        wider.k = k;
        of_k.push_back(gnomon::estimate_normals(seen, wider(seen), robust_estimator));
    }
    const auto is_precise = [most](const auto& s) {
        return s.trust == trust::good && s.trace() <= most;
    };
    std::size_t grew = 0, precise = 0, at_first = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t r = 0;
        while (r < of_k.size() && of_k[r][i].normal != grown[i].normal) ++r;
        ASSERT_LT(r, of_k.size()) << "the normal of no k";
        for (std::size_t smaller = 0; smaller < r; ++smaller)
            EXPECT_FALSE(is_precise(of_k[smaller][i])) << "fewer would do";
        if (r + 1 < of_k.size() && !is_precise(grown[i]) && of_k[r + 1][i].trust == trust::good) {
            EXPECT_EQ(grown[i].trust, trust::good);
            EXPECT_LE(grown[i].trace(), of_k[r + 1][i].trace()) << "more would be better";
        }
        grew += r > 0 ? 1 : 0;
        precise += is_precise(grown[i]) ? 1 : 0;
        at_first += is_precise(of_k[0][i]) ? 1 : 0;
    }
    EXPECT_GT(grew, points.size() / 2);
    EXPECT_GT(precise, points.size() * 95 / 100);
    EXPECT_LT(at_first, points.size() / 2);
}

TEST(wanted_precision, is_the_same_on_every_execution) {
    const auto points = walls();
    const auto seen = gnomon::with_viewpoint(points, wall_viewpoint);
    const wanted_precision wanted{degrees(2.0), 64};
    const auto expected =
        gnomon::estimate_normals(seen, first_neighborhood, robust_estimator, wanted);
    const auto found = gnomon::estimate_normals(seen, first_neighborhood, robust_estimator, wanted,
                                                gnomon::threads{4});
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(found[i].normal, expected[i].normal);
        ASSERT_EQ(found[i].neighbors, expected[i].neighbors);
    }
}

/// A precision that every normal has, and one that none has; few points, and points that are not
/// finite.
TEST(wanted_precision, ends_with_any_points) {
    const gnomon::with_covariance<gnomon::plane_pca> pca{.noise = constant_noise{wall_sigma}};
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        for (const double wanted : {1e-9, 1.0, 90.0}) {
            const auto surface = gnomon::estimate_normals(points, gnomon::knn{.k = 3}, pca,
                                                          wanted_precision{degrees(wanted)});
            ASSERT_EQ(surface.size(), points.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (!gnomon::is_finite(points[i])) {
                    EXPECT_EQ(surface[i].trust, trust::not_finite);
                } else if (gnomon::usable(surface[i].trust)) {
                    EXPECT_NEAR(surface[i].normal.norm(), 1.0, 1e-12);
                }
            }
        }
    }
}

TEST(wanted_precision, refuses_angles_that_are_not_positive) {
    const auto points = clouds::sheet(100, 1);
    for (const double wanted : {0.0, -1.0, clouds::nan})
        EXPECT_THROW(
            (void)gnomon::estimate_normals(points, gnomon::knn{.k = 8}, gnomon::plane_eif{},
                                           wanted_precision{degrees(wanted)}),
            std::invalid_argument);
}

}  // namespace

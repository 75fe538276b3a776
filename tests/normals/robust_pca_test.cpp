// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/outliers.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/robust_pca.hpp>

namespace {

using gnomon::plane_pca, gnomon::robust_pca, gnomon::trust;

TEST(robust_pca, turns_away_from_outliers) {
    EXPECT_GT(outliers::mean_gamma_with(robust_pca{}, 0.3),
              outliers::mean_gamma_with(plane_pca{}, 0.3) + 0.03);
}

/// On planes with noise and without outliers, it loses less than 2e-4 of gamma.
TEST(robust_pca, keeps_the_points_of_a_plane_with_noise) {
    EXPECT_GT(outliers::mean_gamma_with(robust_pca{}, 0.0),
              outliers::mean_gamma_with(plane_pca{}, 0.0) - 2e-4);
}

TEST(robust_pca, laws_hold) { laws::estimator_laws(robust_pca{}); }

TEST(robust_pca, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 0);
    EXPECT_EQ(robust_pca{}(p, clouds::cloud{{1, 0, 0}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(robust_pca{}(p, clouds::cloud(5, p)).trust, trust::degenerate);
    EXPECT_EQ(robust_pca{}(p, clouds::cloud{{1, 0, 0}, {0, 1, 0}}).trust, trust::good);
    for (const double cutoff : {0.0, -2.0, clouds::nan})
        EXPECT_THROW((void)(robust_pca{.cutoff = cutoff}(p, clouds::cloud(5, p))),
                     std::invalid_argument);
}

}  // namespace

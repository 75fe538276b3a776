// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/vector_svd.hpp>

namespace {

using gnomon::vector_svd, gnomon::trust;

/// q_ij - p_i, k x 3. Eq. (3.6) and Tab. 3.1.
TEST(vector_svd, agrees_with_a_dense_svd) {
    oracles::expect_agrees_with(vector_svd{}, [](const laws::neighborhood_sample& sample) {
        return oracles::last_singular_vector(
            oracles::rows_of(sample, false, 3, [&](const oracles::vector3& q) -> oracles::vector {
                return q - sample.p.cast<long double>();
            }));
    });
}

/// Where the point is the centroid of its neighbors, it is PlanePCA.
TEST(vector_svd, is_plane_pca_about_the_centroid) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto s = laws::sample_neighborhood(seed);
        Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
        for (const auto& q : s.neighbors) centroid += q / static_cast<double>(s.neighbors.size());
        EXPECT_LT(laws::angle_between(vector_svd{}(centroid, s.neighbors).normal,
                                      gnomon::plane_pca{}(centroid, s.neighbors).normal),
                  1e-12);
    }
}

TEST(vector_svd, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 1);
    EXPECT_EQ(vector_svd{}(p, clouds::cloud{{1, 0, 1}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(vector_svd{}(p, clouds::cloud{{1, 0, 1}, {0, 1, 1}}).trust, trust::good);
    EXPECT_EQ(vector_svd{}(p, clouds::cloud{{1, 0, 1}, {2, 0, 1}}).trust, trust::degenerate);
    EXPECT_EQ(vector_svd{}(p, clouds::cloud{{1, 0, 1}, {0, 0.05, 1}}).trust, trust::weak);
}

TEST(vector_svd, laws_hold) { laws::estimator_laws(vector_svd{}); }

}  // namespace

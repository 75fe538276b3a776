// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/vector_pca.hpp>

namespace {

using gnomon::vector_pca, gnomon::trust;

/// The neighbors less their mean, k x 3. Sec. 3.2.3.
TEST(vector_pca, agrees_with_a_dense_svd) {
    oracles::expect_agrees_with(vector_pca{}, [](const laws::neighborhood_sample& sample) {
        oracles::matrix m = oracles::rows_of(
            sample, false, 3, [](const oracles::vector3& q) -> oracles::vector { return q; });
        m.rowwise() -= m.colwise().mean().eval();
        return oracles::last_singular_vector(m);
    });
}

/// The result does not depend on the point itself, unlike that of PlanePCA.
TEST(vector_pca, does_not_use_the_point) {
    const auto s = laws::sample_neighborhood(1);
    const Eigen::Vector3d elsewhere = s.p + Eigen::Vector3d(0.1, 0.2, 0.3);
    EXPECT_LT(laws::angle_between(vector_pca{}(s.p, s.neighbors).normal,
                                  vector_pca{}(elsewhere, s.neighbors).normal),
              1e-13);
    EXPECT_GT(laws::angle_between(gnomon::plane_pca{}(s.p, s.neighbors).normal,
                                  gnomon::plane_pca{}(elsewhere, s.neighbors).normal),
              1e-3);
}

TEST(vector_pca, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 5);
    EXPECT_EQ(vector_pca{}(p, clouds::cloud{{1, 0, 1}, {0, 1, 1}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(vector_pca{}(p, clouds::cloud{{1, 0, 1}, {0, 1, 1}, {0, 0, 1}}).trust, trust::good);
    EXPECT_EQ(vector_pca{}(p, clouds::cloud{{1, 0, 1}, {2, 0, 1}, {3, 0, 1}}).trust,
              trust::degenerate);
}

TEST(vector_pca, laws_hold) { laws::estimator_laws(vector_pca{}); }

}  // namespace

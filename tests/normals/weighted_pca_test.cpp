// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/weighted_pca.hpp>

namespace {

using gnomon::plane_pca, gnomon::weighted_pca, gnomon::trust;

/// Oracle: rows scaled by the roots of their weights about the weighted mean, by a dense SVD.
TEST(weighted_pca, agrees_with_a_dense_svd) {
    oracles::expect_agrees_with(weighted_pca{.bandwidth = 0.4}, [](const auto& sample) {
        oracles::matrix m = oracles::rows_of(
            sample, true, 3, [](const oracles::vector3& q) -> oracles::vector { return q; });
        const oracles::vector distance2 = (m.rowwise() - m.row(0)).rowwise().squaredNorm();
        const long double h2 = 0.16L * distance2.maxCoeff();
        const oracles::vector w = (-0.5L / h2 * distance2.array()).exp();
        const oracles::vector3 mean = m.transpose() * w / w.sum();
        m.rowwise() -= mean.transpose();
        return oracles::last_singular_vector(w.array().sqrt().matrix().asDiagonal() * m);
    });
}

/// A wide band weighs all alike.
TEST(weighted_pca, of_infinite_bandwidth_is_plane_pca) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto s = laws::sample_neighborhood(seed);
        EXPECT_LT(laws::angle_between(weighted_pca{.bandwidth = 1e9}(s.p, s.neighbors).normal,
                                      plane_pca{}(s.p, s.neighbors).normal),
                  1e-12);
    }
}

TEST(weighted_pca, laws_hold) { laws::estimator_laws(weighted_pca{}); }

TEST(weighted_pca, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 0);
    EXPECT_EQ(weighted_pca{}(p, clouds::cloud{{1, 0, 0}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(weighted_pca{}(p, clouds::cloud(5, p)).trust, trust::degenerate);
    for (const double h : {0.0, -1.0, clouds::nan})
        EXPECT_THROW((void)(weighted_pca{.bandwidth = h}(p, clouds::cloud(5, p))),
                     std::invalid_argument);
}

}  // namespace

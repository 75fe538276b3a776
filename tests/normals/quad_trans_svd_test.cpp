// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/quad_trans_svd.hpp>

namespace {

using gnomon::quad_trans_svd, gnomon::trust;

/// [R' 1] of k x 6 in the frame of VectorSVD, and c by its truncated pseudo-inverse. Eq. (3.8).
oracles::answer literal_quad_trans_svd(const laws::neighborhood_sample& sample, int rank) {
    const oracles::vector3 p = sample.p.cast<long double>();
    const oracles::matrix vectors = oracles::rows_of(
        sample, false, 3, [&](const oracles::vector3& q) -> oracles::vector { return q - p; });
    const Eigen::JacobiSVD<oracles::matrix> frame(vectors, Eigen::ComputeFullV);
    const oracles::matrix v = frame.matrixV();
    const oracles::matrix local = vectors * v;
    oracles::matrix r(local.rows(), 6);
    for (Eigen::Index i = 0; i < local.rows(); ++i) {
        const long double x = local(i, 0);
        const long double y = local(i, 1);
        r.row(i) << x * x, y * y, x * y, x, y, 1.0L;
    }
    const Eigen::JacobiSVD<oracles::matrix> svd(r, Eigen::ComputeThinU | Eigen::ComputeFullV);
    const auto& s = svd.singularValues();
    oracles::vector c = oracles::vector::Zero(6);
    for (int j = 0; j < rank && s[j] > 1e-12L * s[0]; ++j)
        c += svd.matrixU().col(j).dot(local.col(2)) / s[j] * svd.matrixV().col(j);
    const oracles::vector3 n =
        v.leftCols(3) * oracles::vector3(-c[3], -c[4], 1.0L);  // [1 0 c4] x [0 1 c5]
    const auto& f = frame.singularValues();
    // The smaller of two gaps: of the frame, and between kept and other singular values.
    long double gap = (f[1] * f[1] - f[2] * f[2]) / (f[0] * f[0]);
    gap = std::min(gap, (f[0] * f[0] - f[1] * f[1]) / (f[0] * f[0]));
    if (rank < 6) gap = std::min(gap, (s[rank - 1] - s[rank]) / s[0]);
    gap = std::min(gap, s[rank - 1] / s[0]);
    return {n.normalized().cast<double>(), static_cast<double>(gap)};
}

TEST(quad_trans_svd, agrees_with_a_dense_svd) {
    for (const int rank : {3, 6}) {
        int compared = 0;
        for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
            const auto sample = oracles::neighborhood_of_few_digits(seed);
            if (sample.neighbors.size() < 6) continue;
            const auto found = laws::estimate_one(quad_trans_svd{.rank = rank}, sample);
            const auto expected = literal_quad_trans_svd(sample, rank);
            if (!gnomon::usable(found.trust)) {
                ASSERT_LT(expected.gap, 2e-12) << "seed " << seed;
                continue;
            }
            if (expected.gap < 1e-11) continue;
            ++compared;
            ASSERT_LE(laws::angle_between(found.normal, expected.normal),
                      oracles::allowed(expected.gap))
                << "seed " << seed << " rank " << rank << " gap " << expected.gap;
        }
        EXPECT_GT(compared, rank == 3 ? 8000 : 4000);
    }
}

/// A paraboloid without noise: the full rank is exact, up to the turn of the frame; three are not.
TEST(quad_trans_svd, full_rank_is_exact_on_a_paraboloid) {
    gnomon::random_stream random(1);
    clouds::cloud neighbors;
    for (int i = 0; i < 30; ++i) {
        const double x = random.uniform(-0.3, 0.5);
        const double y = random.uniform(-0.3, 0.3);
        neighbors.push_back({x, y, x * x + 0.5 * y * y});
    }
    const auto off = [&](const auto& estimate) {
        return laws::angle_between(estimate({0, 0, 0}, neighbors).normal, Eigen::Vector3d::UnitZ());
    };
    EXPECT_LT(off(quad_trans_svd{.rank = 6}), 0.2 * off(quad_trans_svd{.rank = 3}));
}

TEST(quad_trans_svd, laws_hold) {
    laws::normals_are_unit_or_zero(quad_trans_svd{});
    laws::normal_follows_the_cloud(quad_trans_svd{}, 1e-10);
    laws::result_does_not_depend_on_execution(quad_trans_svd{});
}

TEST(quad_trans_svd, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 1);
    EXPECT_EQ(quad_trans_svd{}(p, clouds::cloud(4, p)).trust, trust::too_few_neighbors);
    EXPECT_EQ(quad_trans_svd{}(p, clouds::cloud(9, p)).trust, trust::degenerate);
    EXPECT_THROW((void)(quad_trans_svd{.rank = 7}(p, clouds::cloud(9, p))), std::invalid_argument);
    EXPECT_THROW((void)(quad_trans_svd{.rank = 0}(p, clouds::cloud(9, p))), std::invalid_argument);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/detail/symmetric_eigen.hpp>

namespace {

/// The law: V is orthonormal, A V = V diag(values), values descend.
void expect_decomposes(const Eigen::Matrix3d& a) {
    const auto e = gnomon::detail::symmetric_eigen(a);
    const double scale = std::max(a.cwiseAbs().maxCoeff(), 1e-300);
    ASSERT_TRUE(e.values.allFinite() && e.vectors.allFinite());
    EXPECT_GE(e.values[0], e.values[1]);
    EXPECT_GE(e.values[1], e.values[2]);
    EXPECT_LT((e.vectors.transpose() * e.vectors - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    const Eigen::Matrix3d residual =
        (a / scale) * e.vectors - e.vectors * (e.values / scale).asDiagonal();
    EXPECT_LT(residual.norm(), 3e-15) << a;
}

Eigen::Matrix3d with_spectrum(const Eigen::Vector3d& values, std::uint64_t seed) {
    const Eigen::Matrix3d r = clouds::random_rotation(seed);
    const Eigen::Matrix3d a = r * values.asDiagonal() * r.transpose();
    return 0.5 * (a + a.transpose());
}

TEST(symmetric_eigen, decomposes_every_rank_and_multiplicity_at_every_scale) {
    const std::vector<Eigen::Vector3d> spectra = {{3, 2, 1},
                                                  {1, 1, 1},
                                                  {1, 1, 0},
                                                  {1, 0, 0},
                                                  {0, 0, 0},
                                                  {1, 1, 1e-9},
                                                  {1, 1e-9, 1e-9},
                                                  {1, 1 - 1e-12, 1e-6},
                                                  {1, 1e-8, 0},
                                                  {1, 1e-15, 1e-30},
                                                  {1, 0.5, 0.5 - 1e-14},
                                                  {1, -1, 0},
                                                  {-1, -2, -3},
                                                  {1, 1e-3, 1e-3 * (1 - 1e-13)}};
    for (const double scale : {1e-290, 1e-12, 1.0, 1e12, 1e290}) {
        for (const auto& s : spectra) {
            for (std::uint64_t seed = 0; seed < 20; ++seed) {
                expect_decomposes(with_spectrum(scale * s, seed));
            }
            expect_decomposes((scale * s).asDiagonal());
        }
    }
}

TEST(symmetric_eigen, agrees_with_eigen_s_iterative_solver) {
    gnomon::random_stream random(3);
    for (int trial = 0; trial < 10'000; ++trial) {
        Eigen::Matrix3d a;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j <= i; ++j) a(i, j) = a(j, i) = random.gaussian();
        }
        const auto e = gnomon::detail::symmetric_eigen(a);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> oracle(a);
        ASSERT_LT((e.values - oracle.eigenvalues().reverse()).norm(), 1e-14 * a.norm());
        for (int i = 0; i < 3; ++i) {
            const double gap = std::min(i > 0 ? e.values[i - 1] - e.values[i] : 1e9,
                                        i < 2 ? e.values[i] - e.values[i + 1] : 1e9);
            if (gap < 1e-3) continue;
            ASSERT_NEAR(std::abs(e.vectors.col(i).dot(oracle.eigenvectors().col(2 - i))), 1.0,
                        1e-12);
        }
    }
}

TEST(symmetric_eigen, of_subnormal_entries_is_zero_and_not_nan) {
    expect_decomposes(Eigen::Matrix3d::Constant(1e-320));
}

}  // namespace

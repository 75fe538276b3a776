// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_pca.hpp>

namespace {

/// Oracle: the last right singular vector of the centered (k+1) x 3 matrix Q+ of Eq. (3.2), by a
/// dense SVD in long double.
struct dense_svd {
    Eigen::Vector3d normal;
    Eigen::Vector3d singular_values;

    dense_svd(const Eigen::Vector3d& p, const clouds::cloud& neighbors) {
        using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
        matrix q(static_cast<Eigen::Index>(neighbors.size()) + 1, 3);
        q.row(0) = p.transpose().cast<long double>();
        for (std::size_t j = 0; j < neighbors.size(); ++j) {
            q.row(static_cast<Eigen::Index>(j) + 1) = neighbors[j].transpose().cast<long double>();
        }
        q.rowwise() -= q.colwise().mean().eval();
        const Eigen::JacobiSVD<matrix> svd(q, Eigen::ComputeThinU | Eigen::ComputeThinV);
        normal = svd.matrixV().col(2).cast<double>();
        singular_values = svd.singularValues().cast<double>();
    }
};

/// At most 1e-12 rad where the relative gap is at least 1e-2, at most 1e-14 / gap below.
void expect_agrees_with_dense_svd(const Eigen::Vector3d& place) {
    int wide_gaps = 0;
    for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
        const auto [p, neighbors, viewpoint] = oracles::random_neighborhood(seed, place);
        const gnomon::plane_fit fit = gnomon::plane_pca{}(p, neighbors);
        const dense_svd oracle(p, neighbors);
        const Eigen::Vector3d lambda =
            oracle.singular_values.array().square() / static_cast<double>(neighbors.size() + 1);
        const double gap = (lambda[1] - lambda[2]) / lambda[0];
        if (fit.trust == gnomon::trust::degenerate) {
            ASSERT_LT(gap, 2e-12);
            continue;
        }
        wide_gaps += gap >= 1e-2;
        ASSERT_LE(laws::angle_between(fit.normal, oracle.normal), oracles::allowed(gap))
            << "seed " << seed << " gap " << gap;
        ASSERT_LT((fit.spectrum.lambda - lambda).norm(), 1e-14 * lambda[0]);
    }
    EXPECT_GT(wide_gaps, 1000);  // both branches were tried
    EXPECT_LT(wide_gaps, 9000);
}

TEST(plane_pca, agrees_with_a_dense_svd_at_the_origin) { expect_agrees_with_dense_svd({0, 0, 0}); }

TEST(plane_pca, agrees_with_a_dense_svd_at_utm_coordinates) {
    expect_agrees_with_dense_svd({6e5, 4.8e6, 100});
}

TEST(plane_pca, reports_degenerate_neighborhoods) {
    using gnomon::trust;
    const gnomon::plane_pca fit;
    const Eigen::Vector3d p(0, 0, 0);
    EXPECT_EQ(fit(p, clouds::cloud{}).trust, trust::too_few_neighbors);
    EXPECT_EQ(fit(p, clouds::cloud{{1, 0, 0}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(fit(p, clouds::cloud{{1, 0, 0}, {0, 1, 0}}).trust, trust::good);
    EXPECT_EQ(fit(p, clouds::cloud{{1, 0, 0}, {2, 0, 0}, {-5, 0, 0}}).trust, trust::degenerate);
    EXPECT_EQ(fit(p, clouds::cloud(5, p)).trust, trust::degenerate);
    EXPECT_EQ(
        fit(p, clouds::cloud{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
            .trust,
        trust::degenerate);  // a ball
    EXPECT_EQ(fit(p, clouds::cloud{{1, 0, 0}, {-1, 0, 0}, {0, 0.05, 0}, {0, -0.05, 0}}).trust,
              trust::weak);  // nearly one scan line
    EXPECT_EQ(fit(p, clouds::cloud{{1, 0, 0}, {0, clouds::nan, 0}, {0, 0, 1}}).trust,
              trust::not_finite);
}

TEST(plane_pca, of_a_perfect_plane_is_perfect) {
    clouds::cloud neighbors;
    for (int i = 0; i < 20; ++i) neighbors.push_back({0.1 * (i % 5), 0.1 * (i / 5), 0.0});
    const auto fit = gnomon::plane_pca{}({0.2, 0.2, 0.0}, neighbors);
    EXPECT_EQ(laws::angle_between(fit.normal, Eigen::Vector3d::UnitZ()), 0.0);
    EXPECT_EQ(fit.surface_variation(), 0.0);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "normals/dense_oracles.hpp"
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/plane_svd.hpp>

namespace {

using gnomon::plane_svd, gnomon::trust;

/// [Q+ 1] in the sensor's frame, (k+1) x 4. Eq. (3.1) and Tab. 3.1.
oracles::answer literal_plane_svd(const laws::neighborhood_sample& sample) {
    return oracles::last_singular_vector(
        oracles::rows_of(sample, true, 4, [&](const oracles::vector3& q) {
            oracles::vector row(4);
            row << q - sample.viewpoint.cast<long double>(), 1.0L;
            return row;
        }));
}

TEST(plane_svd, agrees_with_a_dense_svd) {
    oracles::expect_agrees_with(plane_svd{}, literal_plane_svd);
}

TEST(plane_svd, laws_hold) {
    laws::estimator_laws(plane_svd{});
    laws::estimator_laws(plane_svd{.centred = true});
}

TEST(plane_svd, centred_is_plane_pca) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto s = laws::sample_neighborhood(seed);
        EXPECT_EQ(plane_svd{.centred = true}(s.p, s.neighbors).normal,
                  gnomon::plane_pca{}(s.p, s.neighbors).normal);
    }
}

/// The unit 4-vector biases the normal towards the ray: a ball of points, which does not determine
/// a normal, has the ray as normal.
TEST(plane_svd, is_biased_towards_the_ray) {
    gnomon::random_stream random(5);
    clouds::cloud ball;
    for (int i = 0; i < 400; ++i)
        ball.push_back(Eigen::Vector3d(4, 0, 0) + 0.05 * clouds::gaussian_vector(random));
    const auto fit = plane_svd{}({4, 0, 0}, ball);
    EXPECT_LT(laws::angle_between(fit.normal, {1, 0, 0}), 0.05);
}

TEST(plane_svd, reports_degenerate_neighborhoods) {
    const Eigen::Vector3d p(0, 0, 1);
    EXPECT_EQ(plane_svd{}(p, clouds::cloud{{1, 0, 1}}).trust, trust::too_few_neighbors);
    EXPECT_EQ(plane_svd{}(p, clouds::cloud{{1, 0, 1}, {0, 1, 1}}).trust, trust::good);
    EXPECT_EQ(plane_svd{}(p, clouds::cloud{{1, 0, 1}, {2, 0, 1}}).trust, trust::degenerate);
    EXPECT_EQ(plane_svd{}(p, clouds::cloud{{1, 0, 1}, {clouds::nan, 1, 1}}).trust,
              trust::not_finite);
}

}  // namespace

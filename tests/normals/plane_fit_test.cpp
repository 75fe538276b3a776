// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/normals/plane_fit.hpp>

namespace {

using gnomon::trust;

/// Second moments that are known: the normal, the spectrum and the trust follow.
TEST(plane_fit, of_known_second_moments) {
    const auto fit = [](double x, double y, double z) {
        Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
        m.diagonal() << x, y, z;
        return gnomon::detail::plane_of_least_spread(m, 0.1);
    };
    const auto plane = fit(4.0, 1.0, 0.25);
    EXPECT_EQ(plane.trust, trust::good);
    EXPECT_EQ(plane.normal.cwiseAbs(), Eigen::Vector3d::UnitZ());
    EXPECT_EQ(plane.aspect_ratio(), 0.5);
    EXPECT_DOUBLE_EQ(plane.surface_variation(), 3.0 * 0.5 / 3.5);
    EXPECT_EQ(fit(1.0, 0.009, 0.0).trust, trust::weak);
    EXPECT_EQ(fit(1.0, 0.5, 0.5).trust, trust::degenerate);
    EXPECT_EQ(fit(1.0, 0.0, 0.0).trust, trust::degenerate);
    EXPECT_EQ(fit(0.0, 0.0, 0.0).trust, trust::degenerate);
    for (const double bad : {clouds::nan, clouds::infinity}) {
        EXPECT_EQ(fit(bad, 1.0, 1.0).trust, trust::not_finite);
        EXPECT_EQ(fit(bad, 1.0, 1.0).normal, Eigen::Vector3d::Zero());
    }
}

/// Second moments of all kinds: most stand apart, some must be refused.
Eigen::Matrix3d any_second_moments(std::size_t i) {
    const double scales[] = {1.0, 1e-4, 1e6, 1e-200, 1e200, 1e-320, 0.0};
    const double scale = i % 5 == 4 ? scales[i / 5 % 7] : 1.0;
    if (i % 11 == 10) return Eigen::Matrix3d::Constant(clouds::nan);
    if (i % 13 == 12) return scale * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d r = clouds::random_rotation(i);
    const Eigen::Vector3d values(1.0, i % 7 == 6 ? 1e-6 : 0.3, 1e-3);
    const Eigen::Matrix3d m = scale * (r * values.asDiagonal() * r.transpose());
    return 0.5 * (m + m.transpose());
}

/// Any number at once, in any company: the same bytes, and what each alone gives but for rounding.
TEST(plane_fit, of_many_at_once_is_that_of_each) {
    std::vector<gnomon::plane_fit> in_pairs(200);
    for (std::size_t i = 0; i < 200; i += 2)
        gnomon::detail::planes_of_least_spread(
            2, [i](std::size_t j) { return any_second_moments(i + j); }, 0.1,
            std::span(in_pairs).subspan(i, 2));
    for (std::size_t n = 0; n <= 17; ++n) {
        for (std::size_t first = 0; first + n <= 200; first += 3) {
            std::vector<gnomon::plane_fit> fits(n);
            gnomon::detail::planes_of_least_spread(
                n, [first](std::size_t i) { return any_second_moments(first + i); }, 0.1, fits);
            for (std::size_t i = 0; i < n; ++i) {
                const gnomon::plane_fit& expected = in_pairs[first + i];
                ASSERT_EQ(fits[i].trust, expected.trust);
                ASSERT_EQ(fits[i].normal, expected.normal);
                ASSERT_EQ(fits[i].spectrum.lambda, expected.spectrum.lambda);
            }
        }
    }
    for (std::size_t i = 0; i < 200; ++i) {
        const auto alone = gnomon::detail::plane_of_least_spread(any_second_moments(i), 0.1);
        ASSERT_EQ(in_pairs[i].trust, alone.trust) << i;
        ASSERT_LT(in_pairs[i].normal.cross(alone.normal).norm(), 1e-12) << i;
        ASSERT_LE((in_pairs[i].spectrum.lambda - alone.spectrum.lambda).cwiseAbs().maxCoeff(),
                  1e-14 * alone.spectrum.lambda[0]);
    }
}

}  // namespace

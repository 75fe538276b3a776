// SPDX-License-Identifier: BSL-1.0
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

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_quality.hpp>

namespace {

gnomon::normal_fit tilted(double degrees) {
    const double a = gnomon::degrees(degrees).radians();
    return {{std::sin(a), 0.0, std::cos(a)}, gnomon::trust::good};
}

TEST(normal_quality, of_known_errors) {
    std::vector<gnomon::normal_fit> surface;
    for (int i = 1; i <= 100; ++i) surface.push_back(tilted(0.1 * i * (i % 2 ? 1 : -1)));
    for (auto& s : surface) s.normal = -s.normal;  // signs do not matter
    const std::vector<Eigen::Vector3d> truth(100, Eigen::Vector3d::UnitZ());
    const auto q = gnomon::normal_quality::of(surface, truth);
    EXPECT_EQ(q.points, 100u);
    EXPECT_EQ(q.usable, 1.0);
    EXPECT_NEAR(q.median.degrees(), 5.0, 1e-12);
    EXPECT_NEAR(q.p90.degrees(), 9.0, 1e-12);
    EXPECT_NEAR(q.p99.degrees(), 9.9, 1e-12);
    EXPECT_NEAR(q.rms.degrees(), 0.1 * std::sqrt(101.0 * 201.0 / 6.0), 1e-12);
    EXPECT_DOUBLE_EQ(q.gamma, gnomon::mean_gamma(surface, truth));
}

/// Giving up costs as much as being wrong by a right angle; what has no truth does not count.
TEST(normal_quality, of_missing_normals_and_missing_truth) {
    const std::vector<gnomon::normal_fit> surface{tilted(0.0), {}, tilted(50.0)};
    const std::vector<Eigen::Vector3d> truth{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ(),
                                             Eigen::Vector3d::Zero()};
    const auto q = gnomon::normal_quality::of(surface, truth);
    EXPECT_EQ(q.points, 2u);
    EXPECT_EQ(q.usable, 0.5);
    EXPECT_EQ(q.gamma, 0.5);
    EXPECT_NEAR(q.p99.degrees(), 90.0, 1e-12);
    // NaN is no normal, and no truth.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto broken = surface;
    broken[0].normal.setConstant(nan);
    EXPECT_EQ(gnomon::normal_quality::of(broken, truth).usable, 0.0);
    auto unknown = truth;
    unknown[1].setConstant(nan);
    EXPECT_EQ(gnomon::normal_quality::of(surface, unknown).points, 1u);
    EXPECT_TRUE(std::isnan(gnomon::normal_quality::of(std::vector<gnomon::normal_fit>(),
                                                      std::vector<Eigen::Vector3d>())
                               .gamma));
    EXPECT_THROW((void)gnomon::normal_quality::of(surface, std::vector<Eigen::Vector3d>(2)),
                 std::invalid_argument);
}

TEST(normal_quality, small_angles_are_accurate) {
    const gnomon::angle a = gnomon::unoriented_angle(tilted(1e-9).normal, Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(a.degrees() / 1e-9, 1.0, 1e-9);
}

}  // namespace

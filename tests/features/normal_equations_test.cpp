// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/features/detail/normal_equations.hpp>

namespace {

using gnomon::detail::normal_equations;
using gnomon::detail::scaled_equations;

/// Solution and covariance against Eigen's, for columns of very different lengths.
TEST(normal_equations, are_solved) {
    gnomon::random_stream random(5);
    for (int trial = 0; trial < 50; ++trial) {
        Eigen::MatrixXd j(20, 4);
        Eigen::VectorXd r(20);
        normal_equations<4> whole, part;
        for (int i = 0; i < 20; ++i) {
            std::array<double, 4> row{};
            for (int k = 0; k < 4; ++k)
                j(i, k) = row.at(static_cast<std::size_t>(k)) =
                    std::pow(1e3, k) * random.gaussian();
            r[i] = random.gaussian();
            (i % 2 == 0 ? whole : part).add(row, r[i]);
        }
        whole.add(part);
        EXPECT_EQ(whole.count, 20u);
        EXPECT_NEAR(whole.squares, r.squaredNorm(), 1e-12 * whole.squares);
        const scaled_equations<4> equations(whole);
        ASSERT_TRUE(equations.is_regular());
        const Eigen::VectorXd expected = -j.colPivHouseholderQr().solve(r);
        const Eigen::MatrixXd covariance = (j.transpose() * j).inverse();
        const auto step = equations.step(0.0);
        for (int a = 0; a < 4; ++a) {
            const auto i = static_cast<std::size_t>(a);
            const double scale = std::sqrt(covariance(a, a));
            EXPECT_NEAR(step.at(i), expected[a], 1e-10 * scale);
            for (int b = 0; b < 4; ++b) {
                EXPECT_NEAR(equations.covariance().at(i).at(static_cast<std::size_t>(b)),
                            covariance(a, b), 1e-10 * scale * std::sqrt(covariance(b, b)));
            }
        }
    }
}

/// A column that repeats another one: the step is finite, and along neither of them alone.
TEST(normal_equations, report_what_is_not_determined) {
    gnomon::random_stream random(6);
    normal_equations<3> e;
    for (int i = 0; i < 10; ++i) {
        const double a = random.gaussian(), b = random.gaussian();
        e.add({a, b, b}, -a - 4.0 * b);
    }
    const scaled_equations<3> equations(e);
    EXPECT_FALSE(equations.is_regular());
    const auto x = equations.step(0.0);
    EXPECT_NEAR(x[0], 1.0, 1e-10);
    EXPECT_NEAR(x[1], 2.0, 1e-10);
    EXPECT_NEAR(x[2], 2.0, 1e-10);
}

TEST(normal_equations, of_nothing_are_not_regular) {
    const scaled_equations<3> equations{normal_equations<3>()};
    EXPECT_FALSE(equations.is_regular());
    EXPECT_EQ(equations.step(0.0)[0], 0.0);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/features/detail/solid_harmonics.hpp>

namespace {

using gnomon::detail::solid_harmonics;

std::map<std::pair<std::size_t, std::size_t>, std::complex<double>> harmonics_at(
    std::size_t bandwidth, const Eigen::Vector3d& v) {
    std::map<std::pair<std::size_t, std::size_t>, std::complex<double>> all;
    const solid_harmonics harmonics(bandwidth);
    harmonics.at(v, [&](std::size_t l, std::size_t m, double re, double im) {
        all[{l, m}] = {re, im};
    });
    EXPECT_EQ(all.size(), harmonics.size());
    return all;
}

TEST(solid_harmonics, of_low_degree_are_the_known_polynomials) {
    const double pi = std::numbers::pi;
    gnomon::random_stream random(1);
    for (int i = 0; i < 20; ++i) {
        const Eigen::Vector3d v = clouds::gaussian_vector(random);
        const std::complex<double> xy(v.x(), v.y());
        const double z = v.z(), r2 = v.squaredNorm();
        const auto y = harmonics_at(4, v);
        const auto expect = [&](std::size_t l, std::size_t m, std::complex<double> value) {
            EXPECT_LT(std::abs(y.at({l, m}) - value), 1e-13 * (1.0 + std::abs(value)));
        };
        expect(0, 0, std::sqrt(1 / (4 * pi)));
        expect(1, 0, std::sqrt(3 / (4 * pi)) * z);
        expect(1, 1, -std::sqrt(3 / (8 * pi)) * xy);
        expect(2, 0, std::sqrt(5 / (16 * pi)) * (3 * z * z - r2));
        expect(2, 1, -std::sqrt(15 / (8 * pi)) * xy * z);
        expect(2, 2, std::sqrt(15 / (32 * pi)) * xy * xy);
        expect(3, 0, std::sqrt(7 / (16 * pi)) * (5 * z * z * z - 3 * z * r2));
        expect(3, 3, -std::sqrt(35 / (64 * pi)) * xy * xy * xy);
    }
}

/// The addition theorem: the squares of a degree add up to (2 l + 1) / (4 pi) on the unit sphere.
TEST(solid_harmonics, obey_the_addition_theorem) {
    gnomon::random_stream random(2);
    for (int i = 0; i < 50; ++i) {
        Eigen::Vector3d v = clouds::gaussian_vector(random).normalized();
        if (i == 0) v = {0, 0, -1};
        const auto y = harmonics_at(40, v);
        for (std::size_t l = 0; l < 40; ++l) {
            double sum = std::norm(y.at({l, 0}));
            for (std::size_t m = 1; m <= l; ++m) sum += 2 * std::norm(y.at({l, m}));
            const double expected = (2.0 * static_cast<double>(l) + 1.0) / (4 * std::numbers::pi);
            ASSERT_NEAR(sum, expected, 1e-12 * expected);
        }
    }
}

}  // namespace

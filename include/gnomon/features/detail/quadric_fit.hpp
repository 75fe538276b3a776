// SPDX-License-Identifier: BSL-1.0
/// @file
/// Quadratics fitted to heights z over a plane, by sums of products in fixed arrays: as Eigen
/// expressions the compiler takes ten times as long to read them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/square_array.hpp>
#include <gnomon/core/symmetric_eigen.hpp>

namespace gnomon::detail {

/// z = a x^2 + b x y + c y^2 + e x + f y + constant.
struct quadric {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    double e = 0.0;
    double f = 0.0;
};

/// All six coefficients by least squares of z. Normal equations, so x and y should be of order one.
class least_squares_quadric {
  public:
    void add(double x, double y, double z) {
        const std::array<double, 6> row{1.0, x, y, x * x, x * y, y * y};
        for (std::size_t i = 0; i < 6; ++i) {
            right_[i] += row[i] * z;
            for (std::size_t j = 0; j <= i; ++j) left_[i][j] += row[i] * row[j];
        }
    }

    /// Solves by L D L^T, in place. Returns the least share of a column that the columns before it
    /// do not explain, D_j / A_jj, in [0, 1]; there is no solution if it is zero up to rounding.
    double solve() {
        double least = 1.0;
        for (std::size_t j = 0; j < 6; ++j) {
            const double all = left_[j][j];
            for (std::size_t k = 0; k < j; ++k) {
                left_[j][j] -= left_[j][k] * left_[j][k] * left_[k][k];
            }
            if (!(left_[j][j] > 0.0)) return 0.0;
            least = std::min(least, left_[j][j] / all);
            for (std::size_t i = j + 1; i < 6; ++i) {
                for (std::size_t k = 0; k < j; ++k) {
                    left_[i][j] -= left_[i][k] * left_[j][k] * left_[k][k];
                }
                left_[i][j] /= left_[j][j];
            }
        }
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t k = 0; k < i; ++k) right_[i] -= left_[i][k] * right_[k];
        }
        for (std::size_t i = 6; i-- > 0;) {
            right_[i] /= left_[i][i];
            for (std::size_t k = i + 1; k < 6; ++k) right_[i] -= left_[k][i] * right_[k];
        }
        return least;
    }

    /// The solution, for coordinates that were multiplied by sx and sy before they were added.
    [[nodiscard]] quadric solution(double sx, double sy) const {
        return {right_[3] * sx * sx, right_[4] * sx * sy, right_[5] * sy * sy, right_[1] * sx,
                right_[2] * sy};
    }

  private:
    square_array<6> left_ = {};  // its lower half
    std::array<double, 6> right_ = {};
};

/// The unit vector [a' b' c' d'] for which the sum of squares of a' x^2 + b' x y + c' y^2 + d' z is
/// least, Eq. (3.25).
class homogeneous_quadric {
  public:
    void add(double x, double y, double z) {
        const std::array<double, 4> row{x * x, x * y, y * y, z};
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) products_[i][j] += row[i] * row[j];
        }
    }

    /// The quadric z = a x^2 + b x y + c y^2 with a = -a'/d' and so on; nothing if there is none,
    /// or more than one.
    [[nodiscard]] std::optional<quadric> solve() const {
        double trace = 0.0;
        for (std::size_t i = 0; i < 4; ++i) trace += products_[i][i];
        if (!(trace > 0.0) || !std::isfinite(trace)) return std::nullopt;
        const auto [values, vectors] = symmetric_eigen<4>(products_);
        constexpr double rounding = 1e-14;
        if (values[2] - values[3] <= rounding * trace) return std::nullopt;
        const double d = vectors[3][3];
        if (std::abs(d) < 1e-12) return std::nullopt;
        return quadric{-vectors[0][3] / d, -vectors[1][3] / d, -vectors[2][3] / d, 0.0, 0.0};
    }

  private:
    square_array<4> products_ = {};
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Quadrics as heights z over a plane, and their fit by least squares: normal equations in
/// fixed-size arrays, which take a tenth of the compile time of Eigen expressions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <gnomon/core/detail/square_array.hpp>

namespace gnomon::detail {

/// The quadric z = a x^2 + b x y + c y^2 + e x + f y + constant. Units: a, b, c [1/m]; e, f [1].
struct quadric {
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    double e = 0.0;
    double f = 0.0;
    double constant = 0.0;  ///< [m]

    /// The height z at (x, y) [m].
    [[nodiscard]] double operator()(double x, double y) const {
        return (a * x + b * y + e) * x + (c * y + f) * y + constant;
    }
};

/// Least-squares fit of all six coefficients. Solves the normal equations, so x and y should be of
/// order 1. Needs six points.
class least_squares_quadric {
  public:
    /// Adds the point (x, y, z) with a weight. O(1).
    void add(double x, double y, double z, double weight = 1.0) {
        const std::array<double, 6> row{1.0, x, y, x * x, x * y, y * y};
        for (std::size_t i = 0; i < 6; ++i) {
            const double weighted = weight * row[i];
            right_[i] += weighted * z;
            for (std::size_t j = 0; j <= i; ++j) left_[i][j] += weighted * row[j];
        }
        heights_ += weight * z * z;
    }

    /// Solves the normal equations A c = r by the decomposition A = L D L^T, in place. O(1).
    /// @return the minimum of D_j / A_jj over all columns j, in [0, 1]: the fraction of a column
    ///         that the preceding columns do not explain. The system is singular if it is zero up
    ///         to rounding.
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
        for (std::size_t i = 0; i < 6; ++i)
            heights_ = std::max(0.0, heights_ - right_[i] * right_[i] / left_[i][i]);
        for (std::size_t i = 6; i-- > 0;) {
            right_[i] /= left_[i][i];
            for (std::size_t k = i + 1; k < 6; ++k) right_[i] -= left_[k][i] * right_[k];
        }
        return least;
    }

    /// The quadric in coordinates x, y if (sx x, sy y, z) were added. Precondition: solved.
    [[nodiscard]] quadric solution(double sx, double sy) const {
        return {right_[3] * sx * sx, right_[4] * sx * sy, right_[5] * sy * sy,
                right_[1] * sx,      right_[2] * sy,      right_[0]};
    }

    /// The weighted sum of squares [m^2] of the heights over the quadric. Precondition: solved.
    [[nodiscard]] double squared_residual() const { return heights_; }

  private:
    square_array<6> left_ = {};         // A, then L and D; lower triangle
    std::array<double, 6> right_ = {};  // r, then the coefficients
    double heights_ = 0.0;              // sum of w z^2, then what the quadric leaves of it [m^2]
};

}  // namespace gnomon::detail

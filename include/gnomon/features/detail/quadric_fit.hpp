// SPDX-License-Identifier: BSL-1.0
/// @file
/// The fit of a quadric to heights z over a plane as the thesis has it, without slopes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/jacobi_eigen.hpp>
#include <gnomon/core/detail/least_squares_quadric.hpp>
#include <gnomon/core/detail/square_array.hpp>

namespace gnomon::detail {

/// Fit by the unit vector [a' b' c' d'] that minimizes the sum of squares of
/// a' x^2 + b' x y + c' y^2 + d' z, Klasing 2010, Eq. (3.25). Needs three points.
class homogeneous_quadric {
  public:
    /// Adds the point (x, y, z). O(1).
    void add(double x, double y, double z) {
        const std::array<double, 4> row{x * x, x * y, y * y, z};
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) products_[i][j] += row[i] * row[j];
        }
    }

    /// The quadric z = a x^2 + b x y + c y^2 with a = -a'/d', b = -b'/d', c = -c'/d'; none if the
    /// smallest eigenvalue of R^T R is double, if d' is zero, or if a sum is not finite. O(1).
    [[nodiscard]] std::optional<quadric> solve() const {
        double trace = 0.0;
        for (std::size_t i = 0; i < 4; ++i) trace += products_[i][i];
        if (!(trace > 0.0) || !std::isfinite(trace)) return std::nullopt;
        const auto [values, vectors] = jacobi_eigen<4>(products_);
        constexpr double rounding = 1e-14;  // of eigenvalues, relative to the trace
        if (values[2] - values[3] <= rounding * trace) return std::nullopt;
        const double d = vectors[3][3];
        constexpr double negligible = 1e-12;  // rounding error of an eigenvector, times a margin
        if (std::abs(d) < negligible) return std::nullopt;
        return quadric{-vectors[0][3] / d, -vectors[1][3] / d, -vectors[2][3] / d, 0.0, 0.0};
    }

  private:
    square_array<4> products_ = {};
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The normal equations of a least-squares problem with few parameters, and their solution by the
/// eigenvectors of the matrix, which state as well what the observations do not determine.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/jacobi_eigen.hpp>
#include <gnomon/core/detail/square_array.hpp>

namespace gnomon::detail {

/// J^T J, J^T r and r^T r of residuals r with the rows of J as derivatives, summed row by row.
template <std::size_t N>
struct normal_equations {
    square_array<N> left{};         ///< lower triangle of J^T J
    std::array<double, N> right{};  ///< J^T r
    double squares = 0.0;           ///< r^T r
    std::size_t count = 0;          ///< rows

    void add(const std::array<double, N>& row, double residual) {
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j <= i; ++j) left[i][j] += row[i] * row[j];
            right[i] += row[i] * residual;
        }
        squares += residual * residual;
        ++count;
    }

    void add(const normal_equations& other) {
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j <= i; ++j) left[i][j] += other.left[i][j];
            right[i] += other.right[i];
        }
        squares += other.squares;
        count += other.count;
    }
};

/// The decomposition of J^T J after each column of J is divided by its length, so that its diagonal
/// is 1 and the units of the parameters do not matter.
template <std::size_t N>
class scaled_equations {
  public:
    /// Precondition: the entries of `e` are finite.
    explicit scaled_equations(const normal_equations<N>& e) {
        square_array<N> unit{};
        for (std::size_t i = 0; i < N; ++i)
            scale_[i] = e.left[i][i] > 0.0 ? 1.0 / std::sqrt(e.left[i][i]) : 0.0;
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j <= i; ++j)
                unit[i][j] = unit[j][i] = e.left[i][j] * scale_[i] * scale_[j];
        }
        eigen_ = jacobi_eigen<N>(unit);
        for (std::size_t k = 0; k < N; ++k) {
            for (std::size_t i = 0; i < N; ++i)
                right_[k] += eigen_.vectors[i][k] * scale_[i] * e.right[i];
        }
    }

    /// Whether the observations determine all parameters, up to rounding.
    [[nodiscard]] bool is_regular() const { return eigen_.values[N - 1] > rounding; }

    /// -(J^T J + damping diag(J^T J))^-1 J^T r, the step to the minimum; 0 along directions that
    /// the observations do not determine.
    [[nodiscard]] std::array<double, N> step(double damping) const {
        std::array<double, N> s{};
        for (std::size_t k = 0; k < N; ++k) {
            if (eigen_.values[k] <= rounding) continue;
            const double along = right_[k] / (eigen_.values[k] + damping);
            for (std::size_t i = 0; i < N; ++i) s[i] -= scale_[i] * eigen_.vectors[i][k] * along;
        }
        return s;
    }

    /// (J^T J)^-1, the covariance of the parameters if residuals have the variance 1.
    /// Precondition: is_regular().
    [[nodiscard]] square_array<N> covariance() const {
        square_array<N> c{};
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j < N; ++j) {
                for (std::size_t k = 0; k < N; ++k)
                    c[i][j] += scale_[i] * scale_[j] * eigen_.vectors[i][k] * eigen_.vectors[j][k] /
                               eigen_.values[k];
            }
        }
        return c;
    }

  private:
    static constexpr double rounding = 1e-13;  // numerical: of eigenvalues, whose sum is N

    std::array<double, N> scale_{};
    std::array<double, N> right_{};
    small_eigen_decomposition<N> eigen_{};
};

/// The parameters x that minimize the squares of rows . x - values, from `add(row, -value)`.
template <std::size_t N>
[[nodiscard]] std::array<double, N> linear_solution(const normal_equations<N>& e) {
    return scaled_equations<N>(e).step(0.0);
}

}  // namespace gnomon::detail

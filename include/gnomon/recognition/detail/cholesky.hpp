// SPDX-License-Identifier: BSL-1.0
/// @file
/// The Cholesky factorization of a small symmetric matrix: A = L L^T with L lower triangular (Golub
/// and Van Loan, Matrix Computations). It exists if A is positive definite.
#pragma once

#include <array>
#include <cstddef>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/square_array.hpp>

namespace gnomon::recognition::detail {

using gnomon::detail::square_array;

/// L of a symmetric matrix, whose lower triangle is read.
template <std::size_t D>
class cholesky {
  public:
    /// Precondition: the entries are finite.
    explicit cholesky(const square_array<D>& a) {
        for (std::size_t i = 0; i < D; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                double left = a[i][j];
                for (std::size_t k = 0; k < j; ++k) left -= lower_[i][k] * lower_[j][k];
                if (j < i) {
                    lower_[i][j] = left / lower_[j][j];
                } else if (left > rounding * a[i][i]) {
                    lower_[i][i] = std::sqrt(left);
                } else {
                    return;
                }
            }
        }
        is_positive_definite_ = true;
    }

    /// Whether each variable has variance that the ones before it do not explain, above rounding.
    /// All other functions need this.
    [[nodiscard]] bool is_positive_definite() const { return is_positive_definite_; }

    /// L^-1 x, the whitened x: its squared length is x^T A^-1 x. O(D^2).
    [[nodiscard]] std::array<double, D> whitened(std::array<double, D> x) const {
        for (std::size_t i = 0; i < D; ++i) {
            for (std::size_t k = 0; k < i; ++k) x[i] -= lower_[i][k] * x[k];
            x[i] /= lower_[i][i];
        }
        return x;
    }

    /// A^-1 = L^-T L^-1, symmetric to the last bit. O(D^3).
    [[nodiscard]] square_array<D> inverse() const {
        square_array<D> columns;  // of L^-1
        for (std::size_t i = 0; i < D; ++i) {
            std::array<double, D> unit{};
            unit[i] = 1.0;
            columns[i] = whitened(unit);
        }
        square_array<D> product{};
        for (std::size_t i = 0; i < D; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                for (std::size_t k = i; k < D; ++k) product[i][j] += columns[i][k] * columns[j][k];
                product[j][i] = product[i][j];
            }
        }
        return product;
    }

  private:
    static constexpr double rounding = 1e-13;  // numerical: of a pivot, in its diagonal entry

    square_array<D> lower_{};
    bool is_positive_definite_ = false;
};

}  // namespace gnomon::recognition::detail

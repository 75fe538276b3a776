// SPDX-License-Identifier: BSL-1.0
/// @file
/// Singular values and vectors of a tall matrix with few columns, without squaring its condition:
/// rows are folded one by one into a triangle (Givens rotations, so that any number of rows fits
/// into N x N numbers), which one-sided Jacobi rotations then decompose (Hestenes 1958; Golub and
/// Van Loan, Matrix Computations, Secs. 5.1.8 and 8.6).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/square_array.hpp>

namespace gnomon {

/// The triangle R of A = Q R, for a matrix A whose rows of N entries come one by one. O(N^2) a row.
template <std::size_t N>
class row_triangle {
  public:
    /// Takes in a row.
    void add(std::array<double, N> row) {
        for (std::size_t j = 0; j < N; ++j) {
            const double length = std::sqrt(r_[j][j] * r_[j][j] + row[j] * row[j]);
            if (length == 0.0) continue;  // also where squares underflow
            const double c = r_[j][j] / length;
            const double s = row[j] / length;
            for (std::size_t i = j; i < N; ++i) {
                const double above = r_[j][i];
                r_[j][i] = c * above + s * row[i];
                row[i] = c * row[i] - s * above;
            }
        }
    }

    /// Upper triangular, with R^T R = A^T A.
    [[nodiscard]] const square_array<N>& matrix() const { return r_; }

  private:
    square_array<N> r_ = {};
};

/// A = scaled_left V^T, scaled_left having the orthogonal columns s_j u_j; values descend.
template <std::size_t N>
struct small_svd_result {
    std::array<double, N> values;  ///< s_j
    square_array<N> scaled_left;   ///< columns s_j u_j
    square_array<N> right;         ///< columns v_j
};

/// Decomposes a square matrix; only finite entries are allowed. Singular vectors are accurate to a
/// few eps / gap, the gap being the distance to the nearest other singular value, relative to the
/// largest. O(N^3) a sweep, with six to ten sweeps.
template <std::size_t N>
[[nodiscard]] small_svd_result<N> small_svd(const square_array<N>& a) {
    small_svd_result<N> svd{.values = {}, .scaled_left = a, .right = {}};
    auto& [values, u, v] = svd;
    for (std::size_t i = 0; i < N; ++i) v[i][i] = 1.0;
    constexpr double eps = std::numeric_limits<double>::epsilon();
    constexpr int max_sweeps = 30;
    bool turned = true;
    for (int sweep = 0; sweep < max_sweeps && turned; ++sweep) {
        turned = false;
        for (std::size_t p = 0; p < N; ++p) {
            for (std::size_t q = p + 1; q < N; ++q) {
                double pp = 0.0;
                double qq = 0.0;
                double pq = 0.0;
                for (std::size_t i = 0; i < N; ++i) {
                    pp += u[i][p] * u[i][p];
                    qq += u[i][q] * u[i][q];
                    pq += u[i][p] * u[i][q];
                }
                if (!(std::abs(pq) > eps * std::sqrt(pp) * std::sqrt(qq))) continue;
                turned = true;
                const double zeta = (qq - pp) / (2.0 * pq);
                const double t =
                    std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
                const double c = 1.0 / std::sqrt(1.0 + t * t);
                const double s = c * t;
                for (auto* m : {&u, &v}) {
                    for (std::size_t i = 0; i < N; ++i) {
                        const double ip = (*m)[i][p];
                        const double iq = (*m)[i][q];
                        (*m)[i][p] = c * ip - s * iq;
                        (*m)[i][q] = s * ip + c * iq;
                    }
                }
            }
        }
    }

    for (std::size_t j = 0; j < N; ++j) {
        double square = 0.0;
        for (std::size_t i = 0; i < N; ++i) square += u[i][j] * u[i][j];
        values[j] = std::sqrt(square);
    }
    for (std::size_t i = 1; i < N; ++i) {  // insertion sort, vectors along
        for (std::size_t j = i; j > 0 && values[j - 1] < values[j]; --j) {
            std::swap(values[j - 1], values[j]);
            for (std::size_t r = 0; r < N; ++r) {
                std::swap(u[r][j - 1], u[r][j]);
                std::swap(v[r][j - 1], v[r][j]);
            }
        }
    }
    return svd;
}

}  // namespace gnomon

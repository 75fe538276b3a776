// SPDX-License-Identifier: BSL-1.0
/// @file
/// Singular values and vectors of a tall matrix with few columns, without squaring its condition
/// number. Givens rotations reduce the rows, one by one, to an N x N triangle; one-sided Jacobi
/// rotations decompose the triangle (Hestenes 1958; Golub and Van Loan, Matrix Computations, Secs.
/// 5.1.8 and 8.6).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/square_array.hpp>

namespace gnomon::detail {

/// The triangle R of the QR decomposition A = Q R of a matrix A whose rows of N entries are added
/// one by one. N x N numbers of memory for any number of rows; O(N^2) per row.
template <std::size_t N>
class row_triangle {
  public:
    /// Adds a row of A.
    void add(std::array<double, N> row) {
        for (std::size_t j = 0; j < N; ++j) {
            const double length = std::sqrt(r_[j][j] * r_[j][j] + row[j] * row[j]);
            if (length == 0.0) continue;  // also if the squares underflow
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

/// A = scaled_left V^T with orthonormal columns of V; the columns of scaled_left are s_j u_j.
template <std::size_t N>
struct small_svd_result {
    std::array<double, N> values;  ///< the singular values s_j, descending
    square_array<N> scaled_left;   ///< columns s_j u_j
    square_array<N> right;         ///< columns v_j
};

/// One one-sided Jacobi rotation: makes columns p and q of `u` orthogonal and turns `v` with them.
/// @return false if the columns were orthogonal to working precision, and nothing changed
template <std::size_t N>
bool orthogonalize(square_array<N>& u, square_array<N>& v, std::size_t p, std::size_t q) {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    double pp = 0.0;
    double qq = 0.0;
    double pq = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
        pp += u[i][p] * u[i][p];
        qq += u[i][q] * u[i][q];
        pq += u[i][p] * u[i][q];
    }
    if (!(std::abs(pq) > eps * std::sqrt(pp) * std::sqrt(qq))) return false;
    const double zeta = (qq - pp) / (2.0 * pq);
    const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
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
    return true;
}

/// Sorts the singular values in descending order, with their vectors. Insertion sort.
template <std::size_t N>
void sort_descending(small_svd_result<N>& svd) {
    auto& [values, u, v] = svd;
    for (std::size_t i = 1; i < N; ++i) {
        for (std::size_t j = i; j > 0 && values[j - 1] < values[j]; --j) {
            std::swap(values[j - 1], values[j]);
            for (std::size_t r = 0; r < N; ++r) {
                std::swap(u[r][j - 1], u[r][j]);
                std::swap(v[r][j - 1], v[r][j]);
            }
        }
    }
}

/// Decomposes a square matrix by cyclic one-sided Jacobi rotations. Precondition: finite entries.
///
/// Singular vectors are accurate to a few eps / gap; the gap is the distance to the nearest other
/// singular value, relative to the largest. O(N^3) per sweep; six to ten sweeps.
template <std::size_t N>
[[nodiscard]] small_svd_result<N> small_svd(const square_array<N>& a) {
    small_svd_result<N> svd{.values = {}, .scaled_left = a, .right = {}};
    auto& [values, u, v] = svd;
    for (std::size_t i = 0; i < N; ++i) v[i][i] = 1.0;
    constexpr int max_sweeps = 30;  // never reached: convergence is quadratic
    bool rotated = true;
    for (int sweep = 0; sweep < max_sweeps && rotated; ++sweep) {
        rotated = false;
        for (std::size_t p = 0; p < N; ++p) {
            for (std::size_t q = p + 1; q < N; ++q) {
                if (orthogonalize<N>(u, v, p, q)) rotated = true;
            }
        }
    }
    for (std::size_t j = 0; j < N; ++j) {
        double square = 0.0;
        for (std::size_t i = 0; i < N; ++i) square += u[i][j] * u[i][j];
        values[j] = std::sqrt(square);
    }
    sort_descending(svd);
    return svd;
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a small symmetric matrix by cyclic Jacobi rotations (Golub and
/// Van Loan, Matrix Computations, Sec. 8.5). Rotations are backward stable for every rank and every
/// multiplicity of eigenvalues; closed forms lose half the digits at near-equal eigenvalues.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/square_array.hpp>

namespace gnomon::detail {

/// A = V diag(values) V^T with values in descending order and orthonormal columns of V.
template <std::size_t N>
struct small_eigen_decomposition {
    std::array<double, N> values;  ///< eigenvalues
    square_array<N> vectors;       ///< unit eigenvectors in columns
};

/// One Jacobi rotation: makes a[p][q] zero and applies the same rotation to the columns of v.
template <std::size_t N>
void rotate_away(square_array<N>& a, square_array<N>& v, std::size_t p, std::size_t q) {
    if (a[p][q] == 0.0) return;
    const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    // If the square of theta overflows, t = 0, which is the correctly rounded result.
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(1.0 + theta * theta));
    const double c = 1.0 / std::sqrt(1.0 + t * t);
    const double s = t * c;
    a[p][p] -= t * a[p][q];
    a[q][q] += t * a[p][q];
    a[p][q] = a[q][p] = 0.0;
    for (std::size_t r = 0; r < N; ++r) {
        if (r == p || r == q) continue;
        const double rp = a[r][p];
        const double rq = a[r][q];
        a[r][p] = a[p][r] = c * rp - s * rq;
        a[r][q] = a[q][r] = s * rp + c * rq;
    }
    for (std::size_t i = 0; i < N; ++i) {
        const double ip = v[i][p];
        const double iq = v[i][q];
        v[i][p] = c * ip - s * iq;
        v[i][q] = s * ip + c * iq;
    }
}

/// Decomposes the symmetric matrix `a`. Precondition: all entries are finite.
///
/// Eigenvectors are accurate to a few eps / gap, where gap is the distance to the nearest other
/// eigenvalue relative to the largest. A multiple eigenvalue gets some orthonormal basis of its
/// eigenspace. Signs are arbitrary but deterministic. O(N^3) per sweep; the convergence is
/// quadratic, and at most five sweeps were needed for N = 3.
template <std::size_t N>
[[nodiscard]] small_eigen_decomposition<N> jacobi_eigen(const square_array<N>& a) {
    small_eigen_decomposition<N> e{};
    for (std::size_t i = 0; i < N; ++i) e.vectors[i][i] = 1.0;
    double scale = 0.0;  // the largest entry; division by it prevents over- and underflow
    for (const auto& row : a) {
        for (const double entry : row) scale = std::max(scale, std::abs(entry));
    }
    if (scale < std::numeric_limits<double>::min()) return e;
    square_array<N> d = a;
    for (auto& row : d) {
        for (double& entry : row) entry /= scale;
    }

    // Off-diagonal entries below eps / 64 change no eigenvalue of a matrix with entries up to 1.
    constexpr double negligible = std::numeric_limits<double>::epsilon() / 64;
    constexpr int max_sweeps = 12;  // never reached: convergence is quadratic
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
        double off_diagonal = 0.0;
        for (std::size_t p = 0; p < N; ++p) {
            for (std::size_t q = p + 1; q < N; ++q) off_diagonal += std::abs(d[p][q]);
        }
        if (off_diagonal < negligible) break;
        for (std::size_t p = 0; p < N; ++p) {
            for (std::size_t q = p + 1; q < N; ++q) rotate_away<N>(d, e.vectors, p, q);
        }
    }

    for (std::size_t i = 0; i < N; ++i) e.values[i] = scale * d[i][i];
    for (std::size_t i = 1; i < N; ++i) {  // insertion sort of values and eigenvectors
        for (std::size_t j = i; j > 0 && e.values[j - 1] < e.values[j]; --j) {
            std::swap(e.values[j - 1], e.values[j]);
            for (auto& row : e.vectors) std::swap(row[j - 1], row[j]);
        }
    }
    return e;
}

}  // namespace gnomon::detail

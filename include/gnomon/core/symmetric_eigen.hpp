// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a small symmetric matrix by cyclic Jacobi rotations (Golub and
/// Van Loan, Matrix Computations, Sec. 8.5): backward stable for every rank and every multiplicity,
/// where closed forms lose half the digits at near-equal eigenvalues. A perfect plane, a line, a
/// ball and the zero matrix are ordinary inputs.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

namespace gnomon {

/// A = V diag(values) V^T with values in descending order and orthonormal columns of V.
template <int N = 3>
struct eigen_decomposition {
    Eigen::Matrix<double, N, 1> values;
    Eigen::Matrix<double, N, N> vectors;
};

namespace detail {

/// One Jacobi rotation: makes a(p,q) zero and turns v along.
template <int N>
void rotate_away(Eigen::Matrix<double, N, N>& a, Eigen::Matrix<double, N, N>& v, int p, int q) {
    if (a(p, q) == 0.0) return;
    const double theta = (a(q, q) - a(p, p)) / (2.0 * a(p, q));
    // A theta whose square overflows gives t = 0, which is right to the last bit.
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(1.0 + theta * theta));
    const double c = 1.0 / std::sqrt(1.0 + t * t);
    const double s = t * c;
    a(p, p) -= t * a(p, q);
    a(q, q) += t * a(p, q);
    a(p, q) = a(q, p) = 0.0;
    for (int r = 0; r < N; ++r) {
        if (r == p || r == q) continue;
        const double rp = a(r, p);
        const double rq = a(r, q);
        a(r, p) = a(p, r) = c * rp - s * rq;
        a(r, q) = a(q, r) = s * rp + c * rq;
    }
    for (int i = 0; i < N; ++i) {
        const double ip = v(i, p);
        const double iq = v(i, q);
        v(i, p) = c * ip - s * iq;
        v(i, q) = s * ip + c * iq;
    }
}

}  // namespace detail

/// Decomposes the symmetric matrix `a`; only finite entries are allowed.
///
/// Eigenvectors are accurate to a few eps / gap, gap being the distance to the nearest other
/// eigenvalue relative to the largest; a multiple eigenvalue gets some orthonormal basis of its
/// space. Signs are arbitrary but deterministic. Constant time; Jacobi converges quadratically, in
/// at most five sweeps for N = 3 in our tests.
template <int N = 3>
[[nodiscard]] eigen_decomposition<N> symmetric_eigen(
    const std::type_identity_t<Eigen::Matrix<double, N, N>>& a) {
    eigen_decomposition<N> e;
    e.values.setZero();
    e.vectors.setIdentity();
    double scale = 0.0;  // brought to one, so that no square below over- or underflows
    for (int i = 0; i < N * N; ++i) scale = std::max(scale, std::abs(a.data()[i]));
    if (scale < std::numeric_limits<double>::min()) return e;
    Eigen::Matrix<double, N, N> d;
    for (int i = 0; i < N * N; ++i) d.data()[i] = a.data()[i] / scale;

    constexpr double negligible = std::numeric_limits<double>::epsilon() / 64;
    constexpr int max_sweeps = 12;
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
        double off_diagonal = 0.0;
        for (int p = 0; p < N; ++p) {
            for (int q = p + 1; q < N; ++q) off_diagonal += std::abs(d(p, q));
        }
        if (off_diagonal < negligible) break;
        for (int p = 0; p < N; ++p) {
            for (int q = p + 1; q < N; ++q) detail::rotate_away<N>(d, e.vectors, p, q);
        }
    }

    for (int i = 0; i < N; ++i) e.values[i] = scale * d(i, i);
    for (int i = 1; i < N; ++i) {  // insertion sort, eigenvectors along
        for (int j = i; j > 0 && e.values[j - 1] < e.values[j]; --j) {
            std::swap(e.values[j - 1], e.values[j]);
            for (int r = 0; r < N; ++r) std::swap(e.vectors(r, j - 1), e.vectors(r, j));
        }
    }
    return e;
}

}  // namespace gnomon

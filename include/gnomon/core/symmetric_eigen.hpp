// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a small symmetric matrix by cyclic Jacobi rotations (Golub and
/// Van Loan, Matrix Computations, Sec. 8.5; 3x3 matrices of flat neighborhoods by a faster way, see
/// detail/separated_eigen.hpp): backward stable for every rank and every multiplicity,
/// where closed forms lose half the digits at near-equal eigenvalues. A perfect plane, a line, a
/// ball and the zero matrix are ordinary inputs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/separated_eigen.hpp>
#include <gnomon/core/square_array.hpp>

namespace gnomon {

/// A = V diag(values) V^T with values in descending order and orthonormal columns of V.
struct eigen_decomposition {
    Eigen::Vector3d values;
    Eigen::Matrix3d vectors;
};

/// The same of an N x N matrix.
template <std::size_t N>
struct small_eigen_decomposition {
    std::array<double, N> values;
    square_array<N> vectors;  ///< in columns
};

namespace detail {

/// One Jacobi rotation: makes a[p][q] zero and turns v along.
template <std::size_t N>
void rotate_away(square_array<N>& a, square_array<N>& v, std::size_t p, std::size_t q) {
    if (a[p][q] == 0.0) return;
    const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    // A theta whose square overflows gives t = 0, which is right to the last bit.
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

}  // namespace detail

/// Decomposes the symmetric matrix `a`; only finite entries are allowed.
///
/// Eigenvectors are accurate to a few eps / gap, gap being the distance to the nearest other
/// eigenvalue relative to the largest; a multiple eigenvalue gets some orthonormal basis of its
/// space. Signs are arbitrary but deterministic. O(N^3) a sweep; Jacobi converges quadratically, in
/// at most five sweeps for N = 3 in our tests.
template <std::size_t N>
[[nodiscard]] small_eigen_decomposition<N> symmetric_eigen(const square_array<N>& a) {
    small_eigen_decomposition<N> e{};
    for (std::size_t i = 0; i < N; ++i) e.vectors[i][i] = 1.0;
    double scale = 0.0;  // brought to one, so that no square below over- or underflows
    for (const auto& row : a) {
        for (const double entry : row) scale = std::max(scale, std::abs(entry));
    }
    if (scale < std::numeric_limits<double>::min()) return e;
    square_array<N> d = a;
    for (auto& row : d) {
        for (double& entry : row) entry /= scale;
    }

    constexpr double negligible = std::numeric_limits<double>::epsilon() / 64;
    constexpr int max_sweeps = 12;
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
        double off_diagonal = 0.0;
        for (std::size_t p = 0; p < N; ++p) {
            for (std::size_t q = p + 1; q < N; ++q) off_diagonal += std::abs(d[p][q]);
        }
        if (off_diagonal < negligible) break;
        for (std::size_t p = 0; p < N; ++p) {
            for (std::size_t q = p + 1; q < N; ++q) detail::rotate_away<N>(d, e.vectors, p, q);
        }
    }

    for (std::size_t i = 0; i < N; ++i) e.values[i] = scale * d[i][i];
    for (std::size_t i = 1; i < N; ++i) {  // insertion sort, eigenvectors along
        for (std::size_t j = i; j > 0 && e.values[j - 1] < e.values[j]; --j) {
            std::swap(e.values[j - 1], e.values[j]);
            for (auto& row : e.vectors) std::swap(row[j - 1], row[j]);
        }
    }
    return e;
}

namespace detail {

/// Decomposes a matrix of second moments whose smallest eigenvalue stands apart.
/// @return whether it was one
[[nodiscard]] inline bool decompose_if_separated(const Eigen::Matrix3d& a, eigen_decomposition& e) {
    const double trace = a(0, 0) + a(1, 1) + a(2, 2);
    if (!has_scale(trace)) return false;
    const double s = 1.0 / trace;
    const separated_eigen<double> found(symmetric_3x3<double>{
        s * a(0, 0), s * a(1, 1), s * a(2, 2), s * a(1, 0), s * a(2, 0), s * a(2, 1)});
    if (!is_accurate(found.values[1], found.values[2], found.squared_residual)) return false;
    for (int i = 0; i < 3; ++i) {
        e.values[i] = trace * found.values[i];
        e.vectors(0, i) = found.vectors[i].x;
        e.vectors(1, i) = found.vectors[i].y;
        e.vectors(2, i) = found.vectors[i].z;
    }
    return true;
}

}  // namespace detail

/// The same of a 3x3 matrix, and faster if it is one of second moments whose
/// smallest eigenvalue stands apart.
[[nodiscard]] inline eigen_decomposition symmetric_eigen(const Eigen::Matrix3d& a) {
    if (eigen_decomposition e; detail::decompose_if_separated(a, e)) return e;
    square_array<3> rows;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) rows[i][j] = a.data()[3 * j + i];
    }
    const auto small = symmetric_eigen<3>(rows);
    eigen_decomposition e;
    for (std::size_t i = 0; i < 3; ++i) {
        e.values.data()[i] = small.values[i];
        for (std::size_t j = 0; j < 3; ++j) e.vectors.data()[3 * j + i] = small.vectors[i][j];
    }
    return e;
}

namespace detail {

/// Whether the eigenvectors of second moments can be asked for: their trace is a sum of squares, in
/// which whatever is not finite shows.
[[nodiscard]] inline bool has_finite_trace(const Eigen::Matrix3d& m) {
    return std::isfinite(m(0, 0) + m(1, 1) + m(2, 2));
}

}  // namespace detail

}  // namespace gnomon

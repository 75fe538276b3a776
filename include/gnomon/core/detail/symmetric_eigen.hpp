// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a symmetric 3x3 matrix. Covariances of flat neighborhoods take a
/// fast path, Newton's method for the smallest eigenvalue (detail/separated_eigen.hpp); all others
/// take cyclic Jacobi rotations (detail/jacobi_eigen.hpp). Both are backward stable: a perfect
/// plane, a line, a ball and the zero matrix are ordinary inputs.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/jacobi_eigen.hpp>
#include <gnomon/core/detail/separated_eigen.hpp>
#include <gnomon/core/detail/square_array.hpp>

namespace gnomon::detail {

/// A = V diag(values) V^T with values in descending order and orthonormal columns of V.
struct eigen_decomposition {
    Eigen::Vector3d values;   ///< eigenvalues, descending
    Eigen::Matrix3d vectors;  ///< unit eigenvectors in columns, in the order of the values
};

/// Decomposes a matrix of second moments whose smallest eigenvalue is well separated.
/// @return false if it is not, or if the matrix is too large or too small; `e` is then unspecified
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

/// Decomposes the symmetric matrix `a`. Precondition: all entries are finite.
///
/// Eigenvectors are accurate to a few eps / gap, where gap is the distance to the nearest other
/// eigenvalue relative to the largest. A multiple eigenvalue gets some orthonormal basis of its
/// eigenspace. The signs of the eigenvectors are arbitrary but deterministic. O(1).
[[nodiscard]] inline eigen_decomposition symmetric_eigen(const Eigen::Matrix3d& a) {
    if (eigen_decomposition e; decompose_if_separated(a, e)) return e;
    square_array<3> rows;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) rows[i][j] = a.data()[3 * j + i];
    }
    const auto small = jacobi_eigen<3>(rows);
    eigen_decomposition e;
    for (std::size_t i = 0; i < 3; ++i) {
        e.values.data()[i] = small.values[i];
        for (std::size_t j = 0; j < 3; ++j) e.vectors.data()[3 * j + i] = small.vectors[i][j];
    }
    return e;
}

/// Returns whether all entries of a matrix of second moments are finite. Its trace is a sum of
/// squares and bounds every entry, so the trace is sufficient.
[[nodiscard]] inline bool has_finite_trace(const Eigen::Matrix3d& m) {
    return std::isfinite(m(0, 0) + m(1, 1) + m(2, 2));
}

}  // namespace gnomon::detail

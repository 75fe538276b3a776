// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a symmetric 3x3 matrix by cyclic Jacobi rotations (Golub and
/// Van Loan, Matrix Computations, Sec. 8.5): backward stable for every rank and every multiplicity,
/// where closed forms lose half the digits at near-equal eigenvalues. A perfect plane, a line, a
/// ball and the zero matrix are ordinary inputs.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

namespace gnomon {

/// A = V diag(values) V^T with values in descending order and orthonormal columns of V.
struct eigen_decomposition {
    Eigen::Vector3d values;
    Eigen::Matrix3d vectors;
};

namespace detail {

/// One Jacobi rotation: makes a(p,q) zero and turns v along.
inline void rotate_away(Eigen::Matrix3d& a, Eigen::Matrix3d& v, int p, int q) {
    if (a(p, q) == 0.0) return;
    const double theta = (a(q, q) - a(p, p)) / (2.0 * a(p, q));
    // A theta whose square overflows gives t = 0, which is right to the last bit.
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(1.0 + theta * theta));
    const double c = 1.0 / std::sqrt(1.0 + t * t);
    const double s = t * c;
    a(p, p) -= t * a(p, q);
    a(q, q) += t * a(p, q);
    a(p, q) = a(q, p) = 0.0;
    const int r = 3 - p - q;
    const double rp = a(r, p);
    const double rq = a(r, q);
    a(r, p) = a(p, r) = c * rp - s * rq;
    a(r, q) = a(q, r) = s * rp + c * rq;
    for (int i = 0; i < 3; ++i) {
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
/// at most five sweeps in our tests.
[[nodiscard]] inline eigen_decomposition symmetric_eigen(const Eigen::Matrix3d& a) {
    eigen_decomposition e{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
    double scale = 0.0;  // brought to one, so that no square below over- or underflows
    for (int i = 0; i < 9; ++i) scale = std::max(scale, std::abs(a.data()[i]));
    if (scale < std::numeric_limits<double>::min()) return e;
    Eigen::Matrix3d d;
    for (int i = 0; i < 9; ++i) d.data()[i] = a.data()[i] / scale;

    constexpr double negligible = std::numeric_limits<double>::epsilon() / 64;
    constexpr int max_sweeps = 12;
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
        if (std::abs(d(0, 1)) + std::abs(d(0, 2)) + std::abs(d(1, 2)) < negligible) break;
        detail::rotate_away(d, e.vectors, 0, 1);
        detail::rotate_away(d, e.vectors, 0, 2);
        detail::rotate_away(d, e.vectors, 1, 2);
    }

    for (int i = 0; i < 3; ++i) e.values[i] = scale * d(i, i);
    const auto order = [&e](int i, int j) {
        if (e.values[i] >= e.values[j]) return;
        std::swap(e.values[i], e.values[j]);
        for (int r = 0; r < 3; ++r) std::swap(e.vectors(r, i), e.vectors(r, j));
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return e;
}

}  // namespace gnomon

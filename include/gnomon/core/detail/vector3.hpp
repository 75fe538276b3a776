// SPDX-License-Identifier: BSL-1.0
/// @file
/// Operations on 3-vectors and 3x3 matrices, written out by coordinates. Each Eigen expression of a
/// new form in a header adds about 50 ms to the compile time of every including file.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::detail {

/// a . b
[[nodiscard]] inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The Euclidean norm of a.
[[nodiscard]] inline double length(const Eigen::Vector3d& a) { return std::sqrt(dot(a, a)); }

/// a - b
[[nodiscard]] inline Eigen::Vector3d difference(const Eigen::Vector3d& a,
                                                const Eigen::Vector3d& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// a x b
[[nodiscard]] inline Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The power of two that scales x > 0 to [1/2, 1), at most 2^1000. Multiplication by it is exact.
[[nodiscard]] inline double power_to_one(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, -std::max(exponent, -1000));
}

/// s a
[[nodiscard]] inline Eigen::Vector3d scaled(double s, const Eigen::Vector3d& a) {
    return {s * a[0], s * a[1], s * a[2]};
}

/// s a + t b
[[nodiscard]] inline Eigen::Vector3d combined(double s, const Eigen::Vector3d& a, double t,
                                              const Eigen::Vector3d& b) {
    return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

/// s a + t b + u c
[[nodiscard]] inline Eigen::Vector3d combined(double s, const Eigen::Vector3d& a, double t,
                                              const Eigen::Vector3d& b, double u,
                                              const Eigen::Vector3d& c) {
    return combined(1.0, combined(s, a, t, b), u, c);
}

/// Returns whether the squared norm of a neither over- nor underflows.
[[nodiscard]] inline bool has_length(const Eigen::Vector3d& a) { return std::isnormal(dot(a, a)); }

/// The unit vector along a, also if the squares of its coordinates over- or underflow.
/// Precondition: a is finite and not zero.
[[nodiscard]] inline Eigen::Vector3d direction_of(const Eigen::Vector3d& a) {
    Eigen::Vector3d b = a;
    if (!has_length(a)) {
        const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
        b = scaled(power_to_one(largest), a);
    }
    const double size = length(b);
    return {b[0] / size, b[1] / size, b[2] / size};
}

/// M a
[[nodiscard]] inline Eigen::Vector3d product(const Eigen::Matrix3d& m, const Eigen::Vector3d& a) {
    Eigen::Vector3d r;
    for (int i = 0; i < 3; ++i) r[i] = m(i, 0) * a[0] + m(i, 1) * a[1] + m(i, 2) * a[2];
    return r;
}

/// Returns whether no entry is NaN or infinite.
[[nodiscard]] inline bool all_finite(const Eigen::Vector3d& a) {
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}
[[nodiscard]] inline bool all_finite(const Eigen::Matrix3d& m) {
    for (int i = 0; i < 9; ++i)
        if (!std::isfinite(m.data()[i])) return false;
    return true;
}

/// The matrix with the diagonal a, b, c.
[[nodiscard]] inline Eigen::Matrix3d diagonal(double a, double b, double c) {
    Eigen::Matrix3d m;
    std::fill_n(m.data(), 9, 0.0);
    m(0, 0) = a;
    m(1, 1) = b;
    m(2, 2) = c;
    return m;
}

/// The inverse of a symmetric matrix by cofactors; entries are not finite if it is singular.
[[nodiscard]] inline Eigen::Matrix3d inverse_of_symmetric(const Eigen::Matrix3d& m) {
    Eigen::Matrix3d inverse;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            inverse(i, j) = m(a, c) * m(b, d) - m(a, d) * m(b, c);
        }
    }
    const double determinant =
        m(0, 0) * inverse(0, 0) + m(0, 1) * inverse(0, 1) + m(0, 2) * inverse(0, 2);
    for (int i = 0; i < 9; ++i) inverse.data()[i] /= determinant;
    return inverse;
}

/// Column j of M.
[[nodiscard]] inline Eigen::Vector3d column(const Eigen::Matrix3d& m, int j) {
    return {m(0, j), m(1, j), m(2, j)};
}

/// The matrix with the columns a, b, c.
[[nodiscard]] inline Eigen::Matrix3d from_columns(const Eigen::Vector3d& a,
                                                  const Eigen::Vector3d& b,
                                                  const Eigen::Vector3d& c) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) {
        m(i, 0) = a[i];
        m(i, 1) = b[i];
        m(i, 2) = c[i];
    }
    return m;
}

/// M += s a b^T
inline void add_outer(Eigen::Matrix3d& m, double s, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b) {
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) m(i, j) += s * a[i] * b[j];
    }
}

/// A unit vector orthogonal to the unit vector n.
[[nodiscard]] inline Eigen::Vector3d orthogonal(const Eigen::Vector3d& n) {
    // The projection of the coordinate axis at the largest angle to n.
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (std::abs(n[i]) < std::abs(n[axis])) axis = i;
    }
    Eigen::Vector3d e(-n[axis] * n[0], -n[axis] * n[1], -n[axis] * n[2]);
    e[axis] += 1.0;
    return scaled(1.0 / length(e), e);
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvalues and eigenvectors of a symmetric 3x3 matrix whose smallest eigenvalue is well
/// separated from the others, as that of the covariance of a surface patch is. Faster than Jacobi
/// rotations and as accurate. The algorithm has no branches but early exits, so the number type can
/// be a vector of numbers, one for each of several matrices.
///
/// Newton's method on the characteristic polynomial converges to the smallest eigenvalue x from
/// below. The columns of the adjugate of A - x I are multiples of its eigenvector v. The Rayleigh
/// quotient v^T A v then improves x quadratically, so two rounds reach rounding error. The other
/// two eigenvalues are those of the 2x2 matrix of A in the plane orthogonal to v. `is_accurate`
/// decides by the residual A v - x v.
#pragma once

#include <cstddef>
#include <type_traits>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/pack.hpp>

namespace gnomon::detail {

// The operations of `pack`, for a single number.
inline double root(double x) { return std::sqrt(x); }
inline double magnitude(double x) { return std::abs(x); }
/// a if x >= y, else b.
inline double where_at_least(double x, double y, double a, double b) { return x >= y ? a : b; }
/// Returns whether an iteration can stop because |rest| <= limit. Packs run all iterations.
inline bool is_settled(double rest, double limit) { return std::abs(rest) <= limit; }
inline bool is_settled(const pack&, double) { return false; }

/// A 3-vector of numbers of type T.
template <class T>
struct triple {
    T x, y, z;
};

/// The inner product a . b.
template <class T>
[[nodiscard]] T inner(const triple<T>& a, const triple<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A symmetric matrix [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] of trace one.
template <class T>
struct symmetric_3x3 {
    T xx, yy, zz, xy, xz, yz;

    /// The product of the matrix and v.
    [[nodiscard]] triple<T> times(const triple<T>& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
};

/// The eigenvalues and unit eigenvectors of a `symmetric_3x3`. Valid if `is_accurate`.
template <class T>
struct separated_eigen {
    T values[3];           ///< eigenvalues, descending
    triple<T> vectors[3];  ///< unit eigenvectors in the order of the values
    T squared_residual;    ///< |A v - x v|^2 of the smallest eigenvalue x

    explicit separated_eigen(const symmetric_3x3<T>& a) {
        T x = smallest_root(a);
        triple<T>& v = vectors[2];
        for (int round = 0; round < rounds; ++round) {
            v = null_vector(a, x);
            const triple<T> p = a.times(v);
            x = inner(v, p);
            const triple<T> r{p.x - x * v.x, p.y - x * v.y, p.z - x * v.z};
            squared_residual = inner(r, r);
            if (is_settled(squared_residual, settled_residual)) break;
        }
        values[2] = x;
        decompose_across(a);
    }

  private:
    // Iterations: performance only, since `is_accurate` rejects what has not converged. A single
    // matrix stops early and then affords more rounds for elongated neighborhoods.
    static constexpr bool one = std::is_same_v<T, double>;
    static constexpr int newton_steps = one ? 6 : 8;
    static constexpr int rounds = one ? 4 : 2;
    static constexpr double settled_step = 1e-6;       // one quadratic step from rounding error
    static constexpr double settled_residual = 1e-31;  // squared; below that of `is_accurate`

    /// The smallest root of the characteristic polynomial x^3 - x^2 + c1 x - c0, by Newton's method
    /// from a lower bound of all roots.
    static T smallest_root(const symmetric_3x3<T>& a) {
        const T c1 =
            a.xx * a.yy + a.yy * a.zz + a.zz * a.xx - a.xy * a.xy - a.xz * a.xz - a.yz * a.yz;
        const T c0 = a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
                     a.xz * (a.xy * a.yz - a.yy * a.xz);
        T x = 1.0 / 3.0 - 2.0 * root(magnitude(T(1.0 / 9.0 - c1 / 3.0)));
        for (int i = 0; i < newton_steps; ++i) {
            const T value = ((x - 1.0) * x + c1) * x - c0;
            const T slope = (3.0 * x - 2.0) * x + c1;
            const T step = value / slope;
            x = x - step;
            if (is_settled(step, settled_step)) break;
        }
        return x;
    }

    /// The unit vector v with (A - x I) v nearly zero. The adjugate of A - x I is a multiple of
    /// v v^T; v is its column with the largest diagonal entry, normalized.
    static triple<T> null_vector(const symmetric_3x3<T>& a, const T& x) {
        const T ax = a.xx - x, ay = a.yy - x, az = a.zz - x;
        const T xx = ay * az - a.yz * a.yz, yy = ax * az - a.xz * a.xz, zz = ax * ay - a.xy * a.xy;
        const T xy = a.xz * a.yz - a.xy * az, xz = a.xy * a.yz - a.xz * ay,
                yz = a.xy * a.xz - ax * a.yz;
        const T xx_or_yy = where_at_least(xx, yy, xx, yy);
        triple<T> v{where_at_least(xx, yy, xx, xy), where_at_least(xx, yy, xy, yy),
                    where_at_least(xx, yy, xz, yz)};
        v = {where_at_least(xx_or_yy, zz, v.x, xz), where_at_least(xx_or_yy, zz, v.y, yz),
             where_at_least(xx_or_yy, zz, v.z, zz)};
        const T norm = 1.0 / root(inner(v, v));
        return {v.x * norm, v.y * norm, v.z * norm};
    }

    /// The other two eigenvalues and eigenvectors, in an orthonormal basis u, w of the plane
    /// orthogonal to v (T. Duff et al., Building an orthonormal basis, revisited, 2017).
    void decompose_across(const symmetric_3x3<T>& a) {
        const triple<T>& v = vectors[2];
        const T zero = T(v.z * 0.0);
        const T sign = where_at_least(v.z, zero, T(zero + 1.0), T(zero - 1.0));
        const T f = -1.0 / (sign + v.z), g = v.x * v.y * f;
        const triple<T> u{1.0 + sign * v.x * v.x * f, sign * g, -sign * v.x};
        const triple<T> w{g, sign + v.y * v.y * f, -v.y};
        const triple<T> au = a.times(u);
        const T uu = inner(u, au), uw = inner(w, au), ww = inner(w, a.times(w));
        const T half = 0.5 * (uu - ww), radius = root(T(half * half + uw * uw));
        values[0] = 0.5 * (uu + ww) + radius;
        values[1] = 0.5 * (uu + ww) - radius;
        // (c, s) is the direction at half the angle of (half, uw), without cancellation; (1, 0) if
        // both are zero.
        const T tiny = T(zero + 1e-300);
        const T t = magnitude(half) + radius + tiny;
        const T norm = 1.0 / root(T(t * t + uw * uw) + tiny);
        const T along = where_at_least(half, zero, t, magnitude(uw));
        const T across = where_at_least(half, zero, uw, where_at_least(uw, zero, t, T(-t)));
        const T c = where_at_least(radius, tiny, T(along * norm), T(zero + 1.0));
        const T s = where_at_least(radius, tiny, T(across * norm), zero);
        vectors[0] = {c * u.x + s * w.x, c * u.y + s * w.y, c * u.z + s * w.z};
        vectors[1] = {c * w.x - s * u.x, c * w.y - s * u.y, c * w.z - s * u.z};
    }
};

/// Returns whether a decomposition of a matrix of trace one is as accurate as Jacobi rotations
/// would make it. False if the smallest eigenvalue is not well separated, and for NaN.
[[nodiscard]] inline bool is_accurate(double middle, double smallest, double squared_residual) {
    constexpr double min_gap = 1e-4;  // eigenvector error about residual / gap, at most 1e-11
    constexpr double max_squared_residual = 1e-30;  // some rounding errors of numbers up to 1
    return middle - smallest > min_gap && squared_residual < max_squared_residual;
}

/// Returns whether a matrix of this trace can be scaled to trace one without over- or underflow.
[[nodiscard]] inline bool has_scale(double trace) { return trace > 1e-290 && trace < 1e290; }

}  // namespace gnomon::detail

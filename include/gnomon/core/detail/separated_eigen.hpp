// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvectors of symmetric 3x3 matrices whose smallest eigenvalue stands apart from the others,
/// as that of a neighborhood on a surface does: faster than rotations, and as accurate. No step
/// depends on a comparison, but for leaving early, so that the number type may as well be a vector
/// of numbers, one for each of several matrices.
///
/// Newton's method finds the eigenvalue from below. The columns of the adjugate of A - x I are
/// multiples of its eigenvector v, and v^T A v is a far better eigenvalue, so that two rounds reach
/// the last bit. In the plane across v, the other two are a 2x2 problem. Whether all went well, the
/// residual A v - x v tells.
#pragma once

#include <cstddef>
#include <type_traits>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/pack.hpp>

namespace gnomon::detail {

inline double root(double x) { return std::sqrt(x); }
inline double magnitude(double x) { return std::abs(x); }
/// a where x >= y, and b elsewhere.
inline double where_at_least(double x, double y, double a, double b) { return x >= y ? a : b; }
/// Whether no more steps are needed: of several numbers that is not asked.
inline bool is_settled(double rest, double limit) { return std::abs(rest) <= limit; }
inline bool is_settled(const pack&, double) { return false; }

/// A vector whose coordinates are T.
template <class T>
struct triple {
    T x, y, z;
};

template <class T>
[[nodiscard]] T inner(const triple<T>& a, const triple<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The symmetric matrices [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], of which `trace` is one.
template <class T>
struct symmetric_3x3 {
    T xx, yy, zz, xy, xz, yz;

    [[nodiscard]] triple<T> times(const triple<T>& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
};

/// Eigenvalues, descending, and eigenvectors of such matrices.
template <class T>
struct separated_eigen {
    T values[3];
    triple<T> vectors[3];
    T squared_residual;  ///< of the smallest

    explicit separated_eigen(const symmetric_3x3<T>& a) {
        T x = smallest_root(a);
        triple<T>& v = vectors[2];
        for (int round = 0; round < rounds; ++round) {
            v = null_vector(a, x);
            const triple<T> p = a.times(v);
            x = inner(v, p);
            const triple<T> r{p.x - x * v.x, p.y - x * v.y, p.z - x * v.z};
            squared_residual = inner(r, r);
            if (is_settled(squared_residual, 1e-31)) break;
        }
        values[2] = x;
        decompose_across(a);
    }

  private:
    static constexpr bool one = std::is_same_v<T, double>;
    static constexpr int newton_steps = one ? 6 : 8;
    static constexpr int rounds = one ? 4 : 2;

    /// The smallest root of x^3 - x^2 + c1 x - c0, from where all are above.
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
            if (is_settled(step, 1e-6)) break;
        }
        return x;
    }

    /// A unit vector that A - x I all but annihilates: of the columns of the adjugate, which is
    /// v v^T but for a factor, the one with the largest element on the diagonal.
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

    /// The other two, in an orthonormal basis u, w of the plane across v (Duff et al. 2017).
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
        // Half the angle of (half, uw), without loss of digits; none if they are zero.
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

/// Whether eigenvalues and residual, of a matrix of trace one, are as good as rotations would make
/// them: not if the smallest does not stand apart, nor for NaN.
[[nodiscard]] inline bool is_accurate(double middle, double smallest, double squared_residual) {
    return middle - smallest > 1e-4 && squared_residual < 1e-30;
}

/// Whether a matrix of this trace can be brought to trace one.
[[nodiscard]] inline bool has_scale(double trace) { return trace > 1e-290 && trace < 1e290; }

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Eigenvectors of a symmetric 3x3 matrix whose smallest eigenvalue stands apart from the others,
/// as that of a neighborhood on a surface does: three times as fast as rotations, and as accurate.
///
/// Newton's method finds the eigenvalue from below. The columns of the adjugate of A - x I are
/// multiples of its eigenvector v, and v^T A v is a far better eigenvalue, so that two or three
/// rounds reach the last bit. In the plane across v, the other two are a 2x2 problem. Whether all
/// went well, the residual A v - x v tells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

namespace gnomon::detail {

/// The eigenvalues, descending, and the eigenvectors of a symmetric matrix [[xx, xy, xz], [xy, yy,
/// yz], [xz, yz, zz]], in columns.
struct separated_eigen {
    Eigen::Vector3d values;
    Eigen::Matrix3d vectors;

    /// @return whether they were found: else the smallest eigenvalue is too near to the next one,
    ///         or the matrix is not one of second moments
    [[nodiscard]] bool decompose(const Eigen::Matrix3d& m) {
        const double trace = m(0, 0) + m(1, 1) + m(2, 2);
        if (!(trace > 1e-290 && trace < 1e290)) return false;
        const double s = 1.0 / trace;
        const double xx = s * m(0, 0), yy = s * m(1, 1), zz = s * m(2, 2);
        const double xy = s * m(1, 0), xz = s * m(2, 0), yz = s * m(2, 1);

        // det(x I - A) = x^3 - x^2 + c1 x - c0, which has no root below 1/3 - 2 p.
        const double c1 = xx * yy + yy * zz + zz * xx - xy * xy - xz * xz - yz * yz;
        const double c0 =
            xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        double x = 1.0 / 3.0 - 2.0 * std::sqrt(std::max(0.0, 1.0 / 9.0 - c1 / 3.0));
        for (int i = 0; i < 6; ++i) {
            const double step = (((x - 1.0) * x + c1) * x - c0) / ((3.0 * x - 2.0) * x + c1);
            x -= step;
            if (!(std::abs(step) > 1e-6)) break;
        }

        double vx = 0.0, vy = 0.0, vz = 0.0;
        for (int i = 0;; ++i) {
            const double ax = xx - x, ay = yy - x, az = zz - x;
            const double mx = ay * az - yz * yz, my = ax * az - xz * xz, mz = ax * ay - xy * xy;
            const double mxy = xz * yz - xy * az, mxz = xy * yz - xz * ay, myz = xy * xz - ax * yz;
            if (mx >= my && mx >= mz)
                vx = mx, vy = mxy, vz = mxz;
            else if (my >= mz)
                vx = mxy, vy = my, vz = myz;
            else
                vx = mxz, vy = myz, vz = mz;
            const double norm = 1.0 / std::sqrt(vx * vx + vy * vy + vz * vz);
            vx *= norm, vy *= norm, vz *= norm;
            const double px = xx * vx + xy * vy + xz * vz, py = xy * vx + yy * vy + yz * vz,
                         pz = xz * vx + yz * vy + zz * vz;
            x = vx * px + vy * py + vz * pz;
            const double rx = px - x * vx, ry = py - x * vy, rz = pz - x * vz;
            if (rx * rx + ry * ry + rz * rz < 1e-30) break;
            if (i == 3) return false;
        }
        span(vx, vy, vz);
        decompose_across(xx, yy, zz, xy, xz, yz);
        const bool apart = values[1] - x > 1e-4;
        values = {trace * values[0], trace * values[1], trace * x};
        return apart;
    }

  private:
    /// Completes the unit vector v to an orthonormal basis (Duff et al. 2017).
    void span(double vx, double vy, double vz) {
        const double sign = std::copysign(1.0, vz);
        const double a = -1.0 / (sign + vz), b = vx * vy * a;
        vectors(0, 0) = 1.0 + sign * vx * vx * a;
        vectors(1, 0) = sign * b;
        vectors(2, 0) = -sign * vx;
        vectors(0, 1) = b;
        vectors(1, 1) = sign + vy * vy * a;
        vectors(2, 1) = -vy;
        vectors(0, 2) = vx;
        vectors(1, 2) = vy;
        vectors(2, 2) = vz;
    }

    /// Turns the first two vectors of the basis to the eigenvectors.
    void decompose_across(double xx, double yy, double zz, double xy, double xz, double yz) {
        std::array<double, 3> u{}, w{};
        for (int i = 0; i < 3; ++i) {
            u[static_cast<std::size_t>(i)] = vectors(i, 0);
            w[static_cast<std::size_t>(i)] = vectors(i, 1);
        }
        const double ux = xx * u[0] + xy * u[1] + xz * u[2], uy = xy * u[0] + yy * u[1] + yz * u[2],
                     uz = xz * u[0] + yz * u[1] + zz * u[2];
        const double wx = xx * w[0] + xy * w[1] + xz * w[2], wy = xy * w[0] + yy * w[1] + yz * w[2],
                     wz = xz * w[0] + yz * w[1] + zz * w[2];
        const double uu = u[0] * ux + u[1] * uy + u[2] * uz;
        const double uw = w[0] * ux + w[1] * uy + w[2] * uz;
        const double ww = w[0] * wx + w[1] * wy + w[2] * wz;
        const double half = 0.5 * (uu - ww), radius = std::sqrt(half * half + uw * uw);
        values[0] = 0.5 * (uu + ww) + radius;
        values[1] = 0.5 * (uu + ww) - radius;
        if (!(radius > 0.0)) return;
        // Half the angle of (half, uw), without loss of digits.
        const double t = std::abs(half) + radius, norm = 1.0 / std::sqrt(t * t + uw * uw);
        const double c = half >= 0.0 ? t * norm : std::abs(uw) * norm;
        const double s = half >= 0.0 ? uw * norm : std::copysign(t * norm, uw);
        for (int i = 0; i < 3; ++i) {
            const auto a = static_cast<std::size_t>(i);
            vectors(i, 0) = c * u[a] + s * w[a];
            vectors(i, 1) = c * w[a] - s * u[a];
        }
    }
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Coordinates of directions near a unit normal: an orthonormal basis of the tangent plane, the
/// exponential and the logarithm of the unit sphere, and symmetric matrices of the tangent plane.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>

namespace gnomon::detail {

/// A symmetric 2 x 2 matrix in the coordinates (b1, b2) of a tangent basis.
struct tangent_matrix {
    double p11, p12, p22;

    /// x^2 p11 + 2 x y p12 + y^2 p22
    [[nodiscard]] double along(double x, double y) const {
        return x * x * p11 + 2.0 * x * y * p12 + y * y * p22;
    }
    /// Adds the outer product of (x, y) with itself, times a weight.
    void add(double weight, double x, double y) {
        p11 += weight * x * x;
        p12 += weight * x * y;
        p22 += weight * y * y;
    }
};

/// A unit normal and an orthonormal basis (b1, b2) of its tangent plane.
struct tangent_basis {
    Eigen::Vector3d normal, b1, b2;

    explicit tangent_basis(const Eigen::Vector3d& n)
        : normal(n), b1(orthogonal(n)), b2(cross(n, b1)) {}

    /// The basis at n that is rotated least against a nearby one, so that coordinates keep their
    /// meaning.
    tangent_basis(const Eigen::Vector3d& n, const tangent_basis& nearby) : normal(n) {
        const Eigen::Vector3d e = combined(1.0, nearby.b1, -dot(n, nearby.b1), n);
        b1 = scaled(1.0 / length(e), e);
        b2 = cross(n, b1);
    }

    /// The exponential map: the normal rotated by the angles (d1, d2) [rad].
    [[nodiscard]] Eigen::Vector3d moved(double d1, double d2) const {
        const double angle = std::hypot(d1, d2);
        if (angle == 0.0) return normal;
        const double s = std::sin(angle) / angle;
        return combined(std::cos(angle), normal, s * d1, b1, s * d2, b2);
    }

    /// The logarithm map: the rotation (d1, d2, 0) [rad] from the normal to n or -n, whichever is
    /// nearer.
    [[nodiscard]] Eigen::Vector3d towards(const Eigen::Vector3d& n) const {
        const double along = dot(n, normal);
        const double x = dot(n, b1);
        const double y = dot(n, b2);
        const double across = std::hypot(x, y);
        if (across == 0.0) return {0.0, 0.0, 0.0};
        const double s = std::copysign(std::atan2(across, std::abs(along)) / across, along);
        return {s * x, s * y, 0.0};
    }

    /// The restriction of a symmetric 3 x 3 matrix to the tangent plane.
    [[nodiscard]] tangent_matrix restricted(const Eigen::Matrix3d& m) const {
        const Eigen::Vector3d m1 = product(m, b1);
        return {dot(b1, m1), dot(b2, m1), dot(b2, product(m, b2))};
    }

    /// The 3 x 3 matrix of a matrix of the tangent plane; the normal is in its null space.
    [[nodiscard]] Eigen::Matrix3d in_space(const tangent_matrix& p) const {
        Eigen::Matrix3d m = diagonal(0.0, 0.0, 0.0);
        add_outer(m, p.p11, b1, b1);
        add_outer(m, p.p12, b1, b2);
        add_outer(m, p.p12, b2, b1);
        add_outer(m, p.p22, b2, b2);
        return m;
    }
};

}  // namespace gnomon::detail

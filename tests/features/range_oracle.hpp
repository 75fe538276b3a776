// SPDX-License-Identifier: BSL-1.0
/// @file
/// The sum of squared residuals in ranges as the literature defines it, from the quadratic equation
/// of the ray and the surface in global parameters, minimized by Eigen's implementation of
/// MINPACK's lmder with differences for derivatives.
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "features/round_samples.hpp"
#include <gnomon/features/fit_cone.hpp>
#include <gnomon/features/fit_cylinder.hpp>
#include <gnomon/features/fit_sphere.hpp>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace range_oracle {

/// The surface x^T M x + ... = 0 in the form |d|^2 - (d.a)^2 (1 + t^2) - 2 t r (d.a) - r^2 = 0 for
/// d = x - c: a cone or cylinder about the axis a with the radius r + t (d.a); a sphere with a = 0.
struct quadric {
    Eigen::Vector3d c, a;
    double r, t;

    /// The smaller range at which a ray meets it.
    [[nodiscard]] double range(const Eigen::Vector3d& eye, const Eigen::Vector3d& u) const {
        const Eigen::Vector3d d = eye - c;
        const double k = 1.0 + t * t, da = d.dot(a), ua = u.dot(a);
        const double qa = u.dot(u) - k * ua * ua;
        const double qb = d.dot(u) - k * da * ua - t * r * ua;
        const double qc = d.dot(d) - k * da * da - 2.0 * t * r * da - r * r;
        return (-qb - std::sqrt(qb * qb - qa * qc)) / qa;
    }
};

inline quadric quadric_of(const gnomon::sphere_estimate& e, const Eigen::VectorXd& x) {
    return {e.center + x.head<3>(), {0, 0, 0}, e.radius + x[3], 0.0};
}
inline quadric quadric_about_axis(const auto& e, const Eigen::VectorXd& x) {
    const Eigen::Vector3d c = e.axis_point + x[0] * e.axes.col(0) + x[1] * e.axes.col(1);
    const Eigen::Vector3d a = e.direction() + x[2] * e.axes.col(0) + x[3] * e.axes.col(1);
    return {c, a.normalized(), e.radius + x[4], 0.0};
}
inline quadric quadric_of(const gnomon::cylinder_estimate& e, const Eigen::VectorXd& x) {
    return quadric_about_axis(e, x);
}
inline quadric quadric_of(const gnomon::cone_estimate& e, const Eigen::VectorXd& x) {
    quadric q = quadric_about_axis(e, x);
    q.t = std::tan(e.half_angle.radians() + x[5]);
    return q;
}

template <class Estimate>
struct residuals {
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    const Estimate& e;
    const round_samples::sample& s;
    double sigma;
    Eigen::VectorXd deviations;

    /// Differences take steps relative to a variable: 0 in the parameters is 10 here.
    static constexpr double origin = 10.0;

    [[nodiscard]] int inputs() const { return static_cast<int>(e.covariance.rows()); }
    [[nodiscard]] int values() const { return static_cast<int>(s.points.size()); }
    int operator()(const Eigen::VectorXd& y, Eigen::VectorXd& f) const {
        const Eigen::VectorXd x = deviations.array() * (y.array() - origin);
        const quadric q = quadric_of(e, x);
        for (int i = 0; i < values(); ++i) {
            const Eigen::Vector3d way = s.points[static_cast<std::size_t>(i)] - s.viewpoint;
            f[i] = (way.norm() - q.range(s.viewpoint, way.normalized())) / sigma;
        }
        return 0;
    }
};

/// The minimum is at the estimate, its value is chi-square, and the inverse of J^T J there is the
/// covariance.
template <class Estimate>
void expect_minimum(const Estimate& e, const round_samples::sample& s, double sigma) {
    using system = Eigen::NumericalDiff<residuals<Estimate>, Eigen::Central>;
    const Eigen::MatrixXd c = e.covariance;
    const Eigen::VectorXd deviations = c.diagonal().cwiseSqrt();
    system f(residuals<Estimate>{e, s, sigma, deviations});
    const Eigen::VectorXd solution = Eigen::VectorXd::Constant(c.rows(), f.origin);
    Eigen::VectorXd y = solution.array() + 0.5;  // the start: half a deviation from it
    Eigen::LevenbergMarquardt<system> minimizer(f);
    minimizer.parameters.ftol = minimizer.parameters.xtol = 1e-14;
    minimizer.minimize(y);
    EXPECT_LT((y - solution).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_NEAR(minimizer.fvec.squaredNorm(), e.chi_square, 1e-8 * e.chi_square);
    Eigen::MatrixXd j(f.values(), f.inputs());
    f.df(solution, j);
    const Eigen::MatrixXd scaled = deviations.asDiagonal().inverse() * c *
                                   deviations.asDiagonal().inverse() * (j.transpose() * j);
    EXPECT_LT((scaled - Eigen::MatrixXd::Identity(c.rows(), c.cols())).cwiseAbs().maxCoeff(), 1e-3);
}

}  // namespace range_oracle

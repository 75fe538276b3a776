// SPDX-License-Identifier: BSL-1.0
/// @file
/// Nonlinear least squares of a curved surface to points with known noise, by the method of
/// Levenberg and Marquardt: one for all surfaces of detail/curved_surfaces.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/features/detail/normal_equations.hpp>

namespace gnomon::detail {

/// A point of a regression, relative to the centroid of all of them.
struct regression_point {
    enum class residual : char { of_distance, of_range, left_out };

    Eigen::Vector3d at;
    Eigen::Vector3d ray;  ///< unit vector from its view point; zero where that is unknown
    double deviation;     ///< of its noise, along the ray or in all directions
    residual kind = residual::of_distance;

    [[nodiscard]] bool has_ray() const { return dot(ray, ray) > 0.0; }
};

/// The point of a surface that a ray meets near the point x: x + along * ray.
template <class Foot>
struct ray_crossing {
    Foot foot;
    double along = 0.0;
    double cosine = 0.0;  ///< of ray and outward normal
    bool is_found = false;

    /// By Newton's method from x, on the side of the surface that x is on. The distance from the
    /// surface is a convex function along a line, so the method converges from the second step on.
    template <class Surface>
    ray_crossing(const Surface& s, const Eigen::Vector3d& x, const Eigen::Vector3d& ray) {
        constexpr int most_steps = 12;         // performance only: quadratic convergence
        constexpr double close_enough = 1e-9;  // numerical: its square is below the rounding error
        for (int i = 0; i < most_steps && !is_found; ++i) {
            foot = s.foot_of(combined(1.0, x, along, ray));
            const double c = dot(foot.normal, ray);
            if (!(i == 0 ? c != 0.0 : c * cosine > 0.0)) return;
            cosine = c;
            const double step = foot.distance / c;
            along -= step;
            is_found = std::abs(step) < close_enough * (1.0 + std::abs(along));
        }
    }
};

/// The residual of a point and its derivatives, both divided by the deviation.
template <class Surface>
struct whitened_residual {
    std::array<double, Surface::parameters> gradient;
    double value;  ///< NaN where the ray does not meet the surface

    /// @param shown  the factor of the variance that displaces distances from a curved surface
    whitened_residual(const Surface& s, const regression_point& p, double shown) {
        if (p.kind == regression_point::residual::of_range) {
            const ray_crossing<decltype(s.foot_of(p.at))> c(s, p.at, p.ray);
            value = c.is_found ? -c.along / p.deviation : std::numeric_limits<double>::quiet_NaN();
            gradient = s.gradient(c.foot);
            for (double& g : gradient) g /= c.cosine * p.deviation;
        } else {
            // E|x| = R + sigma^2 / 2 (k1 + k2) + ..., which no longer holds for large curvature.
            constexpr double most_bend = 0.3;  // numerical: of sigma times the curvature
            const auto foot = s.foot_of(p.at);
            const double bend = std::min(foot.curvature * p.deviation, most_bend);
            value = foot.distance / p.deviation - 0.5 * shown * bend;
            gradient = s.gradient(foot);
            for (double& g : gradient) g /= p.deviation;
        }
    }
};

/// A surface with the normal equations of the points about it.
template <class Surface>
struct fitted_surface {
    Surface surface;
    normal_equations<Surface::parameters> equations;
    bool is_converged = false;
};

/// The least-squares regression of one kind of surface on the same points.
template <class Surface, execution X>
class surface_regression {
  public:
    using equations_type = normal_equations<Surface::parameters>;

    /// Keeps references to the points and the execution.
    surface_regression(std::span<regression_point> points, const X& run)
        : points_(points), run_(run) {}

    /// The surface of least squared distances from the points whatever their rays.
    [[nodiscard]] fitted_surface<Surface> from(const Surface& start, int most_iterations) const {
        return minimized({start, equations_of(start)}, most_iterations);
    }

    /// The surface of least squared residuals in ranges where rays are known, with the bias of
    /// distances removed elsewhere.
    /// @param start  near the result
    [[nodiscard]] fitted_surface<Surface> refined(fitted_surface<Surface> start,
                                                  int most_iterations) {
        constexpr int rounds = 2;  // the first determines which rays meet the surface
        for (int round = 0; round < rounds; ++round) {
            select(start.surface);
            start.equations = equations_of(start.surface);
            start = minimized(start, most_iterations);
        }
        return start;
    }

    /// Root mean square distance of all points.
    [[nodiscard]] double rms(const Surface& s) const {
        double squares = 0.0;
        for (const regression_point& p : points_) {
            const double d = s.foot_of(p.at).distance;
            squares += d * d;
        }
        return std::sqrt(squares / static_cast<double>(points_.size()));
    }

  private:
    /// Chooses the residual of each point, and the factor of the variance.
    void select(const Surface& s) {
        constexpr double least_cosine = 0.2;  // chosen: of rays and normals, 78 degrees
        double squares = 0.0;
        std::size_t count = 0;
        for (regression_point& p : points_) {
            if (p.has_ray()) {
                const ray_crossing<decltype(s.foot_of(p.at))> c(s, p.at, p.ray);
                p.kind = c.is_found && std::abs(c.cosine) >= least_cosine
                             ? regression_point::residual::of_range
                             : regression_point::residual::left_out;
            } else {
                const double r = whitened_residual<Surface>(s, p, shown_).value;
                squares += r * r;
                ++count;
            }
        }
        if (count > Surface::parameters)
            shown_ = std::min(1.0, squares / static_cast<double>(count - Surface::parameters));
    }

    /// Sums of fixed chunks of the points, so that they do not depend on the threads.
    [[nodiscard]] equations_type equations_of(const Surface& s) const {
        scratch<equations_type> parts(chunk_count(points_.size()));
        for_each_chunk(run_, points_.size(), [&](std::size_t begin, std::size_t end) {
            equations_type sum;
            for (std::size_t i = begin; i < end; ++i) {
                if (points_[i].kind == regression_point::residual::left_out) continue;
                const whitened_residual<Surface> r(s, points_[i], shown_);
                sum.add(r.gradient, r.value);
            }
            parts[begin / chunk_size] = sum;
        });
        equations_type all;
        for (const equations_type& part : parts) all.add(part);
        return all;
    }

    [[nodiscard]] fitted_surface<Surface> minimized(fitted_surface<Surface> at,
                                                    int most_iterations) const {
        constexpr double negligible = 1e-13;  // numerical: of a step, as the points span about one
        constexpr double unseen = 1e-15;      // numerical: of the sum of squares
        constexpr double first_damping = 1e-3, last_damping = 1e12,
                         factor = 10.0;  // Marquardt 1963
        double damping = first_damping;
        at.is_converged = false;
        if (!std::isfinite(at.equations.squares)) return at;
        scaled_equations<Surface::parameters> scaled(at.equations);
        for (int i = 0; i < most_iterations && !at.is_converged && damping < last_damping; ++i) {
            const auto step = scaled.step(damping);
            double largest = 0.0, gain = 0.0;
            for (std::size_t k = 0; k < step.size(); ++k) {
                largest = std::max(largest, std::abs(step[k]));
                gain -= step[k] * at.equations.right[k];
            }
            at.is_converged = gain <= unseen * at.equations.squares || largest <= negligible;
            const Surface next = at.surface.moved(step);
            const equations_type there = next.is_valid() ? equations_of(next) : equations_type();
            if (there.count > 0 && there.squares <= at.equations.squares) {
                at.surface = next;
                at.equations = there;
                scaled = scaled_equations<Surface::parameters>(there);
                damping /= factor * factor;
            } else {
                damping *= factor;
            }
        }
        return at;
    }

    std::span<regression_point> points_;
    const X& run_;
    double shown_ = 0.0;
};

}  // namespace gnomon::detail

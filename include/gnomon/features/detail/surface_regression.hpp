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
    Eigen::Vector3d at;
    Eigen::Vector3d ray;  ///< unit vector from its view point; zero where that is unknown
    double deviation;     ///< of its noise, along the ray or in all directions

    [[nodiscard]] bool has_ray() const { return dot(ray, ray) > 0.0; }
};

/// The residual of a point, near a surface: weight times the distance of `from` from the surface,
/// less `offset`. It has no unit and the variance 1.
struct regression_term {
    Eigen::Vector3d from;
    double weight;  ///< 0: the point is left out
    double offset = 0.0;

    /// The orthogonal distance of a point, whatever its ray.
    explicit regression_term(const regression_point& p) : from(p.at), weight(1.0 / p.deviation) {}

    /// The orthogonal distance, less the mean that noise in all directions gives it:
    /// E|x| = R + variance / 2 (k1 + k2) for principal curvatures k1 and k2.
    /// @param shown  the variance that the residuals show, in that of the noise
    template <class Surface>
    regression_term(const regression_point& p, const Surface& s, double shown)
        : regression_term(p) {
        constexpr double most_bend = 0.3;  // numerical: beyond, the series does not hold
        const double bend = s.foot_of(from).curvature * p.deviation;
        offset = 0.5 * shown * std::min(bend, most_bend);
    }

    /// The difference of the range along the ray and that of the surface, which the ray meets at
    /// the point `from`; linear in the distance of that point from surfaces near this one.
    /// @param along  from the point to where the ray meets the surface
    /// @param c      cosine of ray and outward normal there
    regression_term(const regression_point& p, double along, double c)
        : from(combined(1.0, p.at, along, p.ray)),
          weight(1.0 / (c * p.deviation)),
          offset(along / p.deviation) {}
};

/// The term of a point whose ray is known. The point where the ray meets the surface is found by
/// Newton's method, on the side of the surface that the point is on; the distance from the surface
/// is a convex function along a line, so the method converges. Left out if the ray does not meet
/// the surface, or more obliquely than at `least` cosine of ray and normal.
template <class Surface>
[[nodiscard]] regression_term term_along_ray(const regression_point& p, const Surface& s,
                                             double least) {
    constexpr int most_steps = 20;         // performance only: convergence is quadratic
    constexpr double close_enough = 1e-9;  // numerical: its square is below the rounding error
    double along = 0.0, cosine = 0.0;
    for (int i = 0; i < most_steps; ++i) {
        const auto foot = s.foot_of(combined(1.0, p.at, along, p.ray));
        const double c = dot(foot.normal, p.ray);
        if (!(i == 0 ? c != 0.0 : c * cosine > 0.0)) break;
        cosine = c;
        const double step = foot.distance / c;
        if (std::abs(step) < close_enough && std::abs(c) >= least) return {p, along - step, c};
        along -= step;
    }
    regression_term left_out(p);
    left_out.weight = 0.0;
    return left_out;
}

/// A surface with the normal equations of the points about it.
template <class Surface>
struct fitted_surface {
    Surface surface;
    normal_equations<Surface::parameters> equations;
    bool is_converged = false;
    int iterations = 0;
    double first_gain = 0.0;  ///< what the sum of squares was to lose, at the first iteration

    /// Whether that loss is none, in the variance of the residuals, or if that is less, of the
    /// noise. It is the squared distance of the parameters from the minimum, in their deviations.
    [[nodiscard]] bool is_settled(double gain) const {
        constexpr double negligible = 0.01;  // chosen: a tenth of a deviation
        const auto count = static_cast<double>(equations.count);
        return gain <= negligible * std::max(1.0, equations.squares / count);
    }

    /// Of the residuals, at most 1, which is that of the noise; 0 if it is not known.
    [[nodiscard]] double variance() const {
        const auto& [left, right, squares, count] = equations;
        if (count <= Surface::parameters) return 0.0;
        return std::min(1.0, squares / static_cast<double>(count - Surface::parameters));
    }
};

/// The least-squares regression of one kind of surface on the same points.
template <class Surface, execution X>
class surface_regression {
  public:
    static constexpr std::size_t n = Surface::parameters;

    /// Keeps references to the points and the execution.
    surface_regression(std::span<const regression_point> points, const X& run)
        : points_(points), run_(run), terms_(points.begin(), points.end()) {}

    /// The surface of least squared orthogonal distances, whatever the rays.
    [[nodiscard]] fitted_surface<Surface> from(const Surface& start, int most_iterations) const {
        fitted_surface<Surface> at{start, equations_of(start)};
        constexpr double negligible = 1e-13;  // numerical: of a step, as the points span about one
        constexpr double unseen = 1e-12;      // numerical: of the sum of squares, rounded terms
        constexpr double first_damping = 1e-3, last_damping = 1e12,
                         factor = 10.0;  // Marquardt 1963
        double damping = first_damping;
        if (!std::isfinite(at.equations.squares)) return at;
        scaled_equations<n> scaled(at.equations);
        at.first_gain = gain_of(scaled.step(0.0), at.equations);
        while (at.iterations < most_iterations && !at.is_converged && damping < last_damping) {
            ++at.iterations;
            const auto step = scaled.step(damping);
            double largest = 0.0;
            for (const double s : step) largest = std::max(largest, std::abs(s));
            const double gain = gain_of(step, at.equations);
            // Damping makes any step small: at the minimum, the whole step is.
            at.is_converged = (gain <= unseen * at.equations.squares || largest <= negligible) &&
                              at.is_settled(gain_of(scaled.step(0.0), at.equations));
            const Surface next = at.surface.moved(step);
            if (next.is_valid()) {
                const normal_equations<n> there = equations_of(next);
                if (there.squares <= at.equations.squares) {
                    at.surface = next;
                    at.equations = there;
                    scaled = scaled_equations<n>(there);
                    damping /= factor * factor;
                    continue;
                }
            }
            damping *= factor;
        }
        return at;
    }

    /// The surface of least squared residuals in ranges where rays are known, and in distances
    /// without their bias elsewhere: the fixed point of residuals about the surface that they give.
    /// Not converged if the last round began far from its minimum.
    /// @param at  a surface of least squared distances, of these points or some of them
    [[nodiscard]] fitted_surface<Surface> refined(fitted_surface<Surface> at, int most_iterations) {
        constexpr int rounds = 16;          // performance only: two to four are the rule
        constexpr int choosing_rounds = 2;  // rays at the limit would come and go without end
        for (int round = 0; round < rounds; ++round) {
            set_terms(at.surface, at.variance(), round < choosing_rounds);
            at = from(at.surface, most_iterations);
            if (at.iterations <= 1) return at;
        }
        at.is_converged = at.is_converged && at.is_settled(at.first_gain);
        return at;
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
    /// The decrease of the sum of squares that the undamped step brings to first order; a damped
    /// step brings this to twice this.
    [[nodiscard]] static double gain_of(const std::array<double, n>& step,
                                        const normal_equations<n>& e) {
        double gain = 0.0;
        for (std::size_t k = 0; k < n; ++k) gain -= step[k] * e.right[k];
        return gain;
    }

    /// The terms about a surface.
    /// @param choose  whether points may be left out or in; else, as far as possible, they stay
    void set_terms(const Surface& s, double shown, bool choose) {
        constexpr double oblique = 0.2;  // chosen: of ray and normal, 78 degrees
        const double least = choose ? oblique : 0.5 * oblique;
        for_each_chunk(run_, points_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const regression_point& p = points_[i];
                if (!p.has_ray())
                    terms_[i] = regression_term(p, s, shown);
                else if (choose || terms_[i].weight != 0.0)
                    terms_[i] = term_along_ray(p, s, least);
            }
        });
    }

    /// Sums of fixed chunks of the points, so that they do not depend on the threads.
    [[nodiscard]] normal_equations<n> equations_of(const Surface& s) const {
        scratch<normal_equations<n>> parts(chunk_count(terms_.size()));
        for_each_chunk(run_, terms_.size(), [&](std::size_t begin, std::size_t end) {
            normal_equations<n> sum;
            for (std::size_t i = begin; i < end; ++i) {
                const regression_term& t = terms_[i];
                if (t.weight == 0.0) continue;
                const auto foot = s.foot_of(t.from);
                auto gradient = s.gradient(foot);
                for (double& g : gradient) g *= t.weight;
                sum.add(gradient, t.weight * foot.distance - t.offset);
            }
            parts[begin / chunk_size] = sum;
        });
        normal_equations<n> all;
        for (const normal_equations<n>& part : parts) all.add(part);
        return all;
    }

    std::span<const regression_point> points_;
    const X& run_;
    scratch<regression_term> terms_;
};

}  // namespace gnomon::detail

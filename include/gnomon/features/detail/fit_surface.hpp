// SPDX-License-Identifier: BSL-1.0
/// @file
/// Fits a surface of detail/curved_surfaces.hpp to points of a range: reads the points, chooses the
/// best of the first values, minimizes, and tests the result.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/detail/curved_surfaces.hpp>
#include <gnomon/features/detail/surface_regression.hpp>
#include <gnomon/features/detail/surface_start.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/features/surface_fit.hpp>

namespace gnomon::detail {

/// The finite points of a regression, in lengths of `1 / per_metre` about their centroid.
struct regression_cloud {
    scratch<regression_point> points;
    scratch<oriented_sample> samples;          ///< of about 300 of the points at most
    scratch<regression_point> sampled_points;  ///< the same points
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};   ///< [m]
    double per_metre = 1.0;                    ///< a power of two: multiplication by it is exact
    std::size_t finite = 0;                    ///< number of finite points
    bool has_volume = false;                   ///< they are not coplanar

    /// A length [m], and a position [m].
    [[nodiscard]] double metres(double x) const { return x / per_metre; }
    [[nodiscard]] Eigen::Vector3d position(const Eigen::Vector3d& x) const {
        return combined(1.0, centroid, 1.0 / per_metre, x);
    }

    /// @param p        the `subset_view` of the points of the fit
    /// @param normals  (i): the normal of point i of the view, zero or not finite if it is missing
    template <class Points>
    regression_cloud(const Points& p, const noise_curve& noise, auto&& normals) {
        const moments_about_first m(p);
        const std::size_t n = m.of_points.count;
        finite = n;
        if (n == 0) return;
        const Eigen::Vector3d mean = scaled(1.0 / static_cast<double>(n), m.of_points.sum);
        centroid = combined(1.0, m.origin, 1.0, mean);
        const eigen_decomposition e = symmetric_eigen(m.of_points.covariance_of_neighbors());
        double largest = 0.0;
        for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(centroid[i]));
        largest += std::sqrt(e.values[0]);
        constexpr double operations = 4.0;  // numerical: that rounded a coordinate
        const double rounding = operations * p.epsilon() * largest;
        constexpr double flat = 1e-14;  // numerical: rounding errors of eigenvalues
        has_volume = e.values[2] > std::max(flat * e.values[0], rounding * rounding);
        if (!has_volume || !std::isnormal(e.values[0])) return;
        per_metre = power_to_one(std::sqrt(e.values[0]));
        points.reserve(n);
        constexpr double enough = 300.0;  // performance only
        random_stream random(0);
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Eigen::Vector3d x = p[i];
            if (!is_finite(x)) continue;
            const Eigen::Vector3d v = p.viewpoints[i];
            const Eigen::Vector3d way = is_finite(v) ? difference(x, v) : x;
            const double sigma = std::sqrt(noise.variance_along(way) + rounding * rounding);
            const Eigen::Vector3d at = scaled(per_metre, difference(difference(x, m.origin), mean));
            regression_point r{at, {0.0, 0.0, 0.0}, per_metre * sigma};
            if (!p.viewpoints.empty() && is_finite(v) && has_length(way)) r.ray = direction_of(way);
            points.push_back(r);
            // At random, so that no pattern of the points matters.
            if (random.uniform() * static_cast<double>(n) >= enough) continue;
            const Eigen::Vector3d normal = normals(i);
            const bool is_usable = all_finite(normal) && has_length(normal);
            samples.push_back({at, is_usable ? direction_of(normal) : Eigen::Vector3d(0, 0, 0)});
            sampled_points.push_back(r);
        }
    }
};

/// The surface that fits the sample best, from all first values.
template <class Surface>
[[nodiscard]] fitted_surface<Surface> best_start(regression_cloud& cloud) {
    constexpr int iterations = 20;  // performance only: minima are compared, not reached
    const sequential here;
    const surface_regression<Surface, sequential> regression(cloud.sampled_points, here);
    fitted_surface<Surface> best;
    for (const Surface& start : starts_of(cloud.samples, Surface())) {
        if (!start.is_valid()) continue;
        const auto found = regression.from(start, iterations);
        if (best.equations.count == 0 || found.equations.squares < best.equations.squares)
            best = found;
    }
    return best;
}

/// The upper .3 % quantile of chi-square, by Wilson and Hilferty 1931.
[[nodiscard]] inline double chi_square_limit(std::size_t degrees_of_freedom) {
    constexpr double upper = 2.748;  // quantile of the normal distribution, 99.7 %
    const double n = static_cast<double>(degrees_of_freedom);
    const double v = 2.0 / (9.0 * n);  // formula
    const double root = 1.0 - v + upper * std::sqrt(v);
    return n * root * root * root;
}

/// A surface, the covariance of its parameters, and the outcome of the fit.
template <class Surface>
struct tested_surface : surface_fit {
    static constexpr std::size_t n = Surface::parameters;

    Surface surface;
    square_array<n> covariance{};

    /// Fits, and tests the result.
    template <execution X>
    tested_surface(regression_cloud& cloud, const X& run) {
        points = cloud.finite;
        if (points <= n) return;
        status = outcome::degenerate;
        if (!cloud.has_volume) return;
        constexpr int iterations = 100;  // performance only: some ten are the rule
        surface_regression<Surface, X> regression(cloud.points, run);
        const auto fit = regression.refined(best_start<Surface>(cloud), iterations);
        points = fit.equations.count;
        if (points <= n) {
            status = outcome::too_few_points;
            return;
        }
        if (!std::isfinite(fit.equations.squares)) return;
        const scaled_equations<n> equations(fit.equations);
        if (!equations.is_regular()) return;
        surface = fit.surface;
        covariance = equations.covariance();
        if (!is_determined()) return;
        degrees_of_freedom = points - n;
        chi_square = fit.equations.squares;
        rms = cloud.metres(regression.rms(surface));
        status = !fit.is_converged                                   ? outcome::not_converged
                 : chi_square > chi_square_limit(degrees_of_freedom) ? outcome::poor_fit
                                                                     : outcome::good;
    }

  private:
    /// Whether the deviation of each parameter is well below the radius, or 1 rad. A plane has
    /// three parameters; the others are determined by noise alone if the points are flat, so that
    /// the square of the curvature in its variance is at most a chi-square.
    [[nodiscard]] bool is_determined() const {
        constexpr std::size_t of_plane = 3;
        const double deviations = std::sqrt(chi_square_limit(n - of_plane));
        for (std::size_t i = 0; i < n; ++i) {
            const double most = Surface::is_length[i] ? surface.radius : 1.0;
            if (!(deviations * std::sqrt(covariance[i][i]) < most)) return false;
        }
        return true;
    }
};

/// Fits a surface to some points of a range.
/// @param report  (estimate, surface, cloud) fills in the parameters if there are any
template <class Surface, class Estimate, class R, execution X, class Proj>
[[nodiscard]] Estimate fitted_to(const R& points, const auto& surface,
                                 std::span<const point_index> members, const noise_curve& noise,
                                 const X& run, Proj projection, auto&& report) {
    require(std::ranges::size(surface) == std::ranges::size(points),
            "fit of a surface: points and normals differ in number");
    const subset_view<R, Proj> chosen(points, members, std::move(projection));
    regression_cloud cloud(chosen, noise, [&](std::size_t i) -> Eigen::Vector3d {
        return surface[members[i]].normal;
    });
    const auto& team = staying(run);
    const tested_surface<Surface> tested(cloud, team);
    Estimate estimate;
    static_cast<surface_fit&>(estimate) = tested;
    if (!estimate.has_parameters()) return estimate;
    const auto unit = [&](std::size_t i) { return Surface::is_length[i] ? cloud.per_metre : 1.0; };
    for (std::size_t i = 0; i < Surface::parameters; ++i) {
        for (std::size_t j = 0; j < Surface::parameters; ++j)
            estimate.covariance(static_cast<int>(i), static_cast<int>(j)) =
                tested.covariance[i][j] / unit(i) / unit(j);
    }
    report(estimate, tested.surface, cloud);
    return estimate;
}

/// The indices of all points of a range.
[[nodiscard]] inline scratch<point_index> all_indices(std::size_t n) {
    scratch<point_index> all(n);
    for (std::size_t i = 0; i < n; ++i) all[i] = static_cast<point_index>(i);
    return all;
}

}  // namespace gnomon::detail

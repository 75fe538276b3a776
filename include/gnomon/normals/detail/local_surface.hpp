// SPDX-License-Identifier: BSL-1.0
/// @file
/// The simplest surface through a neighborhood that the noise does not reject: a plane, or else a
/// quadric over it (the jet of degree 2 of Cazals and Pouget 2005). Across an edge both are
/// rejected.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/least_squares_quadric.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/normals/detail/tangent_basis.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon::detail {

/// A point and its neighbors, nearest first. The point is number 0, its neighbors are 1 ... last().
struct surroundings {
    std::vector<point_index> index;
    std::vector<Eigen::Vector3d> offset;  ///< from the point [m]

    /// Those of point i, whose neighbors are sorted by distance.
    void assign(const auto& points, std::size_t i, const auto& neighbors) {
        const Eigen::Vector3d p = points[i];
        index.assign(1, static_cast<point_index>(i));
        offset.assign(1, {0.0, 0.0, 0.0});
        for (const neighbor& q : neighbors) {
            index.push_back(q.index);
            offset.push_back(difference(points[q.index], p));
        }
    }

    [[nodiscard]] std::size_t last() const { return index.size() - 1; }
    /// The distance [m] of neighbor k.
    [[nodiscard]] double radius(std::size_t k) const { return length(offset[k]); }

    /// The mean distance [m] of the first k neighbors.
    [[nodiscard]] double mean_distance(std::size_t k) const {
        double sum = 0.0;
        for (std::size_t l = 1; l <= k; ++l) sum += length(offset[l]);
        return k > 0 ? sum / static_cast<double>(k) : 0.0;
    }
};

/// A surface near a point p: the positions p + x whose height over `base` is `height` there.
struct local_surface {
    plane_fit fit;  ///< the normal at p; spectrum and trust of the points it was fitted to
    tangent_basis base{Eigen::Vector3d(0.0, 0.0, 1.0)};
    quadric height;              ///< a constant if the surface is no more than a plane
    bool curved = false;         ///< a quadric
    bool settled = false;        ///< the noise does not reject it, and hardly tilts it
    point_index neighbors = 0;   ///< the number of neighbors, chosen by the noise
    double mean_distance = 0.0;  ///< to them [m]

    /// The height [m] of p + x over the surface.
    [[nodiscard]] double residual(const Eigen::Vector3d& x) const {
        const double z = dot(base.normal, x);
        return z - (curved ? height(dot(base.b1, x), dot(base.b2, x)) : height.constant);
    }

    /// The normal, of unit length, of the surface below p + x.
    [[nodiscard]] Eigen::Vector3d normal_at(const Eigen::Vector3d& x) const {
        if (!curved) return base.normal;
        const double a = dot(base.b1, x);
        const double b = dot(base.b2, x);
        return direction_of(combined(1.0, base.normal,  //
                                     -(2.0 * height.a * a + height.b * b + height.e), base.b1,
                                     -(height.b * a + 2.0 * height.c * b + height.f), base.b2));
    }

    /// Makes it a plane.
    void become(const plane_fit& plane, double offset) {
        fit = plane;
        base = tangent_basis(plane.normal);
        height = {};
        height.constant = offset;
        curved = false;
    }
    /// Makes it a quadric over the same base.
    void become(const quadric& heights) {
        height = heights;
        curved = true;
        fit.normal = normal_at({0.0, 0.0, 0.0});
    }

    /// The same surface, of which the point is at `from` [m], as a surface near the position there.
    [[nodiscard]] local_surface seen_from(const Eigen::Vector3d& from) const {
        local_surface s = *this;
        s.height.constant -= dot(base.normal, from);
        if (!curved) return s;
        const double a = dot(base.b1, from);
        const double b = dot(base.b2, from);
        s.height.constant += height(a, b) - height.constant;
        s.height.e += 2.0 * height.a * a + height.b * b;
        s.height.f += height.b * a + 2.0 * height.c * b;
        s.fit.normal = s.normal_at({0.0, 0.0, 0.0});
        return s;
    }
};

/// Adds the height of x [m] over a plane, with coordinates in the plane that are scaled [1/m].
void add_height(auto& heights, const tangent_basis& base, double scale, const Eigen::Vector3d& x,
                double weight = 1.0) {
    heights.add(scale * dot(base.b1, x), scale * dot(base.b2, x), dot(base.normal, x), weight);
}

/// The plane of least squares of a point and its first k neighbors, and the quadric over it.
/// Precondition: k >= 2. (Generic for compile time only.)
class local_fits {
  public:
    /// @param around  a `surroundings`
    local_fits(const auto& around, std::size_t k, double min_aspect_ratio)
        : count_(static_cast<double>(k + 1)) {
        moments m;
        for (std::size_t l = 1; l <= k; ++l) m.add(around.offset[l]);
        const plane_fit fit = plane_of_least_spread(m.covariance_with_point(), min_aspect_ratio);
        plane_.become(fit, dot(fit.normal, m.mean_with_point()));
        of_plane_ = of_quadric_ = count_ * fit.spectrum.lambda[2];
        constexpr std::size_t fewest = 7;  // one more than a quadric has coefficients
        if (k < fewest || !usable(fit.trust)) return;
        const tangent_basis& base = plane_.base;
        const double scale = 1.0 / around.radius(k);
        least_squares_quadric heights;
        for (std::size_t l = 0; l <= k; ++l) add_height(heights, base, scale, around.offset[l]);
        has_quadric_ = heights.solve() > least_independence;
        if (!has_quadric_) return;
        quadric_ = heights.solution(scale, scale);
        of_quadric_ = heights.squared_residual();
    }

    /// The part of each column of the normal equations, of no unit, that the columns before it must
    /// leave unexplained, else the quadric is not determined: its rounding error is 1e-15, and the
    /// relative error of a coefficient is that over this part (numerical).
    static constexpr double least_independence = 1e-6;

    [[nodiscard]] const local_surface& plane() const { return plane_; }
    [[nodiscard]] bool has_quadric() const { return has_quadric_; }
    /// Precondition: has_quadric().
    [[nodiscard]] local_surface curved() const {
        local_surface s = plane_;
        s.become(quadric_);
        return s;
    }

    /// The sums of squared residuals [m^2].
    [[nodiscard]] double left_by_plane() const { return of_plane_; }
    [[nodiscard]] double left_by_quadric() const { return of_quadric_; }
    /// The numbers of points, less those of coefficients.
    [[nodiscard]] double freedom_of_plane() const { return count_ - 3.0; }
    [[nodiscard]] double freedom_of_quadric() const { return count_ - 6.0; }

  private:
    local_surface plane_;
    quadric quadric_;
    bool has_quadric_ = false;
    double count_, of_plane_ = 0.0, of_quadric_ = 0.0;
};

/// The standard deviation of the slopes of a plane that is fitted to k points over a disc of radius
/// r [m]: 2 noise / (r sqrt(k)).
[[nodiscard]] inline double deviation_of_slope(double noise, double r, std::size_t k) {
    return 2.0 * noise / (r * std::sqrt(static_cast<double>(k)));
}

/// The simplest surface that the noise does not reject near a point, tested on 16 neighbors at
/// least, fitted to its first k neighbors; the plane, unsettled, if both are rejected.
/// Precondition: 2 <= k <= around.last().
/// @param around  a `surroundings`
/// @param noise   across the surface [m]
[[nodiscard]] local_surface simplest_surface(const auto& around, std::size_t k, double noise,
                                             double min_aspect_ratio) {
    constexpr std::size_t tested_neighbors = 16, fewest_tested = 9;
    constexpr double relative_rounding = 1e-6;  // of the radius, that counts as noise
    // Chosen on the tuning half of known_normals.
    constexpr double bend_residuals = 0.01;       // share of the plane's that a quadric leaves
    constexpr double max_slope_deviation = 0.01;  // of a settled surface [rad]
    const std::size_t wide = std::min(std::max(k, tested_neighbors), around.last());
    const local_fits fits(around, k, min_aspect_ratio);
    local_surface surface = fits.plane();
    if (wide < fewest_tested || !usable(surface.fit.trust)) return surface;

    const local_fits all = k < wide ? local_fits(around, wide, min_aspect_ratio) : fits;
    if (!usable(all.plane().fit.trust)) return surface;
    const double least = std::max(noise, relative_rounding * around.radius(wide));
    // Three standard deviations of a sum of squares above its mean.
    const auto limit = [&](double freedom) {
        return least * least * (freedom + 3.0 * std::sqrt(2.0 * freedom));
    };
    double left = all.left_by_plane() / all.freedom_of_plane();
    if (all.left_by_plane() > limit(all.freedom_of_plane())) {
        const bool accepted =
            all.has_quadric() && fits.has_quadric() &&
            all.left_by_quadric() <=
                std::max(limit(all.freedom_of_quadric()), bend_residuals * all.left_by_plane());
        if (!accepted) return surface;
        surface = fits.curved();
        left = all.left_by_quadric() / all.freedom_of_quadric();
    }
    surface.settled =
        deviation_of_slope(std::sqrt(left), around.radius(k), k) < max_slope_deviation;
    return surface;
}

}  // namespace gnomon::detail

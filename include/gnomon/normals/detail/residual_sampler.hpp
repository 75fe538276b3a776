// SPDX-License-Identifier: BSL-1.0
/// @file
/// Residuals of local planes along the rays: what `measure_noise` reads the noise from.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/across_lines.hpp>
#include <gnomon/neighborhoods/detail/ray_metric.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/normals/detail/ray_regression.hpp>

namespace gnomon::detail {

/// A plane through the neighborhood of a point, fit along the rays.
struct sampled_plane {
    Eigen::Vector3d ray;     ///< from the view point to the point [m]
    Eigen::Vector3d normal;  ///< of length 1; 0 if there is no plane
    double variance = 0.0;   ///< of the residuals along the rays [m^2]
    double radius = 0.0;     ///< of the neighborhood, across the ray [m]
};

/// Fits planes to some of the points of an index. (A template, so that only code that measures
/// noise compiles it.)
template <class Index>
class residual_sampler {
  public:
    explicit residual_sampler(const Index& index) : index_(index) {
        finite_.reserve(index.finite());
        for (std::size_t i = 0; i < index.size(); ++i)
            if (index.is_finite(i)) finite_.push_back(static_cast<point_index>(i));
    }

    /// The planes of `samples` finite points, spread evenly over their order, with their 16
    /// neighbors nearest to the segment of the ray, of half_length(ray) [m] to either side; where
    /// these lie on one scan line, with four in each quadrant around the ray, or none if there are
    /// too few.
    [[nodiscard]] scratch<sampled_plane> operator()(std::size_t samples, const execution auto& run,
                                                    auto&& half_length) const {
        const std::size_t n = std::min(samples, finite_.size());
        scratch<sampled_plane> planes(n);
        for_each_chunk(run, n, [&](std::size_t first, std::size_t last) {
            scratch<neighbor> found;
            across_lines across(index_);
            for (std::size_t s = first; s < last; ++s)
                planes[s] = plane_at(finite_[s * finite_.size() / n], half_length, found, across);
        });
        return planes;
    }

    static constexpr std::size_t neighbors = 16;

  private:
    [[nodiscard]] sampled_plane plane_at(point_index i, auto& half_length, scratch<neighbor>& found,
                                         auto& across_line) const {
        const Eigen::Vector3d p = index_[i];
        const Eigen::Vector3d viewpoint = index_.viewpoints[i];
        sampled_plane plane{difference(p, viewpoint), {0.0, 0.0, 0.0}};
        const double range = length(plane.ray);
        if (!(range > 0.0 && std::isfinite(range))) return plane;
        search_tree(index_.tree(), p, {.k = neighbors, .except = i}, found,
                    ray_metric(scaled(1.0 / range, plane.ray), half_length(plane.ray)));
        if (found.size() < neighbors) return plane;
        const auto around =
            across_line(i, neighbors, [&](std::size_t n) { return found[n].index; });
        if (around.size() == neighbors)
            for (std::size_t n = 0; n < neighbors; ++n) found[n].index = around[n];
        else if (!around.empty())
            return plane;  // along one line, to which errors between the lines do not show
        ray_regression regression(plane.ray);
        for (const neighbor& q : found) regression.add(difference(index_[q.index], p));
        regression.solve();
        if (!usable(regression.status())) return plane;
        const Eigen::Vector3d m = regression.solution();  // the plane m . x = range
        double sum = squared_residual(m, range, plane.ray, plane.ray);
        for (const neighbor& q : found) {
            const Eigen::Vector3d x = index_[q.index];
            sum += squared_residual(m, range, difference(x, viewpoint),
                                    difference(x, index_.viewpoints[q.index]));
        }
        constexpr double freedom = neighbors + 1 - 3;  // less the parameters of a plane
        if (!std::isfinite(sum)) return plane;
        plane.normal = direction_of(m);
        plane.variance = sum / freedom;
        for (const neighbor& q : found)
            plane.radius =
                std::max(plane.radius, across(difference(index_[q.index], p), plane.ray));
        return plane;
    }

    /// The length of d across a ray.
    [[nodiscard]] static double across(const Eigen::Vector3d& d, const Eigen::Vector3d& ray) {
        return length(cross(d, ray)) / length(ray);
    }

    /// The square of how far, along its own ray, the point x is off the plane m . x = d.
    [[nodiscard]] static double squared_residual(const Eigen::Vector3d& m, double d,
                                                 const Eigen::Vector3d& x,
                                                 const Eigen::Vector3d& ray) {
        const double e = (dot(m, x) - d) * length(ray) / dot(m, ray);
        return e * e;
    }

    const Index& index_;
    scratch<point_index> finite_;
};

}  // namespace gnomon::detail

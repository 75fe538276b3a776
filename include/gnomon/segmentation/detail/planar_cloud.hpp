// SPDX-License-Identifier: BSL-1.0
/// @file
/// What all steps of a segmentation into planes read of points: positions and noise.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/quantile.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// Positions are relative to the median of each coordinate, so that planes keep their digits far
/// from the origin of the coordinates, and in spite of points that are far from all others.
class planar_cloud {
  public:
    template <execution X>
    planar_cloud(const spatial_index& index, const noise_curve& curve, const X& run)
        : planar_cloud(index, curve, run, !index.viewpoints.empty()) {}

    /// @param is_seen  whether the view points are known; the origin stands for unknown ones
    template <execution X>
    planar_cloud(const spatial_index& index, const noise_curve& curve, const X& run, bool is_seen)
        : noise(noise_of_points(index, curve, run, is_seen)), index_(index) {
        if (index.finite() > 0)
            for (int a = 0; a < 3; ++a) origin[a] = median_of(a, index.tree());
        resize_touched(offsets, index.size(), run);
        for_each_chunk(run, index.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) offsets[i] = difference(index[i], origin);
        });
    }

    scratch<point_noise> noise;
    scratch<Eigen::Vector3d> offsets;  ///< of the points, from the origin [m]
    scratch<point_index> counts;       ///< of the points that each is the mean of; empty for points
    Eigen::Vector3d origin{0.0, 0.0, 0.0};

    [[nodiscard]] bool is_finite(std::size_t i) const { return index_.is_finite(i); }
    [[nodiscard]] std::size_t size() const { return offsets.size(); }
    /// From the view point of point i, or else the origin of the coordinates, to the point [m].
    [[nodiscard]] Eigen::Vector3d ray(std::size_t i) const {
        return difference(index_[i], index_.viewpoints[i]);
    }
    void add(std::size_t i, plane_sums& to) const {
        to.add(offsets[i], noise[i], counts.empty() ? 1 : counts[i]);
    }
    /// Whether point i is on the plane of a region: within three standard deviations of the noise,
    /// times the root of its excess.
    [[nodiscard]] bool is_on(std::size_t i, const region_plane& to) const {
        const double distance = std::abs(to.plane.signed_distance(offsets[i]));
        return distance / noise[i].across(to.plane.normal) <=
               most_deviations * std::sqrt(to.excess());
    }

  private:
    /// The median of one coordinate, of some of the points. (A template, so that only its users
    /// compile it.)
    [[nodiscard]] static double median_of(int axis, const auto& tree) {
        constexpr std::size_t enough = 1000;  // performance only
        scratch<double> values;
        for (std::size_t place = 0; place < tree.size(); place += 1 + tree.size() / enough)
            values.push_back(tree.at(static_cast<std::size_t>(axis))[place]);
        return quantile(values, 0.5);
    }

    const spatial_index& index_;
};

}  // namespace gnomon::detail

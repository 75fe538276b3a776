// SPDX-License-Identifier: BSL-1.0
/// @file
/// Sums over the points of a region from which its plane follows, and how well noise explains the
/// deviations from it. Sums of two regions add up to those of their union, so that whether one
/// plane is enough for both is known without looking at a point again.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// A plane fit to a region.
struct region_plane {
    gnomon::plane plane{Eigen::Vector3d(0.0, 0.0, 0.0), 0.0};
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};  ///< [m]
    double chi2 = 1.0;  ///< mean squared deviation of the points, in variances of their noise
    bool is_determined = false;
    bool is_seen = false;  ///< not edge-on, as the planes of scan lines are

    /// The variance of points of the region, in variances of their noise: chi2, clamped to
    /// [1, 2.5]; more than 1 where the surface is rough.
    [[nodiscard]] double excess() const { return std::clamp(chi2, 1.0, most_excess); }

    /// Of the roughest surface; chosen on furnished rooms 20,001 to 20,008 and an office
    /// (pcl_office1_kinect): by less, rough surfaces are several, by more, edges are lost.
    static constexpr double most_excess = 2.5;
};

/// The sums, with positions relative to an origin [m] that is the same for all regions.
struct plane_sums {
    weighted_moments positions;                      ///< weight: 1 / sigma^2 [1 / m^2]
    Eigen::Matrix3d rays = diagonal(0.0, 0.0, 0.0);  ///< weighted; lower triangle only
    std::size_t count = 0;                           ///< of the points
    std::size_t summands = 0;                        ///< points, or cells with several of them

    /// @param points  of which `offset` is the mean
    void add(const Eigen::Vector3d& offset, const point_noise& noise, std::size_t points = 1) {
        const double w = static_cast<double>(points) / (noise.sigma * noise.sigma);
        positions.add(offset, w);
        if (noise.has_ray()) {
            for (int j = 0; j < 3; ++j)
                for (int i = j; i < 3; ++i) rays(i, j) += w * noise.ray[i] * noise.ray[j];
        } else {
            for (int j = 0; j < 3; ++j) rays(j, j) += w;
        }
        count += points;
        ++summands;
    }

    void add(const plane_sums& more) {
        positions.weight += more.positions.weight;
        positions.sum = combined(1.0, positions.sum, 1.0, more.positions.sum);
        for (int j = 0; j < 3; ++j) {
            for (int i = j; i < 3; ++i) {
                positions.outer(i, j) += more.positions.outer(i, j);
                rays(i, j) += more.rays(i, j);
            }
        }
        count += more.count;
        summands += more.summands;
    }

    /// The mean squared cosine of the angles of incidence on a plane.
    [[nodiscard]] double squared_cosine(const Eigen::Vector3d& n) const {
        return dot(n, product(scaled_whole(rays, 1.0 / positions.weight), n));
    }

    /// The variance of the mean of the points across a plane by their noise [m^2].
    [[nodiscard]] double noise_across(const Eigen::Vector3d& n) const {
        return std::max(squared_cosine(n), least_cosine * least_cosine) / positions.weight;
    }

    /// The variance of a point along a direction by its noise [m^2].
    [[nodiscard]] double noise_along(const Eigen::Vector3d& direction) const {
        return static_cast<double>(count) * squared_cosine(direction) / positions.weight;
    }

    /// The plane of the points, relative to the origin.
    [[nodiscard]] region_plane fit() const {
        region_plane f;
        if (count == 0) return f;
        f.centroid = positions.mean();
        if (count < 3) return f;
        const eigen_decomposition e = symmetric_eigen(positions.covariance());
        constexpr double least_ratio = 1e-12;  // numerical: of variances, for points on a line
        if (!(e.values[1] > least_ratio * e.values[0])) return f;
        const Eigen::Vector3d n = column(e.vectors, 2);
        f.plane = {n, dot(n, f.centroid)};
        f.is_determined = true;
        f.chi2 = chi2_of(std::max(0.0, e.values[2]), n);
        f.is_seen = is_seen(n);
        return f;
    }

    /// A given plane, relative to the origin, as the plane of the points. Precondition: there are.
    /// (A template, so that only its users compile it.)
    [[nodiscard]] region_plane about(const auto& to) const {
        return {to, positions.mean(), chi2_about(to), true, is_seen(to.normal)};
    }

    /// The sum of the squared deviations from the plane that is fit to the points, in variances of
    /// their noise.
    [[nodiscard]] double squares(const region_plane& own) const {
        return static_cast<double>(count) * own.chi2;
    }

    /// The mean squared deviation of the points from a plane, in variances of their noise.
    [[nodiscard]] double chi2_about(const gnomon::plane& to) const {
        const Eigen::Vector3d& n = to.normal;
        const double off = to.signed_distance(positions.mean());
        const double variance = dot(n, product(positions.covariance(), n)) + off * off;
        return chi2_of(variance, n);
    }

  private:
    [[nodiscard]] bool is_seen(const Eigen::Vector3d& n) const {
        return squared_cosine(n) >= sin(edge_on) * sin(edge_on);
    }

    /// @param variance  of the points across the plane [m^2]
    [[nodiscard]] double chi2_of(double variance, const Eigen::Vector3d& normal) const {
        return variance / (static_cast<double>(count) * noise_across(normal));
    }
};

/// A region with its sums and its plane.
struct planar_region {
    plane_sums sums;
    region_plane fit;
    bool is_planar = true;  ///< else the plane does not explain its points

    [[nodiscard]] bool is_empty() const { return sums.count == 0; }

    /// Whether the plane explains a region of `all` points: most of them are on it, their variance
    /// is at most 2.5 times that of the noise, and it is not seen edge-on.
    [[nodiscard]] bool explains(std::size_t all) const {
        return fit.is_determined && fit.is_seen && fit.chi2 <= region_plane::most_excess &&
               2 * sums.count > all;
    }
};

}  // namespace gnomon::detail

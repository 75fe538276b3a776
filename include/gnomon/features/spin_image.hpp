// SPDX-License-Identifier: BSL-1.0
/// @file
/// Spin images: histograms of the neighbors in a cylinder about the normal of a point, over the
/// distance alpha from the axis and the height beta along it. They are invariant under rotation
/// about the normal.
///
/// Klasing 2010, Sec. 3.4.1. A. Johnson and M. Hebert, Using spin images for efficient object
/// recognition in cluttered 3D scenes, 1999 (bilinear interpolation, correlation). F. Endres,
/// C. Plagemann, C. Stachniss and W. Burgard, Unsupervised discovery of object classes from range
/// data using latent Dirichlet allocation, 2009 (normals).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/detail/cylinder_bins.hpp>
#include <gnomon/features/detail/row_distance.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// The spin image of the neighbors. Models `descriptor`.
///
/// A row holds the bins of the smallest alpha first, each from the lowest beta to the highest. The
/// sum of its entries is the number of neighbors in the cylinder, which is closed, or 1 if
/// `normalize` is set. A neighbor at the position of the point has alpha = beta = 0 and counts as
/// any other.
///
/// Trust: `too_few_neighbors` if fewer than `min_neighbors` are in the cylinder, else `good`. The
/// distance is 1 - R, where R is the linear correlation of the entries: it does not depend on the
/// number of neighbors. O(m) for m neighbors.
struct spin_image {
    double radius = 0.1;  ///< of the cylinder [m], above 0; chosen
    double height = 0.2;  ///< of the cylinder [m], above 0; half of it above the point; chosen
    std::size_t radial_bins = 8;  ///< the default of PCL; there are at most 2^20 entries
    /// If odd, the tangent plane is in the middle of a bin, so that noise does not divide the
    /// points of a flat surface between two. Chosen: bins are about square.
    std::size_t axial_bins = 15;
    /// Each neighbor is distributed to the four nearest corners of the bins, by bilinear
    /// interpolation: an image of radial_bins + 1 by axial_bins + 1 entries.
    bool interpolate = false;
    bool normalize = false;         ///< entries are divided by their sum
    std::size_t min_neighbors = 1;  ///< above 0

    /// The radius of the ball that contains the cylinder [m].
    [[nodiscard]] double support_radius() const { return std::hypot(radius, 0.5 * height); }
    /// The number of entries.
    [[nodiscard]] std::size_t dimension() const {
        const std::size_t more = interpolate ? 1 : 0;
        return (radial_bins + more) * (axial_bins + more);
    }
    /// @throws std::invalid_argument  if the numbers of entries differ
    [[nodiscard]] double distance(std::span<const float> a, std::span<const float> b) const {
        return detail::correlation_distance(a, b);
    }
    /// @throws std::invalid_argument  if a number is out of range
    void require_valid() const {
        detail::require(radius > 0.0 && height > 0.0 && std::isfinite(support_radius()),
                        "spin_image: radius and height must be finite and above 0");
        const std::size_t more = interpolate ? 1 : 0;
        detail::require(radial_bins > 0 && axial_bins > 0 &&
                            detail::is_row_length({radial_bins + more, axial_bins + more}),
                        "spin_image: there must be bins, and at most 2^20 entries");
        detail::require(min_neighbors > 0, "spin_image: min_neighbors must be above 0");
    }

    /// See `descriptor`.
    trust operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                     neighborhood_view neighbors, std::span<double> row) const {
        const std::size_t inside = detail::with_widest([&](auto) {
            const std::size_t all = bins().for_each_weight(
                p, normal, neighbors,
                [at = row.data()](std::int64_t bin, double w, std::size_t) { at[bin] += w; });
            if (normalize && all > 0) {
                const double share = 1.0 / static_cast<double>(all);
                for (double& entry : row) entry *= share;
            }
            return all;
        });
        return inside < min_neighbors ? trust::too_few_neighbors : trust::good;
    }

  private:
    friend struct angular_spin_image;
    [[nodiscard]] detail::cylinder_bins bins() const {
        return {radius, height, radial_bins, axial_bins, interpolate};
    }
};

/// The variant on normals: an entry is the mean angle [rad] between the normal of the point and the
/// normals of the neighbors in the bin, in [0, pi / 2], and 0 for an empty bin. Models
/// `descriptor`.
///
/// Normals count as axes, without a sign; neighbors without a normal are left out. Bins and trust
/// are those of `spin_image`, whose member `normalize` has no effect; the distance is Euclidean.
struct angular_spin_image {
    spin_image bins = {};  ///< those of the positions

    [[nodiscard]] double support_radius() const { return bins.support_radius(); }  ///< [m]
    /// The number of bins.
    [[nodiscard]] std::size_t dimension() const { return bins.dimension(); }
    /// @throws std::invalid_argument  if the numbers of entries differ
    [[nodiscard]] double distance(std::span<const float> a, std::span<const float> b) const {
        return detail::euclidean_distance(a, b);
    }
    /// @throws std::invalid_argument  if a number is out of range
    void require_valid() const { bins.require_valid(); }

    /// See `descriptor`.
    trust operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                     neighborhood_view neighbors, std::span<double> row,
                     std::span<const Eigen::Vector3d> normals) const {
        detail::scratch<double> weights(row.size(), 0.0);
        std::size_t used = 0, last = neighbors.size();
        double angle = 0.0;  // of neighbor number `last`
        (void)bins.bins().for_each_weight(
            p, normal, neighbors, [&](std::int64_t at, double w, std::size_t k) {
                const auto bin = static_cast<std::size_t>(at);
                if (is_missing(normals[k])) return;
                if (k != last) {
                    last = k;
                    ++used;
                    // By atan2, which is exact for small angles.
                    angle = std::atan2(detail::length(detail::cross(normal, normals[k])),
                                       std::abs(detail::dot(normal, normals[k])));
                }
                weights[bin] += w;
                row[bin] += w * angle;
            });
        for (std::size_t bin = 0; bin < row.size(); ++bin)
            if (weights[bin] > 0.0) row[bin] /= weights[bin];
        return used < bins.min_neighbors ? trust::too_few_neighbors : trust::good;
    }
};

}  // namespace gnomon

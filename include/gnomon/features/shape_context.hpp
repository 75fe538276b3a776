// SPDX-License-Identifier: BSL-1.0
/// @file
/// 3D shape contexts: histograms of the neighbors in a ball about a point, over azimuth and
/// elevation in the frame of its normal, and on request over radial shells.
///
/// Klasing 2010, Sec. 3.4.2. A. Frome, D. Huber, R. Kolluri, T. Buelow and J. Malik, Recognizing
/// objects in range data using regional point descriptors, 2004.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/atan2pi.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/detail/radial_shells.hpp>
#include <gnomon/features/detail/row_distance.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// The 3D shape context of the neighbors. Models `descriptor`.
///
/// The thesis's form by default; Frome's has radial shells and densities, e.g. {.radius = 0.5,
/// .inner_radius = 0.02, .radial_bins = 15, .density_radius = 0.04}. The elevation is the angle to
/// the normal, and the azimuth is counted from an arbitrary tangent: the distance is the smallest
/// Euclidean one over all shifts of the azimuth by whole bins. The bin of azimuth a, elevation e
/// and shell s is entry (a E + e) S + s, for E elevations and S shells.
///
/// The sum of the entries is the number of neighbors in the ball, or 1 if `normalize` is set. A
/// neighbor at the position of the point has no direction and is not counted, nor is one nearer
/// than `inner_radius`; the azimuth of one on the axis is 0. See docs/thesis-notes.md, A49.
///
/// Trust: `too_few_neighbors` if fewer than `min_neighbors` are counted, else `good`. O(m) for m
/// neighbors, and the number of entries.
struct shape_context {
    double radius = 0.1;            ///< of the ball [m]; chosen
    double inner_radius = 0.0;      ///< that of Frome's first shell [m]; above 0 for several shells
    std::size_t azimuth_bins = 12;  ///< that and the next: Frome et al. 2004
    std::size_t elevation_bins = 11;  ///< there are at most 2^20 entries
    /// The thesis has one; radii of several shells have equal ratios, Frome's Eq. (1).
    std::size_t radial_bins = 1;
    /// If above 0, a neighbor counts 1 / (d V^(1/3)), where d is the number of points within this
    /// radius [m] of it and V is the volume of the bin [m^3], as in Frome's Sec. 2.1.
    double density_radius = 0.0;
    bool normalize = false;         ///< entries are divided by their sum
    std::size_t min_neighbors = 1;  ///< above 0

    /// Of the ball [m].
    [[nodiscard]] double support_radius() const { return radius; }
    /// The number of entries.
    [[nodiscard]] std::size_t dimension() const {
        return azimuth_bins * elevation_bins * radial_bins;
    }

    /// The Euclidean distance of the most similar azimuths. O(azimuth_bins dimension).
    /// @throws std::invalid_argument  unless both have dimension() entries
    [[nodiscard]] double distance(std::span<const float> a, std::span<const float> b) const {
        detail::require(a.size() == dimension() && b.size() == dimension(),
                        "shape_context: a row is not of the length of this descriptor");
        const std::size_t sector = elevation_bins * radial_bins;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t shift = 0; shift < b.size(); shift += sector) {
            const std::size_t rest = b.size() - shift;
            const double head = detail::euclidean_distance(a.first(rest), b.last(rest));
            const double tail = detail::euclidean_distance(a.last(shift), b.first(shift));
            least = std::min(least, std::hypot(head, tail));
        }
        return least;
    }

    /// @throws std::invalid_argument  if a number is out of range
    void require_valid() const {
        detail::radial_shells::require_valid(
            inner_radius, radius, radial_bins,
            "shape_context: inner_radius must be at least 0, above 0 for several radial_bins, and "
            "less than radius, which must be finite");
        detail::require(detail::is_row_length({azimuth_bins, elevation_bins, radial_bins}),
                        "shape_context: there must be bins, and at most 2^20 of them");
        detail::require(density_radius >= 0.0 && std::isfinite(density_radius),
                        "shape_context: density_radius must be finite and not negative");
        detail::require(min_neighbors > 0, "shape_context: min_neighbors must be above 0");
    }

    /// See `descriptor`.
    /// @param densities  the number of points within `density_radius` of each neighbor, itself
    ///                   among them; none: all neighbors count 1
    trust operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                     neighborhood_view neighbors, std::span<double> row,
                     std::span<const double> densities = {}) const {
        const detail::radial_shells shells(inner_radius, radius, radial_bins);
        const auto weights = densities.empty() ? detail::scratch<double>() : bin_weights(shells);
        polar_block block(normal);
        std::size_t counted = 0;
        double sum = 0.0;
        for (std::size_t first = 0; first < neighbors.size(); first += block_size) {
            const std::size_t size = std::min(block_size, neighbors.size() - first);
            block.measure(p, neighbors.data() + first, size);
            for (std::size_t l = 0; l < size; ++l) {
                if (!shells.contains(block.distance[l])) continue;
                const std::size_t a = bin_of(block.azimuth[l], azimuth_bins);
                const std::size_t e = bin_of(block.elevation[l], elevation_bins);
                const std::size_t part = e * radial_bins + shells.shell_of(block.distance[l]);
                const double w = densities.empty() ? 1.0 : weights[part] / densities[first + l];
                row[a * elevation_bins * radial_bins + part] += w;
                sum += w;
                ++counted;
            }
        }
        if (normalize && sum > 0.0)
            for (double& entry : row) entry /= sum;
        return counted < min_neighbors ? trust::too_few_neighbors : trust::good;
    }

  private:
    static constexpr std::size_t block_size = 32;  // performance only

    /// Polar coordinates of some neighbors.
    struct polar_block {
        std::array<double, block_size> x{}, y{}, z{}, across{};  // in the frame of the normal [m]
        std::array<double, block_size> distance{};               // [m]
        std::array<double, block_size> azimuth{}, elevation{};   // in turns, and in half turns
        Eigen::Vector3d n, t, u;                                 // normal and two tangents

        explicit polar_block(const Eigen::Vector3d& normal)
            : n(normal), t(detail::orthogonal(normal)), u(detail::cross(n, t)) {}

        void measure(const Eigen::Vector3d& p, const Eigen::Vector3d* first, std::size_t size) {
            for (std::size_t l = 0; l < size; ++l) {
                const Eigen::Vector3d d = detail::difference(first[l], p);
                x[l] = detail::dot(t, d);
                y[l] = detail::dot(u, d);
                z[l] = detail::dot(n, d);
                across[l] = std::sqrt(x[l] * x[l] + y[l] * y[l]);
                distance[l] = detail::length(d);
            }
            using detail::slim_pack;
            for (std::size_t l = 0; l < size; l += slim_pack::size) {
                const auto turn = atan2pi(slim_pack(&y[l]), slim_pack(&x[l]));
                const auto half_turn = atan2pi(slim_pack(&across[l]), slim_pack(&z[l]));
                for (std::size_t i = 0; i < slim_pack::size; ++i) {
                    azimuth[l + i] = turn[i] < 0.0 ? 0.5 * turn[i] + 1.0 : 0.5 * turn[i];
                    elevation[l + i] = half_turn[i];
                }
            }
        }
    };

    /// The last bin is closed.
    [[nodiscard]] static std::size_t bin_of(double part, std::size_t bins) {
        return std::min(static_cast<std::size_t>(part * static_cast<double>(bins)), bins - 1);
    }

    /// V^(-1/3) of the bins of one azimuth [1/m].
    [[nodiscard]] detail::scratch<double> bin_weights(const detail::radial_shells& shells) const {
        detail::scratch<double> weights(elevation_bins * radial_bins);
        const double azimuth = 2.0 * std::numbers::pi / static_cast<double>(azimuth_bins);
        const double elevation = std::numbers::pi / static_cast<double>(elevation_bins);
        for (std::size_t s = 0; s < radial_bins; ++s) {
            const double low = shells.boundary(s), high = shells.boundary(s + 1);
            const double depth = std::cbrt((high * high * high - low * low * low) / 3.0);
            for (std::size_t e = 0; e < elevation_bins; ++e) {
                // cos(a) - cos(a + h) = 2 sin(a + h / 2) sin(h / 2)
                const double area = 2.0 * azimuth * std::sin(0.5 * elevation) *
                                    std::sin((static_cast<double>(e) + 0.5) * elevation);
                weights[e * radial_bins + s] = 1.0 / (std::cbrt(area) * depth);
            }
        }
        return weights;
    }
};

}  // namespace gnomon

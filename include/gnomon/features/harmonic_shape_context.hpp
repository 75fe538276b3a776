// SPDX-License-Identifier: BSL-1.0
/// @file
/// Harmonic shape contexts: amplitudes of the spherical harmonics of the directions in which the
/// neighbors of a point lie.
///
/// Klasing 2010, Sec. 3.4.2. A. Frome, D. Huber, R. Kolluri, T. Buelow and J. Malik, Recognizing
/// objects in range data using regional point descriptors, 2004. M. Kazhdan, T. Funkhouser and
/// S. Rusinkiewicz, Rotation invariant spherical harmonic representation of 3D shape descriptors,
/// 2003 (amplitudes per degree).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/detail/radial_shells.hpp>
#include <gnomon/features/detail/row_distance.hpp>
#include <gnomon/features/detail/solid_harmonics.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// The amplitudes |a_lm| of a_lm = sum of Y_lm(u) over the directions u of the neighbors in the
/// frame of the normal, for degrees l below the bandwidth and orders m from 0 to l: the entries of
/// a shell are l = 0, 1, ..., and of each l the orders in turn. Models `descriptor`.
///
/// Amplitudes are invariant under rotation about the normal. Those of the negative orders are the
/// same. With `per_degree`, an entry is the root of the sum of squares over all orders, positive
/// and negative, of a degree: it is invariant under all rotations and does not depend on the
/// normal. The sum is over the points themselves, not over the bins of a shape context, whose
/// limits would break the invariance (docs/thesis-notes.md, A49).
///
/// Neighbors that count, and trust: as for `shape_context`. The distance is Euclidean.
/// O(m bandwidth^2) for m neighbors.
struct harmonic_shape_context {
    double radius = 0.1;        ///< of the ball [m]; chosen
    double inner_radius = 0.0;  ///< of the first shell [m]; above 0 for several shells
    std::size_t bandwidth = 8;  ///< degrees are less than this; 1 to 512; chosen
    /// The thesis has one; radii of several shells have equal ratios, Frome's Eq. (1). There are at
    /// most 2^20 entries.
    std::size_t radial_bins = 1;
    bool per_degree = false;        ///< whether the power of each degree is summed over the orders
    bool normalize = false;         ///< entries are divided by the number of neighbors
    std::size_t min_neighbors = 1;  ///< above 0

    /// Of the ball [m].
    [[nodiscard]] double support_radius() const { return radius; }
    /// The number of entries.
    [[nodiscard]] std::size_t dimension() const { return radial_bins * entries_of_shell(); }
    /// @throws std::invalid_argument  if the numbers of entries differ
    [[nodiscard]] double distance(std::span<const float> a, std::span<const float> b) const {
        return detail::euclidean_distance(a, b);
    }
    /// @throws std::invalid_argument  if a number is out of range
    void require_valid() const {
        detail::radial_shells::require_valid(
            inner_radius, radius, radial_bins,
            "harmonic_shape_context: inner_radius must be at least 0, above 0 for several "
            "radial_bins, and less than radius, which must be finite");
        // Numerical: factors of the recursion grow to (1 + sqrt 2)^bandwidth.
        constexpr std::size_t most_bandwidth = 512;
        detail::require(
            bandwidth > 0 && bandwidth <= most_bandwidth &&
                detail::is_row_length({radial_bins, bandwidth * (bandwidth + 1) / 2}),
            "harmonic_shape_context: the bandwidth must be from 1 to 512, and the number "
            "of entries at most 2^20");
        detail::require(min_neighbors > 0, "harmonic_shape_context: min_neighbors must be above 0");
    }

    /// See `descriptor`.
    trust operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                     neighborhood_view neighbors, std::span<double> row) const {
        const detail::radial_shells shells(inner_radius, radius, radial_bins);
        const detail::solid_harmonics harmonics(bandwidth);
        const Eigen::Vector3d t = detail::orthogonal(normal), u = detail::cross(normal, t);
        detail::scratch<amplitude> sums(radial_bins * harmonics.size());
        std::size_t counted = 0;
        for (const Eigen::Vector3d& q : neighbors) {
            const Eigen::Vector3d d = detail::difference(q, p);
            const double distance = detail::length(d);
            if (!shells.contains(distance)) continue;
            ++counted;
            const Eigen::Vector3d direction = detail::scaled(
                1.0 / distance, {detail::dot(t, d), detail::dot(u, d), detail::dot(normal, d)});
            amplitude* const shell = sums.data() + shells.shell_of(distance) * harmonics.size();
            harmonics.at(direction, [shell](std::size_t l, std::size_t m, double re, double im) {
                amplitude& sum = shell[l * (l + 1) / 2 + m];
                sum.re += re;
                sum.im += im;
            });
        }
        write(sums, normalize && counted > 0 ? 1.0 / static_cast<double>(counted) : 1.0, row);
        return counted < min_neighbors ? trust::too_few_neighbors : trust::good;
    }

  private:
    struct amplitude {
        double re = 0.0, im = 0.0;
    };

    [[nodiscard]] std::size_t entries_of_shell() const {
        return per_degree ? bandwidth : bandwidth * (bandwidth + 1) / 2;
    }

    void write(std::span<const amplitude> sums, double scale, std::span<double> row) const {
        double* entry = row.data();
        const amplitude* sum = sums.data();
        for (std::size_t s = 0; s < radial_bins; ++s) {
            for (std::size_t l = 0; l < bandwidth; ++l) {
                double squares = 0.0;
                for (std::size_t m = 0; m <= l; ++m, ++sum) {
                    const double square = sum->re * sum->re + sum->im * sum->im;
                    squares += m == 0 ? square : 2.0 * square;
                    if (!per_degree) *entry++ = scale * std::sqrt(square);
                }
                if (per_degree) *entry++ = scale * std::sqrt(squares);
            }
        }
    }
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Descriptors of points: vectors of numbers that describe how the neighbors within a radius lie
/// about a point and its normal, and a distance between two such vectors. `describe_points`
/// computes them for many points.
///
/// Laws, as functions in tests/laws/descriptor_laws.hpp: entries are finite; entries of a result
/// that is not usable are zero in what `describe_points` returns; the descriptor is invariant, up
/// to rounding, to the order of the neighbors and to translation; the distance of a descriptor to
/// itself is zero, and it is symmetric and not negative.
///
/// Models: `spin_image`, `angular_spin_image`, `shape_context`, `harmonic_shape_context`.
///
/// Klasing 2010, Sec. 3.4.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/unwritten.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

namespace detail {

/// d(point, normal, neighbors, row)
template <class D>
concept reads_positions =
    requires(const D& d, const Eigen::Vector3d& v, neighborhood_view n, std::span<double> row) {
        { d(v, v, n, row) } -> std::same_as<trust>;
    };

/// d(point, normal, neighbors, row, normals of the neighbors)
template <class D>
concept reads_normals = requires(const D& d, const Eigen::Vector3d& v, neighborhood_view n,
                                 std::span<double> row, std::span<const Eigen::Vector3d> normals) {
    { d(v, v, n, row, normals) } -> std::same_as<trust>;
};

/// d(point, normal, neighbors, row, densities at the neighbors), and a radius for these.
template <class D>
concept reads_densities = requires(const D& d, const Eigen::Vector3d& v, neighborhood_view n,
                                   std::span<double> row, std::span<const double> densities) {
    { d(v, v, n, row, densities) } -> std::same_as<trust>;
    { d.density_radius } -> std::convertible_to<double>;
};

}  // namespace detail

/// A const, thread-safe callable d(point, normal, neighbors, row) that writes the entries of the
/// descriptor into `row`, which is zero before and has d.dimension() entries, and returns a
/// `trust`. The normal has unit length; the neighbors are all other points within
/// d.support_radius() [m], in no particular order. d.distance(a, b) compares two descriptors, as
/// they are stored: in float.
///
/// A descriptor may read more of its neighbors, by a fifth parameter: their normals
/// (std::span<const Eigen::Vector3d>, unit vectors, or zero where there is none), or the numbers of
/// points within the radius d.density_radius of them (std::span<const double>, empty if that radius
/// is zero). A member require_valid() throws where a parameter is out of range.
template <class D>
concept descriptor = requires(const D& d, std::span<const float> row) {
    { d.support_radius() } -> std::convertible_to<double>;
    { d.dimension() } -> std::convertible_to<std::size_t>;
    { d.distance(row, row) } -> std::convertible_to<double>;
} && (detail::reads_positions<D> || detail::reads_normals<D> || detail::reads_densities<D>);

/// The descriptors of n points, in one array of floats, which halves their memory. Compare only
/// rows that are usable: others are zero, and so at distance 0 from each other.
struct point_descriptors {
    std::size_t dimension = 0;  ///< of each descriptor
    /// n rows of this length, one after the other; resize() leaves new values unwritten.
    std::vector<float, detail::unwritten<float>> values;
    std::vector<gnomon::trust> trust;  ///< of each row; a row that is not usable is zero

    /// The number of descriptors.
    [[nodiscard]] std::size_t size() const { return trust.size(); }
    /// The descriptor number i. Precondition: i < size().
    [[nodiscard]] std::span<const float> operator[](std::size_t i) const {
        return {values.data() + i * dimension, dimension};
    }
};

}  // namespace gnomon

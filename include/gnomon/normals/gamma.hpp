// SPDX-License-Identifier: BSL-1.0
/// @file
/// The thesis's measure of a normal's quality against ground truth.
///
/// Klasing 2010, Sec. 3.2.6, Eq. (3.12).
#pragma once

#include <cstddef>
#include <iterator>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point_range.hpp>

namespace gnomon {

/// gamma_i = |<n_i, n^_i>| in [0, 1] for unit vectors, whatever their signs. Eq. (3.12)
[[nodiscard]] inline double gamma(const Eigen::Vector3d& n, const Eigen::Vector3d& truth) {
    return std::abs(detail::dot(n, truth));
}

/// gamma, the mean over all points. A missing normal (the zero vector) counts as 0: a method gains
/// nothing by giving up.
///
/// @param surface  the estimated normals
/// @param truth    the true unit normals, in the same order
/// @return NaN for no points
/// @throws std::invalid_argument  if the two differ in size
template <normal_range Surface, indexed_range Truth>
[[nodiscard]] double mean_gamma(const Surface& surface, const Truth& truth) {
    const auto n = std::ranges::size(surface);
    detail::require(n == std::ranges::size(truth), "mean_gamma: normals and truth differ in size");
    if (n == 0) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    auto t = std::ranges::begin(truth);
    for (const auto& s : surface) sum += gamma(s.normal, *t++);
    return sum / static_cast<double>(n);
}

}  // namespace gnomon

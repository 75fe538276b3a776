// SPDX-License-Identifier: BSL-1.0
/// @file
/// Gamma, the quality of a normal against ground truth: the cosine of its error.
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

/// gamma_i = |<n_i, n^_i>| of two unit vectors, in [0, 1], without regard to their signs. Eq.
/// (3.12)
[[nodiscard]] inline double gamma(const Eigen::Vector3d& n, const Eigen::Vector3d& truth) {
    return std::abs(detail::dot(n, truth));
}

/// The mean of gamma over all points. A missing normal (the zero vector) has the gamma 0, so that
/// no method improves its mean by leaving normals out.
///
/// @param surface  the estimated normals
/// @param truth    the true unit normals, in the same order
/// @return the mean, in [0, 1]; NaN for no points
/// @throws std::invalid_argument  if the two differ in size
/// Complexity: O(n).
template <normal_range Surface, detail::indexed_range Truth>
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

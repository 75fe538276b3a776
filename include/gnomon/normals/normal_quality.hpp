// SPDX-License-Identifier: BSL-1.0
/// @file
/// The quality of normals against ground truth: gamma as in the thesis, and the errors as angles,
/// which also distinguish results whose gamma rounds to 0.999.
///
/// Klasing 2010, Sec. 3.2.6, Eq. (3.12); the root mean square of unoriented angles is the measure
/// of Guerrero et al., PCPNet, 2018.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/normals/gamma.hpp>

namespace gnomon {

/// The angle between two unit normals without regard to their signs, 0 to 90 degrees; accurate also
/// where it is small.
[[nodiscard]] inline angle unoriented_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return radians(std::atan2(detail::length(detail::cross(a, b)), std::abs(detail::dot(a, b))));
}

/// The quality of the normals of all points with a true normal. Angles are without regard to sign.
/// A missing normal, or one that is not finite, has the gamma 0 and the error of a right angle, so
/// that no method improves its figures by leaving normals out.
struct normal_quality {
    std::size_t points = 0;  ///< the number of points with a true normal
    double gamma = std::numeric_limits<double>::quiet_NaN();   ///< mean, Eq. (3.12)
    double usable = std::numeric_limits<double>::quiet_NaN();  ///< the part of them with a normal
    angle rms;                                                 ///< root of the mean squared error
    angle median;  ///< 50 % of the errors are at most this
    angle p90;     ///< 90 % of the errors are at most this
    angle p99;     ///< 99 % of the errors are at most this

    /// The quality of normals against the true ones.
    ///
    /// @param surface  the estimated normals
    /// @param truth    the true unit normals, in the same order; zero or NaN where there is none
    /// @throws std::invalid_argument  if the two differ in size
    /// Complexity: O(n).
    template <normal_range Surface, detail::indexed_range Truth>
    [[nodiscard]] static normal_quality of(const Surface& surface, const Truth& truth);
};

template <normal_range Surface, detail::indexed_range Truth>
normal_quality normal_quality::of(const Surface& surface, const Truth& truth) {
    detail::require(std::ranges::size(surface) == std::ranges::size(truth),
                    "normal_quality: normals and truth differ in size");
    std::vector<double> errors;
    double gammas = 0.0;
    double squares = 0.0;
    std::size_t found = 0;
    auto t = std::ranges::begin(truth);
    for (const auto& s : surface) {
        const Eigen::Vector3d expected = *t++;
        if (is_missing(expected) || !is_finite(expected)) continue;
        const bool missing = is_missing(s.normal) || !is_finite(s.normal);
        errors.push_back(missing ? 0.5 * std::numbers::pi
                                 : unoriented_angle(s.normal, expected).radians());
        squares += errors.back() * errors.back();
        gammas += missing ? 0.0 : gnomon::gamma(s.normal, expected);
        found += !missing;
    }
    normal_quality q;
    q.points = errors.size();
    if (errors.empty()) return q;
    const auto n = static_cast<double>(errors.size());
    const auto percentile = [&](double share) {
        const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * n)) - 1;
        std::nth_element(errors.begin(), errors.begin() + rank, errors.end());
        return radians(errors[static_cast<std::size_t>(rank)]);
    };
    q.gamma = gammas / n;
    q.usable = static_cast<double>(found) / n;
    q.rms = radians(std::sqrt(squares / n));
    q.median = percentile(0.5);
    q.p90 = percentile(0.9);
    q.p99 = percentile(0.99);
    return q;
}

}  // namespace gnomon

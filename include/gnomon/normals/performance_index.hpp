// SPDX-License-Identifier: BSL-1.0
/// @file
/// The performance index of a normal estimator: the mean of its quality and its relative speed.
///
/// Klasing 2010, Sec. 3.2.6, Eq. (3.13).
#pragma once

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// pi = (gamma + wanted_time / mean_time) / 2: one for perfect normals in the wanted time, and
/// above one in less time.
///
/// @param gamma        mean quality, Eq. (3.12), 0 to 1
/// @param mean_time    t-bar, per normal
/// @param wanted_time  t-hat, the time per normal that the application requires, in the same unit;
///                     1 us in the thesis
/// @throws std::invalid_argument  unless times are positive and finite and gamma is in [0, 1]
[[nodiscard]] inline double performance_index(double gamma, double mean_time, double wanted_time) {
    detail::require(mean_time > 0.0 && std::isfinite(mean_time) && wanted_time > 0.0 &&
                        std::isfinite(wanted_time),
                    "performance_index: times must be positive and finite");
    detail::require(gamma >= 0.0 && gamma <= 1.0, "performance_index: gamma must be in [0, 1]");
    return 0.5 * gamma + 0.5 * (wanted_time / mean_time);
}

}  // namespace gnomon

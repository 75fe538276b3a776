// SPDX-License-Identifier: BSL-1.0
/// @file
/// What every estimator with a noise model asks of its noise.
#pragma once

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::detail {

/// @throws std::invalid_argument  unless sigma is positive and finite
inline void require_sigma(double sigma) {
    require(sigma > 0.0 && std::isfinite(sigma), "sigma must be positive and finite");
}

}  // namespace gnomon::detail

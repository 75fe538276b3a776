// SPDX-License-Identifier: BSL-1.0
/// @file
/// The check of the parameter sigma, common to all estimators with a noise model.
#pragma once

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::detail {

/// @throws std::invalid_argument  unless sigma is positive and finite
inline void require_sigma(double sigma) {
    require(sigma > 0.0 && std::isfinite(sigma), "sigma must be positive and finite");
}

}  // namespace gnomon::detail

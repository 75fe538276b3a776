// SPDX-License-Identifier: BSL-1.0
/// @file
/// The check of the parameter `noise`, common to all estimators that weigh measurements by it.
#pragma once

#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>

namespace gnomon::detail {

/// @throws std::invalid_argument  if there is no noise: measurements without an error have no
///                                finite weight
inline void require_noise(const noise_curve& noise) {
    require(!noise.is_zero(), "the noise must be greater than 0");
}

}  // namespace gnomon::detail

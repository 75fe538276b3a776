// SPDX-License-Identifier: BSL-1.0
/// @file
/// The check of planes and directions that are given.
#pragma once

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/plane.hpp>

namespace gnomon::detail {

/// @throws std::invalid_argument  unless the plane is in Hesse normal form
inline void require_hesse(const plane& p) {
    constexpr double rounding = 1e-6;  // numerical
    require(std::abs(dot(p.normal, p.normal) - 1.0) < rounding && std::isfinite(p.offset),
            "the normal of a plane, or the direction upwards, must be of unit length");
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How far the normal of a surface element can be used.
#pragma once

#include <concepts>

#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/trust.hpp>

namespace gnomon::detail {

/// The trust of a surface element if it has one; else `degenerate` or `good`, by whether its normal
/// is missing.
[[nodiscard]] trust trust_of_normal(const auto& element) {
    if constexpr (requires {
                      { element.trust } -> std::convertible_to<trust>;
                  }) {
        return element.trust;
    } else {
        return is_missing(element.normal) ? trust::degenerate : trust::good;
    }
}

}  // namespace gnomon::detail

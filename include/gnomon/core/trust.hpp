// SPDX-License-Identifier: BSL-1.0
/// @file
/// The quality flag of an estimate. A failure is a value in the result, so that one bad point
/// neither stops the processing of a scan nor passes for a good one.
#pragma once

#include <cstdint>

namespace gnomon {

/// Whether an estimate can be used, and if not, why.
enum class trust : std::uint8_t {
    good,               ///< determined by the data
    weak,               ///< usable, with a large error; each method documents its condition
    too_few_neighbors,  ///< fewer points than the method needs
    degenerate,         ///< the points do not determine an estimate (one place, a line, a ball)
    not_finite          ///< the point, or a number computed from it, is NaN or infinite
};

/// Returns true for `good` and `weak`. The normal of an unusable estimate is the zero vector.
[[nodiscard]] constexpr bool usable(trust t) { return t == trust::good || t == trust::weak; }

/// Returns the enumerator's name, for tables and messages.
[[nodiscard]] constexpr const char* to_string(trust t) {
    switch (t) {
        case trust::good:
            return "good";
        case trust::weak:
            return "weak";
        case trust::too_few_neighbors:
            return "too_few_neighbors";
        case trust::degenerate:
            return "degenerate";
        case trust::not_finite:
            return "not_finite";
    }
    return "unknown";
}

}  // namespace gnomon

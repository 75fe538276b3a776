// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a result is worth. A failure is a value that travels beside the number, so that one bad
/// point neither stops a scan nor passes for a good one.
#pragma once

#include <cstdint>

namespace gnomon {

/// Whether an estimate can be used, and if not, why.
enum class trust : std::uint8_t {
    good,               ///< determined by the data
    weak,               ///< usable, but known to be shaky; each method documents when it says so
    too_few_neighbors,  ///< fewer points than the method needs
    degenerate,         ///< the points do not determine an answer (one place, one line, a ball)
    not_finite          ///< the point itself, or something computed from it, is NaN or infinite
};

/// True for `good` and `weak`. The normal of an unusable estimate is the zero vector.
[[nodiscard]] constexpr bool usable(trust t) { return t == trust::good || t == trust::weak; }

/// The enumerator's name, for tables and messages.
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

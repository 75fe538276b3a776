// SPDX-License-Identifier: BSL-1.0
/// @file
/// How much of a scan and of a model is compared when an object is aligned and verified.
#pragma once

#include <cstddef>

namespace gnomon::recognition::detail {

/// What one alignment and its verification use. Numbers of cells, iterations and samples are chosen
/// for speed: results depend on them little.
struct alignment_effort {
    std::size_t cells;    ///< the most that are aligned
    bool all_samples;     ///< whether with all samples of the model, or with the coarse ones
    int iterations;       ///< the most of an alignment
    std::size_t samples;  ///< the most that are verified
    /// Between cells and samples that correspond at first [m]: within it, surfaces of neighbors
    /// pull an object away. Chosen on touching rooms of seeds 101 to 140, of .05 to .15 m.
    double max_distance;
    /// The same at the end [m]. Chosen likewise, on rooms of seeds 101 to 160 and 541 to 590, of
    /// .015 to .03 m.
    double last_distance;
};

/// From the place of votes or of a search, which is up to 10 cm off.
inline constexpr alignment_effort rough_effort{64, false, 15, 150, 0.15, 0.03};
/// From a start 8 cm next to a pose that was aligned.
inline constexpr alignment_effort repeated_effort{64, false, 15, 150, 0.08, 0.03};
/// For poses that were aligned roughly.
inline constexpr alignment_effort careful_effort{600, true, 50, 1000, 0.05, 0.02};

}  // namespace gnomon::recognition::detail

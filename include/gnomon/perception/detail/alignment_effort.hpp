// SPDX-License-Identifier: BSL-1.0
/// @file
/// How much of a scan and of a model is compared when an object is aligned and verified.
#pragma once

#include <cstddef>

namespace gnomon::recognition::detail {

/// Numbers of cells, iterations and samples are chosen for speed: results depend on them little.
struct alignment_effort {
    std::size_t cells;    ///< that are aligned
    bool all_samples;     ///< of the model, or the coarse ones, with which these are aligned
    int iterations;       ///< of an alignment
    std::size_t samples;  ///< that are verified
    /// Between cells and samples that correspond at first [m]. Surfaces of other objects that are
    /// as near pull an object away from where it is.
    double farthest;
};

/// From places that votes or a search give, which are up to 10 cm off; from these, if they are
/// less; from starts 8 cm next to a pose that was aligned before; and from such a pose itself.
/// Chosen for speed, the distances on touching rooms of seeds 101 to 160 and 541 to 590, of .05 to
/// .15 m.
inline constexpr alignment_effort rough_effort{64, false, 15, 150, 0.15},
    near_effort{64, false, 15, 150, 0.05}, repeated_effort{64, false, 15, 150, 0.08},
    careful_effort{600, true, 50, 1000, 0.05};

}  // namespace gnomon::recognition::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The options of a query on a `spatial_index`.
#pragma once

#include <gnomon/neighborhoods/metric.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon {

/// How a query measures and chooses.
struct search_options {
    gnomon::metric metric = {};  ///< `neighbor::squared_distance` is the square of this distance
    /// Found neighbors may be up to (1 + epsilon) times as far as the true ones, rank by rank; the
    /// search then reads fewer points. Not negative. Radii are exact all the same.
    double epsilon = 0.0;
    tie_rule ties = tie_rule::by_index;  ///< what happens to neighbors at equal distances
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The result of a search: a point by its index and how far it is.
#pragma once

#include <gnomon/core/point.hpp>

namespace gnomon {

/// A point found by a search. The canonical order is by distance, ties by index.
struct neighbor {
    double squared_distance;  ///< [m^2], of the metric of the search; by default squared_distance()
    point_index index;        ///< in the range of points

    friend bool operator==(const neighbor&, const neighbor&) = default;
    /// The nearer one is less; of equally near ones, that of the smaller index.
    friend bool operator<(const neighbor& a, const neighbor& b) {
        if (a.squared_distance != b.squared_distance)
            return a.squared_distance < b.squared_distance;
        return a.index < b.index;
    }
};

/// Which of several points at the distance of the k-th neighbor are returned.
enum class tie_rule : bool {
    by_index,  ///< exactly k neighbors: of equals those of smaller index
    /// All of them, up to 2 k neighbors in total; distances are equal if their squares differ by
    /// less than 1e-9 of their value. The result then depends neither on the order of the points
    /// nor on a rigid motion of the cloud, except for the rounding of the moved coordinates. Clouds
    /// of depth cameras, whose ranges are quantized, have many ties.
    all
};

}  // namespace gnomon

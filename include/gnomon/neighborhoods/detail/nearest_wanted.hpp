// SPDX-License-Identifier: BSL-1.0
/// @file
/// A query for the nearest neighbors of many points.
#pragma once

#include <cstddef>
#include <limits>

#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// The k nearest neighbors, and those that the rule adds, none beyond a radius.
struct nearest_wanted {
    std::size_t k;
    tie_rule ties = tie_rule::by_index;
    double radius = std::numeric_limits<double>::infinity();  // [m]
    const place_set* of = nullptr;  // the points whose neighbors are searched for; all, if null
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The options of extremely randomized trees.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon::recognition {

/// Options of extremely randomized trees.
struct random_trees_options {
    std::size_t trees = 200;  ///< more are better, and take longer
    std::uint64_t seed = 1;   ///< the same one gives the same trees
    /// Features that are tried at each node; 0 stands for twice the square root of
    /// their number: more than usual, as descriptions of views have features that are alike (chosen
    /// on furniture_models(), seeds 1 and 2).
    std::size_t features_per_split = 0;
    std::size_t min_split = 2;  ///< nodes of fewer samples are leaves
};

}  // namespace gnomon::recognition

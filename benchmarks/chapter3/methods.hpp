// SPDX-License-Identifier: BSL-1.0
/// @file
/// The estimators of the registry behind one type, so that they are compiled once for all figures.
/// What is hidden is a whole pass over a cloud: calling it costs nothing that counts.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clouds.hpp"
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/normals/normal_quality.hpp>

struct method {
    std::string name;  ///< in the registry
    /// Estimates all normals once, on one thread, and discards them. sigma [m] is passed to methods
    /// that use it.
    std::function<void(const labeled_cloud&, const gnomon::adjacency&, double sigma)> pass;
    /// The quality of all normals.
    std::function<gnomon::normal_quality(const labeled_cloud&, const gnomon::adjacency&,
                                         double sigma)>
        quality;
};

/// The seven of Tabs. 3.1 and 3.2, in their order.
std::vector<method> thesis_methods();

/// Those of these names, in this order.
/// @throws std::invalid_argument  for a name that the registry does not know
std::vector<method> methods(const std::vector<std::string>& names);

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The objects that a finder knows, by their numbers.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/recognition/surface_model.hpp>

namespace gnomon::recognition::detail {

/// Names and surfaces of objects.
struct known_objects {
    std::vector<std::string> names;
    std::vector<surface_model> surfaces;  ///< as many

    /// Adds an object, or nothing if it throws.
    /// @return its number
    /// @throws std::invalid_argument  if it has no name, or that of background, or if its surface
    ///                                has no samples, or some too far apart or below the ground
    std::size_t add(std::string name, surface_model surface) {
        using gnomon::detail::require;
        constexpr double most_apart = 0.03;  // [m]; chosen: less than a voxel of a search
        constexpr double deepest = 0.10;     // [m]; chosen: more than floors are uneven
        require(!name.empty(), "object_finder: an object needs a name");
        require(name != background_name, "object_finder: an object has the name of background");
        require(surface.points().size() > 0, "object_finder: the surface has no samples");
        require(surface.spacing() <= most_apart,
                "object_finder: samples of the surface must be at most 3 cm apart");
        require(surface.low().z() >= -deepest,
                "object_finder: the surface is more than 10 cm below the ground, where z = 0");
        names.reserve(names.size() + 1);  // so that memory cannot lack between the two
        surfaces.push_back(std::move(surface));
        names.push_back(std::move(name));
        return names.size() - 1;
    }
};

}  // namespace gnomon::recognition::detail

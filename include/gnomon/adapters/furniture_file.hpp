// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads furniture models from mesh files, to stand next to the built-in ones of
/// furniture_models(): a model for recognition, or a piece of a room. Link with gnomon::assimp.
#pragma once

#include <algorithm>
#include <string>
#include <variant>

#include <Eigen/Core>

#include <gnomon/adapters/assimp_scene.hpp>
#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

/// The axis of a file that points up. Most OBJ and STL files of CAD programs have z, glTF and most
/// files of programs for animation y; no format of these but glTF determines it.
enum class up_axis : char { z, y };

namespace detail {

/// The longest edges of furniture [m], chosen: from a small box to a wall unit; a file in
/// centimetres, millimetres or inches lies outside.
inline constexpr double smallest_furniture = 0.05;
inline constexpr double largest_furniture = 5.0;

/// A length [m] in a message.
[[nodiscard]] inline std::string in_metres(double length) {
    std::string text = std::to_string(length);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + " m";
}

}  // namespace detail

/// Reads a furniture model from a mesh file with coordinates in metres (COLLADA: in its own unit).
/// It is turned upright, set on the floor z = 0, and the middle of its bounds placed on the z axis.
/// Its name is that of the file without folder and extension; each named group of the file is a
/// part. O(n log n).
///
///     const auto models = std::vector{read_furniture("chair.obj"),
///                                     read_furniture("table.glb", up_axis::y)};
///
/// @throws gnomon::error  as read_scene() does: if the file cannot be read, contains no triangle,
///                        or is invalid; if the longest edge of the bounds is shorter than 5 cm or
///                        longer than 5 m, as for coordinates in another unit
[[nodiscard]] inline furniture_model read_furniture(const std::string& path,
                                                    up_axis up = up_axis::z) {
    const scene file = read_scene(path, mesh_groups::parts);
    pose upright = up == up_axis::y ? roll(degrees(90)) : pose{};
    scene turned;
    add(turned, file, upright);
    const bounds extent = turned.extent();
    const Eigen::Vector3d size = extent.size();
    const double longest = std::max({size.x(), size.y(), size.z()});
    if (!(longest >= detail::smallest_furniture && longest <= detail::largest_furniture)) {
        throw error(path, "",
                    "furniture in metres is " + detail::in_metres(detail::smallest_furniture) +
                        " to " + detail::in_metres(detail::largest_furniture) +
                        " long, this model " + detail::in_metres(longest));
    }
    const Eigen::Vector3d middle = extent.middle();
    upright.position = {-middle.x(), -middle.y(), -extent.low.z()};
    furniture_model model{file.objects().front(), scene{}};
    add(std::get<scene>(model.piece), file, upright);
    return model;
}

}  // namespace gnomon::simulation

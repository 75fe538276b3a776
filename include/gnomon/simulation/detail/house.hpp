// SPDX-License-Identifier: BSL-1.0
/// @file
/// Houses of a street: a facade with recessed windows and a door, gables and a pitched roof. The
/// wall of the facade is one surface, without its recesses.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/simulation/detail/mesh_builder.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace gnomon::simulation::detail {

/// A house. Its frame lies on the ground at an end of the facade: x runs along the facade, y into
/// the house. Lengths in [m].
struct house {
    double width = 10.0;   ///< of the facade
    double depth = 9.0;    ///< along y
    double eaves = 6.0;    ///< height of the facade
    double ridge = 9.0;    ///< height of the roof
    double recess = 0.15;  ///< of windows and door behind the wall
    int storeys = 2;       ///< rows of windows
    int bays = 4;          ///< columns of windows
    int door = 1;          ///< number of the bay of the door, from 0
    bool openings = true;  ///< without them the facade is a rectangle
    double window_width = 1.2;
    double sill = 0.9;    ///< height of the lower edge of a window above its storey
    double lintel = 2.3;  ///< height of the upper edge of windows and door above their storey

    /// The middle of a bay, along x.
    [[nodiscard]] double middle_of(int bay) const { return (bay + 0.5) * width / bays; }
};

/// A rectangle of a facade [m].
struct facade_cell {
    double left;
    double right;
    double low;
    double high;
};

/// Adds an opening: a pane behind the wall with the given name, and what connects them.
inline void add_recess(mesh_builder& b, const std::string& name, const facade_cell& c,
                       double depth) {
    const auto corner = [](double x, double y, double z) { return Eigen::Vector3d(x, y, z); };
    const auto level = [&](const char* side, double z) {
        b.surface(name + side)
            .face({corner(c.left, 0.0, z), corner(c.right, 0.0, z), corner(c.right, depth, z),
                   corner(c.left, depth, z)});
    };
    const auto upright = [&](const char* side, double x) {
        b.surface(name + side)
            .face({corner(x, 0.0, c.low), corner(x, depth, c.low), corner(x, depth, c.high),
                   corner(x, 0.0, c.high)});
    };
    b.surface(name).face({corner(c.left, depth, c.low), corner(c.right, depth, c.low),
                          corner(c.right, depth, c.high), corner(c.left, depth, c.high)});
    upright(" left", c.left);
    upright(" right", c.right);
    level(" lintel", c.high);
    // Below a door lies the ground.
    if (c.low > 0.0) level(" sill", c.low);
}

/// The facade in the plane y = 0: a grid of cells, of which those in odd rows and columns are open.
[[nodiscard]] inline triangle_mesh facade_of(const house& h) {
    std::vector<double> x{0.0}, z{0.0};
    for (int bay = 0; bay < h.bays; ++bay) {
        x.push_back(h.middle_of(bay) - 0.5 * h.window_width);
        x.push_back(h.middle_of(bay) + 0.5 * h.window_width);
    }
    x.push_back(h.width);
    for (int storey = 0; storey < h.storeys; ++storey) {
        z.push_back(storey * h.eaves / h.storeys + h.sill);
        z.push_back(storey * h.eaves / h.storeys + h.lintel);
    }
    z.push_back(h.eaves);

    mesh_builder wall;
    wall.surface("wall");
    if (!h.openings) {
        wall.face({Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(h.width, 0.0, 0.0),
                   Eigen::Vector3d(h.width, 0.0, h.eaves), Eigen::Vector3d(0.0, 0.0, h.eaves)});
        return wall.mesh();
    }
    std::vector<facade_cell> windows;
    const auto door = static_cast<std::size_t>(2 * h.door + 1);
    for (std::size_t row = 0; row + 1 < z.size(); ++row) {
        for (std::size_t column = 0; column + 1 < x.size(); ++column) {
            if (column == door && row < 2) continue;
            const facade_cell c{x[column], x[column + 1], z[row], z[row + 1]};
            if (row % 2 == 1 && column % 2 == 1) {
                windows.push_back(c);
            } else {
                wall.face(
                    {Eigen::Vector3d(c.left, 0.0, c.low), Eigen::Vector3d(c.right, 0.0, c.low),
                     Eigen::Vector3d(c.right, 0.0, c.high), Eigen::Vector3d(c.left, 0.0, c.high)});
            }
        }
    }
    add_recess(wall, "door", {x[door], x[door + 1], 0.0, h.lintel}, h.recess);
    int number = 0;
    for (const facade_cell& c : windows)
        add_recess(wall, numbered("window", ++number), c, h.recess);
    return wall.mesh();
}

/// The sides and the roof of a house.
[[nodiscard]] inline triangle_mesh shell_of(const house& h) {
    const double middle = 0.5 * h.depth;
    const auto gable = [&](double x) {
        return std::vector<Eigen::Vector3d>{{x, 0.0, 0.0},
                                            {x, h.depth, 0.0},
                                            {x, h.depth, h.eaves},
                                            {x, middle, h.ridge},
                                            {x, 0.0, h.eaves}};
    };
    const auto left = gable(0.0), right = gable(h.width);
    mesh_builder b;
    b.surface("left").face(left).surface("right").face(right);
    b.surface("back").face({left[1], right[1], right[2], left[2]});
    b.surface("roof back").face({left[2], right[2], right[3], left[3]});
    b.surface("roof front").face({left[3], right[3], right[4], left[4]});
    return b.mesh();
}

/// Adds a house with the parts "facade" (surfaces "wall", "door", "window 1", ..., and for each
/// opening its "left", "right", "lintel" and, of windows, "sill") and "shell" ("left", "right",
/// "back", "roof back", "roof front").
inline void add_house(scene& world, std::string name, const house& h, const pose& at) {
    const std::int32_t object = world.add_object(std::move(name));
    world.add(world.add_part(object, "facade"), facade_of(h), at);
    world.add(world.add_part(object, "shell"), shell_of(h), at);
}

}  // namespace gnomon::simulation::detail

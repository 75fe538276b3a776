// SPDX-License-Identifier: BSL-1.0
/// @file
/// The twelve shapes of the tables, and one that is smooth. `feature_preserving` was tuned on the
/// first six, while the others were left alone until its parameters stood.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "mesh.hpp"
#include "primitives.hpp"
#include "sampling.hpp"
#include "solid.hpp"

namespace known_normals {

namespace shapes {

/// A rounded cube with three crossing bores, the textbook's example of solid geometry.
inline solid classic() {
    return (box({-.75, -.75, -.75}, {.75, .75, .75}) & ball({0, 0, 0}, 1)) -
           cylinder({-1, 0, 0}, {1, 0, 0}, .4) - cylinder({0, -1, 0}, {0, 1, 0}, .4) -
           cylinder({0, 0, -1}, {0, 0, 1}, .4);
}

/// Two that are linked, and a small sphere.
inline solid tori() {
    return torus({0, 0, 0}, {0, 0, 1}, 1, .35) | torus({1, 0, 0}, {0, 1, 0}, .9, .12) |
           ball({-.35, 0, 0}, .2);
}

/// A plate with eight thin fins.
inline solid heat_sink() {
    solid s = box({-1, -.7, -.2}, {1, .7, 0});
    for (int i = 0; i < 8; ++i) {
        const double x = -.9 + .25 * i;
        s = s | box({x, -.65, -.1}, {x + .05, .65, .8});
    }
    return s;
}

/// Forty spheres.
inline solid clump() {
    dice d(7);
    std::optional<solid> s;
    for (int i = 0; i < 40;) {
        const Vector3d center = d.in_cube(-.8, .8);
        if (center.norm() >= .8) continue;
        const solid one = ball(center, d.uniform(.15, .4));
        s = s ? *s | one : one;
        ++i;
    }
    return *s;
}

/// Two plates, a rib hollowed out to a fillet, three bores and a countersink.
inline solid bracket() {
    const solid fillet =
        box({.1, -.5, .1}, {.75, .5, .75}) - cylinder({.75, -1, .75}, {.75, 1, .75}, .5);
    return (box({0, -.6, 0}, {1.6, .6, .25}) | box({0, -.55, .1}, {.25, .55, 1.4}) | fillet) -
           cylinder({1.2, .3, -1}, {1.2, .3, 1}, .12) -
           cylinder({1.2, -.3, -1}, {1.2, -.3, 1}, .12) -
           frustum({1.2, -.3, .1}, .05, {1.2, -.3, .3}, .25) -
           cylinder({-1, 0, 1.05}, {1, 0, 1.05}, .2);
}

/// Three crossing bars that end in balls and cones.
inline solid jack() {
    return cylinder({-1, 0, 0}, {1, 0, 0}, .18) | cylinder({0, -1, 0}, {0, 1, 0}, .16) |
           cylinder({0, 0, -.7}, {0, 0, .7}, .2) | ball({1, 0, 0}, .3) | ball({-1, 0, 0}, .25) |
           ball({0, 1, 0}, .3) | ball({0, -1, 0}, .25) | frustum({0, 0, .65}, .35, {0, 0, 1.3}, 0) |
           frustum({0, 0, -.65}, .3, {0, 0, -1.2}, .1);
}

/// A cup of thin walls, with a handle.
inline solid mug() {
    return (cylinder({0, 0, 0}, {0, 0, 1.8}, .8) | torus({.8, 0, .9}, {0, 1, 0}, .5, .1)) -
           cylinder({0, 0, .1}, {0, 0, 2}, .74);
}

/// Fourteen teeth, a conical hub, a bore and six holes.
inline solid gear() {
    solid s = (cylinder({0, 0, -.2}, {0, 0, .2}, .8) | frustum({0, 0, .1}, .5, {0, 0, .5}, .4)) -
              cylinder({0, 0, -1}, {0, 0, 1}, .25);
    for (int i = 0; i < 6; ++i) {
        const double turn = i * std::numbers::pi / 3;
        const Vector3d center(.62 * std::cos(turn), .62 * std::sin(turn), 0);
        s = s - cylinder(center - Vector3d(0, 0, .5), center + Vector3d(0, 0, .5), .08);
    }
    const solid tooth = box({.7, -.09, -.18}, {1.05, .09, .18});
    for (int i = 0; i < 14; ++i) {
        const Eigen::AngleAxisd turn(i * std::numbers::pi / 7, Vector3d::UnitZ());
        s = s | turned(tooth, turn.toRotationMatrix());
    }
    return s;
}

/// With edges and corners rounded, a bore and a dimple.
inline solid rounded_box() {
    constexpr double radius = .25;
    const Vector3d whole(.8, .6, .45);
    const Vector3d core = whole - Vector3d(radius, radius, radius);
    std::optional<solid> s;
    for (int a = 0; a < 3; ++a) {
        Vector3d corner = core;
        corner[a] = whole[a];
        s = s ? *s | box(-corner, corner) : box(-corner, corner);
        for (unsigned i = 0; i < 4; ++i) {
            Vector3d end = core;
            if ((i & 1) == 0) end[(a + 1) % 3] *= -1;
            if ((i & 2) == 0) end[(a + 2) % 3] *= -1;
            Vector3d other = end;
            other[a] = -end[a];
            s = *s | cylinder(end, other, radius);
        }
    }
    for (unsigned i = 0; i < 8; ++i) {
        const Vector3d sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
        s = *s | ball(sign.cwiseProduct(core), radius);
    }
    return *s - cylinder({.3, 0, -1}, {.3, 0, 1}, .18) - ball({-.3, 0, .55}, .3);
}

/// Smooth: four tori of different thickness, and two balls.
inline solid hoops() {
    return torus({0, 0, 0}, {0, 0, 1}, 1, .3) | torus({0, 0, .6}, {.1, 0, 1}, .6, .15) |
           torus({0, 0, -.8}, {0, 0, 1}, .7, .4) | torus({0, 0, 1.1}, {0, .2, 1}, .4, .1) |
           ball({0, 0, 1.7}, .3) | ball({1.8, 0, 0}, .4);
}

}  // namespace shapes

/// What a shape is for. Those held out were untouched until the parameters stood.
enum class part : unsigned { tuning, held_out, smooth };

/// A shape of the list.
struct shape {
    const char* name;
    part of_list;                     ///< what it is for
    std::uint64_t seed;               ///< of its clouds
    std::optional<surface> boundary;  ///< nothing if it is a mesh that cannot be read
};

/// @param meshes  the folder with the three that are mesh files
inline std::vector<shape> all_shapes(const std::string& meshes) {
    const auto mesh = [&](const char* file) { return mesh_surface(meshes + "/" + file); };
    return {
        {"classic", part::tuning, 100, surface_of(shapes::classic())},
        {"tori", part::tuning, 101, surface_of(shapes::tori())},
        {"heat_sink", part::tuning, 102, surface_of(shapes::heat_sink())},
        {"clump", part::tuning, 103, surface_of(shapes::clump())},
        {"bracket", part::tuning, 104, surface_of(shapes::bracket())},
        {"octagonal_pocket", part::tuning, 105, mesh("octagonal_pocket.stl")},
        {"jack", part::held_out, 106, surface_of(shapes::jack())},
        {"mug", part::held_out, 107, surface_of(shapes::mug())},
        {"gear", part::held_out, 108, surface_of(shapes::gear())},
        {"rounded_box", part::held_out, 109, surface_of(shapes::rounded_box())},
        {"featuretype", part::held_out, 110, mesh("featuretype.stl")},
        {"wingnut", part::held_out, 111, mesh("wingnut.obj")},
        {"hoops", part::smooth, 112, surface_of(shapes::hoops())},
    };
}

}  // namespace known_normals

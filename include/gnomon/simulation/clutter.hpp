// SPDX-License-Identifier: BSL-1.0
/// @file
/// Models of things that are no furniture, to put background into rooms and to learn it from:
/// cartons, plants, bins, bags, shelves with things on them, and curtains, each of a random size.
///
///     for (const auto& model : gnomon::simulation::clutter_models(24, 1)) use(model.name);
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/detail/greenery.hpp>
#include <gnomon/simulation/detail/mesh_builder.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/sphere.hpp>
#include <gnomon/simulation/surface_of_revolution.hpp>

namespace gnomon::simulation {

namespace detail {

// The sizes of all pieces are those usual in homes and offices; heights are 0.3 to 1.8 m.

/// One to three boxes on each other, the upper ones not larger.
[[nodiscard]] inline scene cartons(random_stream& random) {
    scene piece;
    const auto object = piece.add_object("carton");
    const auto count = 1 + random.below(3);
    double length = random.uniform(0.30, 0.60), width = random.uniform(0.25, 0.45), low = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const double height = count == 1 ? random.uniform(0.30, 0.60) : random.uniform(0.18, 0.38);
        piece.add(piece.add_part(object, numbered("box", static_cast<int>(i) + 1)),
                  box{length, width, height},
                  at(0.0, 0.0, low + 0.5 * height) * yaw(degrees(random.uniform(-8.0, 8.0))));
        low += height;
        length *= random.uniform(0.75, 0.95);
        width *= random.uniform(0.75, 0.95);
    }
    return piece;
}

/// A conical bucket, open at the top.
[[nodiscard]] inline surface_of_revolution bucket(double bottom, double top, double height) {
    return surface_of_revolution({{bottom, 0.0}, {top, height}}, {.smooth = false});
}

[[nodiscard]] inline scene bin(random_stream& random) {
    scene piece;
    const double bottom = random.uniform(0.10, 0.18);
    piece.add_object("bin",
                     bucket(bottom, bottom * random.uniform(1.0, 1.4), random.uniform(0.30, 0.75)));
    return piece;
}

/// A sack that is tied up.
[[nodiscard]] inline scene bag(random_stream& random) {
    scene piece;
    const double r = random.uniform(0.14, 0.26), h = random.uniform(0.30, 0.60);
    piece.add_object("bag", surface_of_revolution({{0.80 * r, 0.0},
                                                   {r, 0.25 * h},
                                                   {0.85 * r, 0.60 * h},
                                                   {0.25 * r, 0.88 * h},
                                                   {0.40 * r, h}}));
    return piece;
}

/// A pot with a stem and a crown of leaves or, like a cactus, of spheres.
[[nodiscard]] inline scene plant(random_stream& random) {
    scene piece;
    const auto object = piece.add_object("plant");
    const double pot = random.uniform(0.18, 0.32), height = random.uniform(0.55, 1.80);
    const double radius = random.uniform(0.15, std::min(0.35, 0.48 * (height - pot)));
    const double half = std::min(0.5 * (height - pot), radius * random.uniform(1.0, 1.6));
    const double middle = height - half;
    const double edge = random.uniform(0.6, 0.9) * pot;  // of the pot
    piece.add(piece.add_part(object, "pot"), bucket(0.4 * edge, 0.5 * edge, pot));
    piece.add(piece.add_part(object, "stem"), cylinder{0.012, middle});
    const auto crown = piece.add_part(object, "crown");
    const auto inside = [&](double reach) {
        const Eigen::Vector3d way = any_attitude(random).direction_out({0.0, 0.0, 1.0});
        const double share = reach * std::cbrt(random.uniform());
        return Eigen::Vector3d(way.x() * radius * share, way.y() * radius * share,
                               middle + way.z() * half * share);
    };
    if (random.uniform() < 0.75) {
        constexpr double leaf = 0.07, per_meter = 8.0;  // edge [m]; crossed by a ray [1/m]
        // Leaves of any attitude reach beyond their middles by half a diagonal.
        const double most = 1.0 - 0.71 * leaf / std::min(radius, half);
        const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * half;
        piece.add(crown, foliage(random, volume, per_meter, leaf, [&] { return inside(most); }));
    } else {
        for (int i = 0; i < 5; ++i) {
            const Eigen::Vector3d p = inside(0.5);
            piece.add(crown, sphere{0.5 * std::min(radius, half)}, at(p.x(), p.y(), p.z()));
        }
    }
    return piece;
}

/// Boards between two sides, open in front and behind, with books and boxes on them.
[[nodiscard]] inline scene shelf(random_stream& random) {
    scene piece;
    const double depth = random.uniform(0.25, 0.36), width = random.uniform(0.50, 1.00),
                 height = random.uniform(0.80, 1.75);
    constexpr double thick = 0.02;  // [m]
    object_builder b(piece, "shelf", {});
    b.part("sides").block(0.0, -0.5 * (width - thick), depth, thick, 0.0, height);
    b.block(0.0, 0.5 * (width - thick), depth, thick, 0.0, height);
    b.part("boards");
    const int boards = static_cast<int>(height / 0.36) + 1;
    const double inside = width - 2.0 * thick, step = (height - 0.06 - thick) / (boards - 1);
    for (int i = 0; i < boards; ++i)
        b.block(0.0, 0.0, depth, inside, 0.06 + i * step, 0.06 + i * step + thick);
    b.part("things");
    for (int i = 0; i + 1 < boards; ++i) {
        const double low = 0.06 + i * step + thick, most = step - thick - 0.02;
        for (double y = -0.5 * inside + 0.01;;) {
            const double wide = random.uniform(0.03, 0.22),
                         deep = random.uniform(0.5, 0.95) * depth,
                         high = random.uniform(0.4, 1.0) * most;
            if (y + wide > 0.5 * inside - 0.01) break;
            // A quarter of the board stays empty.
            if (random.uniform() < 0.75)
                b.block(0.5 * (deep - depth), y + 0.5 * wide, deep, wide, low, low + high);
            y += wide + 0.01;
        }
    }
    return piece;
}

/// A cloth in vertical folds along y, behind which, at the lower x, is the wall.
[[nodiscard]] inline scene curtain(random_stream& random) {
    const double width = random.uniform(0.50, 1.30), low = random.uniform(0.02, 0.15),
                 high = random.uniform(1.40, 1.80), depth = random.uniform(0.03, 0.06);
    const double folds = std::round(width / random.uniform(0.12, 0.25));
    constexpr int strips = 8;  // plane ones of a fold
    const int count = strips * static_cast<int>(folds);
    const auto edge = [&](int i, double z) {
        const double share = static_cast<double>(i) / count;
        const double phase = 2.0 * std::numbers::pi * folds * share;
        return Eigen::Vector3d(depth * std::sin(phase), (share - 0.5) * width, z);
    };
    mesh_builder b;
    b.surface("cloth");
    for (int i = 0; i < count; ++i)
        b.face({edge(i, low), edge(i + 1, low), edge(i + 1, high), edge(i, high)});
    scene piece;
    piece.add_object("curtain", b.mesh());
    return piece;
}

/// Whether a piece of clutter stands or hangs at a wall, which is at its lower x.
[[nodiscard]] inline bool belongs_to_wall(const furniture_model& model) {
    return model.name == "shelf" || model.name == "curtain";
}

}  // namespace detail

/// Pieces of clutter by the names "carton", "plant", "bin", "bag", "shelf" and "curtain", in turns
/// and with random sizes, 0.3 to 1.8 m high. Frames are those of furniture; shelves and curtains
/// have the wall at their lower x.
///
/// More pieces do not change those that are there. Complexity: O(pieces).
[[nodiscard]] inline std::vector<furniture_model> clutter_models(std::size_t pieces,
                                                                 std::uint64_t seed) {
    struct kind {
        const char* name;
        scene (*make)(random_stream&);
    };
    static constexpr std::array<kind, 8> kinds{{{"carton", detail::cartons},
                                                {"plant", detail::plant},
                                                {"shelf", detail::shelf},
                                                {"bin", detail::bin},
                                                {"carton", detail::cartons},
                                                {"bag", detail::bag},
                                                {"curtain", detail::curtain},
                                                {"plant", detail::plant}}};
    std::vector<furniture_model> all;
    for (std::size_t i = 0; i < pieces; ++i) {
        random_stream random(seed, i);
        const kind& k = kinds[i % kinds.size()];
        all.push_back({k.name, k.make(random)});
    }
    return all;
}

}  // namespace gnomon::simulation

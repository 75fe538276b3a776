// SPDX-License-Identifier: BSL-1.0
/// @file
/// Models of office chairs, to learn what stands in offices: five feet about a column, a seat and a
/// back, many with arms, some with a headrest, each of a random size.
///
///     for (const auto& model : gnomon::simulation::office_chairs(8, 1)) learn(model);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

namespace detail {

/// One of random sizes, within those that are usual; none was measured on a scan.
[[nodiscard]] inline scene office_chair(random_stream& random) {
    scene piece;
    const auto object = piece.add_object("office chair");
    const auto add = [&](const char* part, const Eigen::Vector3d& size, const pose& at) {
        piece.add(piece.add_part(object, part), box{size.x(), size.y(), size.z()}, at);
    };
    const double height = random.uniform(0.42, 0.52), side = random.uniform(0.44, 0.54),
                 thickness = random.uniform(0.06, 0.10), foot = random.uniform(0.26, 0.34),
                 turn = random.uniform(0.0, 72.0);
    constexpr int feet = 5;
    for (int f = 0; f < feet; ++f)
        add("foot", {foot, 0.05, 0.04}, yaw(degrees(turn + 72.0 * f)) * at(0.5 * foot, 0.0, 0.07));
    constexpr double low = 0.08;  // of the column [m]
    piece.add(piece.add_part(object, "column"), cylinder{0.035, height - thickness - low},
              at(0.0, 0.0, low));
    add("seat", {side, side, thickness}, at(0.0, 0.0, height - 0.5 * thickness));

    const double gap = random.uniform(0.02, 0.15), back = random.uniform(0.45, 0.70),
                 lean = random.uniform(0.0, 12.0), width = side * random.uniform(0.85, 1.0);
    const pose behind = at(-0.5 * side - 0.06, 0.0, height + gap) * pitch(degrees(-lean));
    add("back", {0.06, width, back}, behind * at(0.0, 0.0, 0.5 * back));
    add("bar", {0.04, 0.08, gap + 0.10}, at(-0.5 * side - 0.02, 0.0, height + 0.5 * gap));
    if (random.uniform(0.0, 1.0) < 0.7) {
        const double rise = random.uniform(0.18, 0.24);
        for (const double y : {-0.5 * side - 0.04, 0.5 * side + 0.04}) {
            add("arm", {0.30, 0.06, 0.03}, at(0.0, y, height + rise));
            add("post", {0.06, 0.03, rise + 0.04}, at(0.0, y, height - 0.04 + 0.5 * rise));
        }
    }
    if (random.uniform(0.0, 1.0) < 0.5)
        add("headrest", {0.06, 0.28, 0.16}, behind * at(0.0, 0.0, back + 0.12));
    return piece;
}

}  // namespace detail

/// Office chairs of random sizes, all by the name "office chair", in the frame of furniture: they
/// stand on z = 0 and face the x axis. More of them do not change those that are there.
/// Complexity: O(n).
[[nodiscard]] inline std::vector<furniture_model> office_chairs(std::size_t n, std::uint64_t seed) {
    std::vector<furniture_model> all;
    for (std::size_t i = 0; i < n; ++i) {
        random_stream random(seed, i);
        all.push_back({"office chair", detail::office_chair(random)});
    }
    return all;
}

}  // namespace gnomon::simulation

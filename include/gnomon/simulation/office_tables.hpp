// SPDX-License-Identifier: BSL-1.0
/// @file
/// Models of desks and side tables, to learn what stands in offices: on legs or panels, each of a
/// random size, most with things on them, as real ones have in scans.
///
///     for (const auto& model : gnomon::simulation::office_tables(16, 1)) learn(model);
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/table.hpp>

namespace gnomon::simulation {

namespace detail {

// The sizes are those usual in homes and offices. That desks may be as long, and carry things, was
// chosen after a scan of an office (docs/results/chapter5.md) with a desk of 2.45 m.

/// A desk, or a side table, which is lower and may have a shelf.
[[nodiscard]] inline table office_table(random_stream& random, bool is_desk) {
    table t;
    t.length = is_desk ? random.uniform(1.2, 2.6) : random.uniform(0.5, 1.2);
    t.width = std::min(t.length, is_desk ? random.uniform(0.6, 1.1) : random.uniform(0.45, 0.80));
    t.height = is_desk ? random.uniform(0.68, 0.78) : random.uniform(0.38, 0.62);
    t.thickness = random.uniform(0.02, 0.06);
    t.inset = random.uniform(0.0, 0.08);
    t.leg = random.uniform(0.025, 0.070);
    t.base = random.uniform() < 0.5 ? table_base::legs : table_base::panels;
    if (!is_desk && random.uniform() < 0.5) t.shelf_height = random.uniform(0.12, 0.5 * t.height);
    return t;
}

/// Puts boxes on a table, most of them flat as papers and keyboards, the others as high as screens.
/// They may intersect.
inline void add_things(scene& world, std::int32_t object, const table& on, std::uint64_t count,
                       random_stream& random) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const double length = random.uniform(0.05, std::min(0.50, 0.5 * on.length)),
                     width = random.uniform(0.05, std::min(0.35, 0.5 * on.width));
        const bool is_flat = random.uniform() < 0.6;
        const double height = is_flat ? random.uniform(0.01, 0.08) : random.uniform(0.08, 0.40);
        const double x = random.uniform(-0.5, 0.5) * (on.length - length),
                     y = random.uniform(-0.5, 0.5) * (on.width - width);
        world.add(world.add_part(object, numbered("thing", static_cast<int>(i) + 1)),
                  box{length, width, height}, at(x, y, on.height + 0.5 * height));
    }
}

}  // namespace detail

/// Desks and side tables, alternating, all by the name "office table", in the frame of furniture:
/// they stand on z = 0, their length along x. Up to five things are on a desk, up to two on a side
/// table, as parts of it. More tables do not change those that are there.
/// Complexity: O(n).
[[nodiscard]] inline std::vector<furniture_model> office_tables(std::size_t n, std::uint64_t seed) {
    std::vector<furniture_model> all;
    for (std::size_t i = 0; i < n; ++i) {
        random_stream random(seed, i);
        const bool is_desk = i % 2 == 0;
        const table t = detail::office_table(random, is_desk);
        scene piece;
        const std::int32_t object = add(piece, "office table", t);
        detail::add_things(piece, object, t, random.below(is_desk ? 6 : 3), random);
        all.push_back({"office table", std::move(piece)});
    }
    return all;
}

}  // namespace gnomon::simulation

// SPDX-License-Identifier: BSL-1.0
/// @file
/// A piece of furniture, or a model, alone in a scene: its parts and its measures.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/scene.hpp>

namespace furnished {

namespace sim = gnomon::simulation;

/// The scene of this piece.
sim::scene scene_of(const auto& piece) {
    sim::scene world;
    add(world, "piece", piece);
    return world;
}

inline sim::scene scene_of(const sim::furniture_model& model) {
    sim::scene world;
    sim::add(world, model);
    return world;
}

std::set<std::string> parts_of(const auto& piece) {
    const sim::scene world = scene_of(piece);
    std::set<std::string> parts;
    for (const auto& part : world.parts()) parts.insert(part.name);
    return parts;
}

void expect_extent(const auto& piece, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const sim::bounds extent = scene_of(piece).extent();
    EXPECT_LT((extent.low - low).norm(), 1e-9);
    EXPECT_LT((extent.high - high).norm(), 1e-9);
}

/// Twice the piece has twice the measures, shape by shape.
void expect_scales(const auto& piece) {
    const sim::scene once = scene_of(piece);
    const sim::scene twice = scene_of(scaled(piece, 2.0));
    ASSERT_EQ(once.shapes().size(), twice.shapes().size());
    for (std::size_t i = 0; i < once.shapes().size(); ++i) {
        const sim::bounds& a = once.shapes()[i].extent;
        const sim::bounds& b = twice.shapes()[i].extent;
        EXPECT_LT((2.0 * a.low - b.low).norm(), 1e-9);
        EXPECT_LT((2.0 * a.high - b.high).norm(), 1e-9);
    }
}

}  // namespace furnished

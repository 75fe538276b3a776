// SPDX-License-Identifier: BSL-1.0
/// @file
/// The ray caster without dependencies: a bounding volume hierarchy over the shapes of a scene.
/// Each mesh has a hierarchy of its own over its triangles.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <gnomon/simulation/detail/bvh.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// Models `ray_caster`, in double precision. Where a ray meets two surfaces at the same range, as
/// at edges, either is reported, deterministically.
class bvh_caster {
  public:
    /// Keeps the shapes of `world`, not the scene. O(n log n).
    explicit bvh_caster(const scene& world) : shapes_(world.shapes()) {
        std::vector<bounds> boxes;
        boxes.reserve(shapes_.size());
        for (const placed_shape& s : shapes_) boxes.push_back(s.extent);
        tree_ = detail::bvh(boxes);
    }

    /// O(log n) on average.
    [[nodiscard]] std::optional<ray_hit> operator()(ray r) const {
        std::optional<ray_hit> nearest;
        tree_.walk(r, [&](std::uint32_t i) {
            if (auto hit = shapes_[i].first_hit(r)) {
                r.reach = hit->range;
                nearest = hit;
            }
        });
        return nearest;
    }

  private:
    std::vector<placed_shape> shapes_;
    detail::bvh tree_;
};

}  // namespace gnomon::simulation

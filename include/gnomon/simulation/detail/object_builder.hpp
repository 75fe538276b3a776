// SPDX-License-Identifier: BSL-1.0
/// @file
/// A builder of furniture from boxes and cylinders.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation::detail {

/// "leg 3"
[[nodiscard]] inline std::string numbered(std::string name, int number) {
    return name + ' ' + std::to_string(number);
}

/// Adds the parts of one object, each of one or more shapes.
class object_builder {
  public:
    object_builder(scene& world, std::string name, const pose& at)
        : world_(world), object_(world.add_object(std::move(name))), at_(at) {}

    /// Begins a new part.
    object_builder& part(std::string name) {
        part_ = world_.add_part(object_, std::move(name));
        return *this;
    }

    /// Adds a vertical box to the part: its center in x and y, its lower and its upper side [m].
    object_builder& block(double x, double y, double length, double width, double low,
                          double high) {
        world_.add(part_, box{length, width, high - low}, at_ * at(x, y, 0.5 * (low + high)));
        return *this;
    }

    /// Adds a vertical cylinder to the part.
    object_builder& disc(double x, double y, double diameter, double low, double high) {
        world_.add(part_, cylinder{0.5 * diameter, high - low}, at_ * at(x, y, low));
        return *this;
    }

    /// Adds a post with a square or round cross section.
    object_builder& post(double x, double y, double thickness, double low, double high,
                         bool round) {
        return round ? disc(x, y, thickness, low, high)
                     : block(x, y, thickness, thickness, low, high);
    }

    [[nodiscard]] std::int32_t object() const { return object_; }

  private:
    scene& world_;
    std::int32_t object_;
    pose at_;
    std::int32_t part_ = nothing;
};

/// Four posts from the floor to `top`, in the corners of a rectangle of 2 x by 2 y.
inline void add_legs(object_builder& b, double x, double y, double thickness, double top,
                     bool round) {
    int number = 0;
    for (const double sx : {-x, x}) {
        for (const double sy : {-y, y}) {
            b.part(numbered("leg", ++number)).post(sx, sy, thickness, 0.0, top, round);
        }
    }
}

/// The edge of the square inscribed in a circle, relative to the diameter: the positions of the
/// legs of round furniture.
inline constexpr double square_in_circle = 0.7071;

}  // namespace gnomon::simulation::detail

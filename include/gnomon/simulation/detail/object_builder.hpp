// SPDX-License-Identifier: BSL-1.0
/// @file
/// How furniture is put together: blocks and round blocks, part by part.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::detail {

/// "leg 3"
[[nodiscard]] inline std::string numbered(std::string name, int number) {
    return name + ' ' + std::to_string(number);
}

/// Adds the parts of one object, each of one shape or more.
class object_builder {
  public:
    object_builder(scene& world, std::string name, const pose& at)
        : world_(world), object_(world.add_object(std::move(name))), at_(at) {}

    /// Begins a part.
    object_builder& part(std::string name) {
        part_ = world_.add_part(object_, std::move(name));
        return *this;
    }

    /// An upright block of the part: its middle in x and y, and its lower and upper side [m].
    object_builder& block(double x, double y, double length, double width, double low,
                          double high) {
        world_.add(part_, box{length, width, high - low}, at_ * at(x, y, 0.5 * (low + high)));
        return *this;
    }

    /// An upright round block of the part.
    object_builder& disc(double x, double y, double diameter, double low, double high) {
        world_.add(part_, cylinder{0.5 * diameter, high - low}, at_ * at(x, y, low));
        return *this;
    }

    /// Square or round.
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

/// The edge of the square within a circle, as a share of the diameter: there the legs of what is
/// round stand.
inline constexpr double square_in_circle = 0.7071;

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What stands where on the floor of a room, and places for more: at walls, and next to what is
/// there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/detail/upright_box.hpp>
#include <gnomon/simulation/pose.hpp>

namespace gnomon::simulation::detail {

/// A piece in its place.
struct standing_piece {
    floor_place place;
    std::vector<upright_box> boxes;

    standing_piece(const own_boxes& own, const floor_place& where)
        : place(where), boxes(placed(own, where)) {}
};

/// The way from a piece to a place at its side.
[[nodiscard]] inline angle side_of(const standing_piece& piece, random_stream& random) {
    return radians(piece.place.heading.radians() +
                   degrees(90.0 * static_cast<double>(random.below(4))).radians());
}

/// The floor of a room and the pieces on it.
class room_layout {
  public:
    /// @param sensor  its position, which stays free
    room_layout(const bounds& room, const Eigen::Vector3d& sensor) : room_(room), sensor_(sensor) {}

    void take(const std::vector<upright_box>& boxes) {
        taken_.insert(taken_.end(), boxes.begin(), boxes.end());
    }

    /// Whether a piece at this place is within the room, in front of the sensor and not near it,
    /// and this far from all others.
    /// @param from_sensor  least distance seen from above [m]
    [[nodiscard]] bool is_free(const std::vector<upright_box>& boxes, double clearance,
                               double from_sensor) const {
        for (const upright_box& b : boxes) {
            for (const Eigen::Vector2d& c : b.corners()) {
                if (c.x() < sensor_.x() || c.x() > room_.high.x() || c.y() < room_.low.y() ||
                    c.y() > room_.high.y() ||
                    std::hypot(c.x() - sensor_.x(), c.y() - sensor_.y()) < from_sensor)
                    return false;
            }
        }
        // A long piece in front of the sensor may have far corners.
        const upright_box around_sensor({{-0.5, -0.5, 0.0}, {0.5, 0.5, room_.high.z()}},
                                        {sensor_.x(), sensor_.y()});
        return distance({around_sensor}, boxes) > 0.0 && distance(taken_, boxes) >= clearance;
    }

    /// Anywhere, at any angle.
    [[nodiscard]] floor_place anywhere(random_stream& random) const {
        floor_place place;
        place.x = random.uniform(room_.low.x(), room_.high.x());
        place.y = random.uniform(room_.low.y(), room_.high.y());
        place.heading = degrees(random.uniform(-180.0, 180.0));
        return place;
    }

    /// At the far wall or one at a side.
    /// @param turned  of the piece; without a turn, its lower x is at the wall
    /// @param gap     between piece and wall [m]
    [[nodiscard]] floor_place at_wall(const own_boxes& own, angle turned, double gap,
                                      random_stream& random) const {
        const auto wall = random.below(3);
        const angle inward = degrees(wall == 0 ? 90.0 : wall == 1 ? -90.0 : 180.0);
        floor_place place;
        place.heading = radians(inward.radians() + turned.radians());
        bounds reach;
        for (const upright_box& b : placed(own, place))
            for (const Eigen::Vector2d& c : b.corners()) reach.extend({c.x(), c.y(), 0.0});
        const auto within = [&](int a) {
            return random.uniform(room_.low[a] - reach.low[a], room_.high[a] - reach.high[a]);
        };
        if (wall == 2) {
            place.x = room_.high.x() - gap - reach.high.x();
            place.y = within(1);
        } else {
            place.x = within(0);
            place.y = wall == 0 ? room_.low.y() + gap - reach.low.y()
                                : room_.high.y() - gap - reach.high.y();
        }
        return place;
    }

  private:
    bounds room_;
    Eigen::Vector3d sensor_;
    std::vector<upright_box> taken_;
};

/// The place at which a piece that is moved towards another one has this gap to it, by steps of
/// the distance, as in sphere tracing; nothing if it passes by.
/// @param way     from the other piece towards where this one comes from
/// @param aside   of the line through the middle of the other piece [m]
/// @param gap     horizontal, at least, and 0.1 mm more at most [m]
[[nodiscard]] inline std::optional<floor_place> beside(const standing_piece& other,
                                                       const own_boxes& own, angle heading,
                                                       angle way, double aside, double gap) {
    constexpr double farthest = 4.0, precision = 1e-4;  // [m]
    constexpr int steps = 200;
    const Eigen::Vector2d u(cos(way), sin(way)), across(-u.y(), u.x());
    double t = farthest;
    for (int step = 0; step < steps && t > -farthest; ++step) {
        const floor_place place{other.place.x + t * u.x() + aside * across.x(),
                                other.place.y + t * u.y() + aside * across.y(), heading};
        const double left = distance(other.boxes, placed(own, place)) - gap;
        if (left <= precision) return left >= 0.0 ? std::optional(place) : std::nullopt;
        t -= std::min(left - 0.5 * precision, farthest);
    }
    return std::nullopt;
}

}  // namespace gnomon::simulation::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Upright boxes that bound pieces of furniture on a floor, and their horizontal distances.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation::detail {

/// Where a piece stands on the floor z = 0.
struct floor_place {
    double x = 0.0, y = 0.0;  ///< [m]
    angle heading = {};

    [[nodiscard]] simulation::pose pose() const { return at(x, y, 0.0) * yaw(heading); }
};

/// A box turned about the vertical.
class upright_box {
  public:
    /// @param own  bounds in the frame of the piece, not empty
    upright_box(const bounds& own, const floor_place& place)
        : cosine_(cos(place.heading)),
          sine_(sin(place.heading)),
          half_length_(0.5 * own.size().x()),
          half_width_(0.5 * own.size().y()),
          low_(own.low.z()),
          high_(own.high.z()) {
        const Eigen::Vector3d m = own.middle();
        x_ = place.x + cosine_ * m.x() - sine_ * m.y();
        y_ = place.y + sine_ * m.x() + cosine_ * m.y();
        for (std::size_t i = 0; i < 4; ++i) {
            const double u = (i & 1 ? 1.0 : -1.0) * half_length_;
            const double v = (i & 2 ? 1.0 : -1.0) * half_width_;
            corners_[i] = {x_ + cosine_ * u - sine_ * v, y_ + sine_ * u + cosine_ * v};
        }
    }

    /// Of the rectangle seen from above [m].
    [[nodiscard]] const std::array<Eigen::Vector2d, 4>& corners() const { return corners_; }

    /// Horizontal distance [m] of two boxes; 0 if they overlap, infinite if one is above the other.
    [[nodiscard]] friend double distance(const upright_box& a, const upright_box& b) {
        constexpr double rounding = 1e-6;  // [m]: what stands on the other box is not above it
        if (a.low_ > b.high_ + rounding || b.low_ > a.high_ + rounding)
            return std::numeric_limits<double>::infinity();
        if (!a.is_apart(b) && !b.is_apart(a)) return 0.0;
        // Of disjoint rectangles, one of the nearest points is a corner.
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 4; ++i)
            least = std::min({least, a.distance_to(b.corners_[i]), b.distance_to(a.corners_[i])});
        return least;
    }

  private:
    [[nodiscard]] Eigen::Vector2d inward(const Eigen::Vector2d& p) const {
        const double x = p.x() - x_, y = p.y() - y_;
        return {cosine_ * x + sine_ * y, cosine_ * y - sine_ * x};
    }

    [[nodiscard]] double distance_to(const Eigen::Vector2d& p) const {
        const Eigen::Vector2d q = inward(p);
        return std::hypot(std::max(std::abs(q.x()) - half_length_, 0.0),
                          std::max(std::abs(q.y()) - half_width_, 0.0));
    }

    /// Whether a side of this box separates the rectangles.
    [[nodiscard]] bool is_apart(const upright_box& other) const {
        Eigen::Vector2d low = inward(other.corners_[0]), high = low;
        for (const Eigen::Vector2d& corner : other.corners_) {
            const Eigen::Vector2d q = inward(corner);
            low = {std::min(low.x(), q.x()), std::min(low.y(), q.y())};
            high = {std::max(high.x(), q.x()), std::max(high.y(), q.y())};
        }
        return low.x() > half_length_ || high.x() < -half_length_ || low.y() > half_width_ ||
               high.y() < -half_width_;
    }

    double x_, y_, cosine_, sine_, half_length_, half_width_, low_, high_;
    std::array<Eigen::Vector2d, 4> corners_;
};

/// The boxes about a piece, in its own frame.
using own_boxes = std::vector<bounds>;

/// One box about all of a model, or one about each of its shapes.
[[nodiscard]] inline own_boxes boxes_of(const furniture_model& model, bool of_each_shape) {
    scene alone;
    add(alone, model);
    if (!of_each_shape) return {alone.extent()};
    own_boxes all;
    for (const placed_shape& s : alone.shapes()) all.push_back(s.extent);
    return all;
}

[[nodiscard]] inline std::vector<upright_box> placed(const own_boxes& own,
                                                     const floor_place& place) {
    std::vector<upright_box> all;
    for (const bounds& b : own) all.emplace_back(b, place);
    return all;
}

/// The least distance [m] of a box of one piece from one of another.
[[nodiscard]] inline double distance(const std::vector<upright_box>& a,
                                     const std::vector<upright_box>& b) {
    double least = std::numeric_limits<double>::infinity();
    for (const upright_box& one : a)
        for (const upright_box& other : b) least = std::min(least, distance(one, other));
    return least;
}

}  // namespace gnomon::simulation::detail

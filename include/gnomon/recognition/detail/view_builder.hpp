// SPDX-License-Identifier: BSL-1.0
/// @file
/// Collects segments and the points near them to views, with their heights above the ground.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/recognition/height_profile.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition::detail {

/// Coordinates above the ground: height, and horizontal position about an origin.
class ground_frame {
  public:
    ground_frame(const plane& ground, const Eigen::Vector3d& origin)
        : ground_(ground), origin_(origin) {
        const Eigen::Vector3d& n = ground.normal;
        const Eigen::Vector3d other =
            std::abs(n[0]) < 0.5 ? Eigen::Vector3d(1.0, 0.0, 0.0) : Eigen::Vector3d(0.0, 1.0, 0.0);
        u_ = gnomon::detail::direction_of(gnomon::detail::cross(n, other));
        v_ = gnomon::detail::cross(n, u_);
    }

    void add_to(height_profile& profile, const Eigen::Vector3d& x) const {
        const Eigen::Vector3d d = gnomon::detail::difference(x, origin_);
        profile.add(ground_.signed_distance(x), gnomon::detail::dot(u_, d),
                    gnomon::detail::dot(v_, d));
    }

    /// Heights and profile of the points of a part.
    void describe(part& p, const auto& points, std::span<const point_index> members) const {
        p.lowest = std::numeric_limits<double>::infinity();
        p.highest = -p.lowest;
        for (const point_index i : members) {
            const Eigen::Vector3d x = points[i];
            if (!is_finite(x)) continue;
            const double height = ground_.signed_distance(x);
            p.lowest = std::min(p.lowest, height);
            p.highest = std::max(p.highest, height);
            add_to(p.profile, x);
        }
    }

  private:
    plane ground_;
    Eigen::Vector3d origin_, u_, v_;
};

/// The points that belong to a segment which is a surface, and all other finite ones.
struct labeled_points {
    std::vector<point_index> indices, others;

    labeled_points(const auto& position, const segments& parts,
                   const std::vector<segment_shape>& shapes) {
        for (std::size_t i = 0; i < position.size(); ++i) {
            if (!is_finite(position[i])) continue;
            const std::int32_t label = parts.labels()[i];
            const bool has_part =
                label >= 0 && shapes[static_cast<std::size_t>(label)].is_surface();
            (has_part ? indices : others).push_back(static_cast<point_index>(i));
        }
    }
};

/// Collects the views of groups of segments.
template <class Position>
class view_builder {
  public:
    view_builder(const Position& position, const segments& parts, std::optional<plane> ground)
        : position_(position), parts_(parts), ground_(ground), view_of_group_(parts.size(), none) {}

    /// Adds a segment to the view of its group.
    void add(point_index group, std::size_t segment, const segment_shape& shape) {
        std::size_t& number = view_of_group_[group];
        if (number == none) {
            number = views_.size();
            views_.push_back({.parts = {}, .ground = ground_, .rest = {}});
            frames_.emplace_back();
            if (ground_) frames_.back().emplace(*ground_, shape.frame.centroid);
        }
        part p;
        p.segment = static_cast<std::int32_t>(segment);
        p.shape = shape;
        if (const auto& frame = frames_[number]) frame->describe(p, position_, parts_[segment]);
        views_[number].parts.push_back(std::move(p));
    }

    /// Adds a point without a segment to the view of a group. Precondition: the ground is known.
    void add_rest(point_index group, point_index i) {
        const std::size_t number = view_of_group_[group];
        frames_[number]->add_to(views_[number].rest, position_[i]);
    }

    /// Those of at least `min_parts` parts.
    [[nodiscard]] std::vector<view> views(std::size_t min_parts) && {
        for (view& v : views_) {
            std::stable_sort(v.parts.begin(), v.parts.end(), [](const part& a, const part& b) {
                return a.shape.points > b.shape.points;
            });
        }
        std::erase_if(views_, [&](const view& v) { return v.parts.size() < min_parts; });
        return std::move(views_);
    }

  private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    const Position& position_;
    const segments& parts_;
    std::optional<plane> ground_;
    std::vector<std::size_t> view_of_group_;  ///< by the first segment of the group
    std::vector<view> views_;
    std::vector<std::optional<ground_frame>> frames_;  ///< of the views
};

}  // namespace gnomon::recognition::detail

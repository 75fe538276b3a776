// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighbors across scan lines. Where lines are far apart, as those of a spinning lidar on a road,
/// the nearest points all lie on one line, which determines no surface. Then the points of the next
/// rays count as well, in each quadrant around the ray.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/ray_directions.hpp>
#include <gnomon/neighborhoods/detail/scan_line.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// The directions of the points of an index.
template <class Index>
using directions_of_index =
    ray_directions<std::remove_cvref_t<decltype(std::declval<const Index&>().tree())>>;

/// The directions of an index, which keeps them.
template <class Index, execution X>
[[nodiscard]] const auto& directions_of(const Index& index, const X& run) {
    return index.kept.template get<directions_of_index<Index>>(
        [&](const auto& rays) { return rays.are_from(index.viewpoints.number()); },
        [&](auto& rays) { rays.rebuild(index, run); });
}

/// Searches for them; each thread has its own object. (A template for compile time only.)
template <class Index>
class across_lines {
  public:
    explicit across_lines(const Index& index) : index_(index) {}

    /// The points of the nearest rays in each quadrant around that of a point, turned to its scan
    /// line, if fewer than three of its neighbors are across the line.
    /// @param count      of the neighbors
    /// @param neighbor   neighbor(n): the index of neighbor n
    /// @return indices, some of which may be among the neighbors; valid until the next call
    [[nodiscard]] std::span<const point_index> operator()(point_index i, std::size_t count,
                                                          auto&& neighbor) {
        found_.clear();
        const Eigen::Vector3d u = ray_direction(index_, i);
        if (!all_finite(u)) return {};
        const ray_plane<> plane(u);
        scan_line<> line;
        around_.clear();  // by their indices: sums are the same in whatever order they come
        for (std::size_t n = 0; n < count; ++n) around_.push_back(neighbor(n));
        std::sort(around_.begin(), around_.end());
        const auto offset = [&](std::size_t n) {
            return plane.offset(ray_direction(index_, around_[n]));
        };
        for (std::size_t n = 0; n < count; ++n) line.add(offset(n));
        line.fit();
        std::size_t across = 0;
        for (std::size_t n = 0; n < count && across < enough; ++n)
            across += line.is_along(offset(n)) ? 0 : 1;
        if (across < enough) find(i, u, plane, line);
        return found_;
    }

  private:
    // These are chosen on streets 20,001 to 20,003 and furnished rooms 20,001 to 20,012: where
    // fewer neighbors count as enough, roads are interrupted; where more are wanted, or farther
    // ones, edges blur.
    static constexpr std::size_t enough = 3;      // neighbors across the line
    static constexpr std::size_t wanted = 4;      // in each quadrant
    static constexpr double most_spacings = 2.0;  // between rays next to each other

    void find(point_index i, const Eigen::Vector3d& u, const auto& plane, const auto& line) {
        if (rays_ == nullptr) {
            rays_ = &directions_of(index_, sequential{});  // only where they are needed
            const auto& [along, across] = rays_->spacing();
            reach_ = most_spacings * std::max(along, across).radians();
        }
        constexpr std::size_t few = 32, many = 256;  // rays to look at; chosen likewise
        for (std::size_t count = few; count <= many; count *= 4) {
            search_tree(rays_->tree(), u, {.k = count, .except = i}, near_);
            counts_ = {};
            std::size_t full = 0;  // quadrants
            found_.clear();
            for (const neighbor& q : near_) {
                if (q.squared_distance < same_ray || q.squared_distance > reach_ * reach_) continue;
                std::size_t& in_quadrant =
                    counts_[line.quadrant(plane.offset(ray_direction(index_, q.index)))];
                if (in_quadrant == wanted || !is_beside(i, q.index)) continue;
                full += ++in_quadrant == wanted ? 1 : 0;
                found_.push_back(q.index);
            }
            if (full == counts_.size() || near_.size() < count ||
                near_.back().squared_distance > reach_ * reach_)
                return;
        }
    }

    /// Whether two points may be on one surface that is seen from about one place: the straight
    /// line between them is not almost along the farther ray, as it is across a step of the depth.
    [[nodiscard]] bool is_beside(point_index i, point_index j) const {
        constexpr double least_sine = 0.026;    // of 1.5 degrees: chosen likewise
        constexpr double most_parallax = 0.05;  // of the range, 3 degrees: chosen likewise
        const Eigen::Vector3d v = index_.viewpoints[i], w = index_.viewpoints[j];
        const Eigen::Vector3d a = difference(index_[i], v), b = difference(index_[j], w);
        if (squared_distance(v, w) > most_parallax * most_parallax * dot(a, a)) return false;
        const Eigen::Vector3d chord = difference(b, a);
        const Eigen::Vector3d& far = dot(a, a) > dot(b, b) ? a : b;
        const Eigen::Vector3d c = cross(chord, far);
        return dot(c, c) >= least_sine * least_sine * dot(chord, chord) * dot(far, far);
    }

    const Index& index_;
    const directions_of_index<Index>* rays_ = nullptr;
    double reach_ = 0.0;  // [rad]
    std::array<std::size_t, 4> counts_{};
    scratch<neighbor> near_;
    scratch<point_index> around_, found_;
};

}  // namespace gnomon::detail

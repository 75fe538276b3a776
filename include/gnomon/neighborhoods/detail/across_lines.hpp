// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighbors across scan lines. Where lines are far apart, as those of a spinning lidar on a road,
/// the nearest points all lie on one line, which determines no surface. Then the points of the next
/// rays count as well, in each quadrant around the ray.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

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

/// Which neighborhoods get neighbors across scan lines.
enum class lacking {
    few_across,  ///< fewer than three neighbors are across the line; for fits to all neighbors
    a_side       ///< there is none on one side of it; for fits to the inliers among them
};

/// Searches for them; each thread has its own object. (A template, of numbers as well, for compile
/// time only.)
template <class Index, class Number = double>
class across_lines {
  public:
    explicit across_lines(const Index& index, lacking what = lacking::few_across)
        : index_(index), what_(what) {}

    /// The points of the nearest rays in each quadrant around that of a point, turned to its scan
    /// line, if its neighbors lack some.
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
        around_.resize(count);
        const bool is_fixed = index_.viewpoints.positions().size() == 1;  // performance only
        const Eigen::Vector3d viewpoint = index_.viewpoints[i];
        for (std::size_t n = 0; n < count; ++n) {
            // Of any length: the axis depends on the angles about the ray only.
            const point_index j = neighbor(n);
            const auto [x, y, z] = index_.tree().position(index_.tree().place_of(j));
            around_[n] =
                plane.offset(difference({x, y, z}, is_fixed ? viewpoint : index_.viewpoints[j]));
        }
        for (const auto& offset : around_) line.add(offset);
        line.fit();
        std::array<std::size_t, 4> counts{};
        for (const auto& offset : around_) ++counts[line.quadrant(offset)];
        const std::size_t left = counts[2], right = counts[3];
        const bool lacks_some =
            left + right < enough || (what_ == lacking::a_side && (left == 0 || right == 0));
        if (lacks_some) find(i, u, plane, line);
        return found_;
    }

    /// Adds them to neighbors, or to the places of neighbors in the tree, which are not repeated.
    /// @return all of them, as above
    std::span<const point_index> add_to(auto& neighbors, point_index i) {
        const auto index = [&](std::size_t n) { return index_of(neighbors[n]); };
        const auto found = (*this)(i, neighbors.size(), index);
        for (const point_index j : found) add_once(j, i, neighbors);
        return found;
    }
    /// Adds point j to the neighbors of point i, or to their places, unless it is among them.
    template <class Neighbor, class Allocator>
    void add_once(point_index j, point_index i, std::vector<Neighbor, Allocator>& neighbors) const {
        Neighbor one;
        if constexpr (std::same_as<Neighbor, neighbor>) {
            one = {squared_distance(index_[i], index_[j]), j};
        } else {
            one = index_.tree().place_of(j);
        }
        if (std::find(neighbors.begin(), neighbors.end(), one) == neighbors.end())
            neighbors.push_back(one);
    }

  private:
    [[nodiscard]] point_index index_of(const neighbor& q) const { return q.index; }
    [[nodiscard]] point_index index_of(std::uint32_t place) const {
        return index_.tree().index()[place];
    }

    // These are chosen on streets 20,001 to 20,003 and furnished rooms 20,001 to 20,012: where
    // fewer neighbors count as enough, roads are interrupted; where more are wanted, or farther
    // ones, edges blur.
    static constexpr std::size_t enough = 3;      // neighbors across the line
    static constexpr std::size_t wanted = 4;      // in each quadrant
    static constexpr double most_spacings = 2.0;  // between rays next to each other
    static constexpr std::size_t many = 256;      // rays to look at

    /// The nearest of some rays, in order.
    struct nearest_few {
        std::array<neighbor, wanted> rays;
        std::size_t count;

        [[nodiscard]] bool takes(const neighbor& q) const {
            return count < wanted || q < rays.back();
        }
        void insert(const neighbor& q) {
            if (count < wanted) ++count;
            std::size_t at = count - 1;
            for (; at > 0 && q < rays[at - 1]; --at) rays[at] = rays[at - 1];
            rays[at] = q;
        }
    };

    void find(point_index i, const Eigen::Vector3d& u, const auto& plane, const auto& line) {
        if (rays_ == nullptr) {
            rays_ = &directions_of(index_, sequential{});  // only where they are needed
            const auto& [along, across] = rays_->spacing();
            reach_ = most_spacings * std::max(along, across).radians();
        }
        search_tree_unsorted(rays_->tree(), u,
                             {.k = many, .squared_radius = reach_ * reach_, .except = i}, near_);
        std::array<nearest_few, 4> quadrants{};
        for (const neighbor& q : near_) {
            if (q.squared_distance < same_ray) continue;
            nearest_few& around = quadrants[line.quadrant(plane.offset(rays_->direction(q)))];
            if (around.takes(q) && is_beside(i, q.index)) around.insert(q);
        }
        near_.clear();
        for (const nearest_few& q : quadrants)
            near_.insert(near_.end(), q.rays.data(), q.rays.data() + q.count);
        std::sort(near_.begin(), near_.end());
        for (const neighbor& q : near_) found_.push_back(q.index);
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
        const Eigen::Vector3d& distant = dot(a, a) > dot(b, b) ? a : b;
        const Eigen::Vector3d c = cross(chord, distant);
        return dot(c, c) >= least_sine * least_sine * dot(chord, chord) * dot(distant, distant);
    }

    const Index& index_;
    lacking what_;
    const directions_of_index<Index>* rays_ = nullptr;
    double reach_ = 0.0;  // [rad]
    scratch<neighbor> near_;
    scratch<std::array<Number, 2>> around_;  // offsets of the neighbors' rays
    scratch<point_index> found_;
};

/// Adds them to the neighbors of one point.
template <class Index>
void add_across(const Index& index, point_index i, auto& found,
                lacking what = lacking::few_across) {
    across_lines<Index>(index, what).add_to(found, i);
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// All neighbors within a radius, for all points of a group of leaves at once: as leaf_search.hpp,
/// with a limit that is known in advance. Each point may have its own radius; points of similar
/// radii share a list of leaves.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/neighborhoods/detail/leaf_list.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Searches group by group; each thread has its own object. (A template, so that only users of a
/// search compile it.)
template <class Tree, class Radius>
class leaf_balls {
  public:
    /// @param radius_of  radius_of(place) is the radius of the point at a place [m]; of those that
    ///                   find nothing, it is negative
    /// @param among      only these places are found; all, if null
    /// Precondition: the tree is not empty, and places with a radius are among these.
    leaf_balls(const Tree& tree, Radius radius_of, const place_set* among = nullptr)
        : tree_(tree),
          radius_of_(std::move(radius_of)),
          list_(tree, distances_from_points(tree), among) {}

    /// Calls visit(place, places of all other points within its radius) for each point of the group
    /// number `group` whose radius is not negative. The ball is closed.
    template <class Visit>
    void operator()(std::size_t group, Visit&& visit) {
        const std::size_t begin = group * Tree::points_per_group;
        const std::size_t end = std::min(begin + Tree::points_per_group, tree_.size());
        balls_.clear();
        for (std::size_t p = begin; p < end; ++p) {
            const double radius = radius_of_(p);
            if (radius >= 0.0) balls_.push_back({radius, static_cast<std::uint32_t>(p)});
        }
        std::sort(balls_.begin(), balls_.end());
        for (std::span<const ball> left = balls_; !left.empty();) {
            std::size_t alike = 1;
            while (alike < left.size() && left[alike].radius <= 2.0 * left[0].radius) ++alike;
            if (!is_compact(left.first(alike))) alike = enclose(left.first(1));
            list_.extend_to(left[alike - 1].radius);
            for (const ball& b : left.first(alike)) visit(b.place, within(b));
            left = left.subspan(alike);
        }
    }

  private:
    struct ball {
        double radius;  // [m]
        std::uint32_t place;

        friend auto operator<=>(const ball&, const ball&) = default;
    };

    /// Makes the list that of these balls.
    /// @return the number of balls
    std::size_t enclose(std::span<const ball> balls) {
        places_.clear();
        for (const ball& b : balls) places_.push_back(b.place);
        list_.enclose(places_);
        return balls.size();
    }

    /// Makes the list that of these balls.
    /// @return whether they are close enough together for one list, see leaf_list::widest
    bool is_compact(std::span<const ball> balls) {
        enclose(balls);
        return list_.half_diagonal() <= list_.widest * balls.back().radius;
    }

    std::span<const std::uint32_t> within(const ball& b) {
        const auto [below, above] = list_.doubt_about(b.radius * list_.scale());
        list_.collect(b.place, above);
        list_.for_each_between(below, above, [&](std::size_t c) {
            if (!(tree_.squared_distance(b.place, list_.place(c)) <= b.radius * b.radius))
                list_.dismiss(c);
        });
        return list_.take_within(above);
    }

    const Tree& tree_;
    Radius radius_of_;
    leaf_list<Tree> list_;
    scratch<ball> balls_;
    scratch<std::uint32_t> places_;
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

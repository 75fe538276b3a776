// SPDX-License-Identifier: BSL-1.0
/// @file
/// All neighbors within a radius, of all points of a group of leaves at once: as leaf_search.hpp,
/// but that the limit is known. Every point may have a radius of its own; points of like radii
/// share a list of leaves.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/neighborhoods/detail/leaf_list.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Searches group by group: one for each thread. (A template, so that only who searches compiles
/// it.)
template <class Tree, class Radius>
class leaf_balls {
  public:
    /// The radius of the point of a certain index is radius_of(index) [m]. Precondition: the tree
    /// is not empty.
    leaf_balls(const Tree& tree, Radius radius_of)
        : tree_(tree), radius_of_(std::move(radius_of)), list_(tree) {}

    /// Calls visit(place, places of all others within its radius) for each point of the group
    /// number `group` whose radius is not negative. The radius itself is within.
    template <class Visit>
    void operator()(std::size_t group, Visit&& visit) {
        const std::size_t begin = group * Tree::points_per_group;
        const std::size_t end = std::min(begin + Tree::points_per_group, tree_.size());
        balls_.clear();
        for (std::size_t p = begin; p < end; ++p) {
            const double radius = radius_of_(tree_.index()[p]);
            if (radius >= 0.0) balls_.push_back({radius, p});
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
        std::size_t place;

        friend auto operator<=>(const ball&, const ball&) = default;
    };

    /// Makes the list one for these balls.
    /// @return how many they are
    std::size_t enclose(std::span<const ball> balls) {
        places_.clear();
        for (const ball& b : balls) places_.push_back(b.place);
        list_.enclose(places_);
        return balls.size();
    }

    /// Whether floats can tell much of these balls seen from their middle; if so, they are
    /// enclosed.
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
    std::vector<ball> balls_;
    std::vector<std::size_t> places_;
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors of all points of a group of leaves at once: one traversal of the tree
/// lists the leaves within reach of any of them (leaf_list.hpp), then 32 points at a time:
///
///  1. Collect the points of the listed leaves within an estimate of the k-th distance.
///  2. Select the k-th distance. Squared distances on surfaces are nearly uniform, so an
///     interpolation search finds two limits with few distances between them; these are ranked.
///  3. Compare points that the rounding of floats leaves undecided by canonical distances.
///
/// Too few points raise the estimate; a k-th distance beyond the reach of the list extends it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/leaf_list.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/nearest_wanted.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/detail/size_with_ties.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Searches group by group; each thread has its own object, which estimates distances, those of
/// leaf_distances.hpp, in a group by those in the group before. (A template, so that only users of
/// a search compile it.)
template <class Tree, class Distances = distances_from_points<Tree>>
class leaf_search {
  public:
    /// Precondition: the tree is not empty.
    leaf_search(const Tree& tree, const nearest_wanted& wanted, const Distances& distances)
        : tree_(tree),
          k_(std::min(wanted.k, tree.size() - 1)),
          ties_(wanted.ties),
          radius_(wanted.radius),
          of_(wanted.of),
          list_(tree, distances) {}

    /// Calls visit(place, places of its k nearest neighbors) for each query point in a group.
    template <class Visit>
    void operator()(std::size_t group, Visit&& visit) {
        const std::size_t first = group * Tree::points_per_group;
        const std::size_t last = std::min(first + Tree::points_per_group, tree_.size());
        waiting_.clear();
        for (std::size_t p = first; p < last; ++p)
            if (of_ == nullptr || of_->contains(p))
                waiting_.push_back(static_cast<std::uint32_t>(p));
        if (waiting_.empty()) return;
        list_.enclose(waiting_);
        // The box of these, with its diagonal, holds that many neighbors of each.
        if (waiting_.size() > k_) reach_ = std::min(reach_, 2.0 * list_.half_diagonal());
        reached_.clear();
        if (list_.half_diagonal() <= list_.widest * reach_ || !(reach_ > 0.0)) {
            find_waiting(visit);
        } else {
            // The box is large relative to the reach, as with an outlier: point by point.
            alone_.swap(waiting_);
            for (const std::uint32_t p : alone_) {
                waiting_.clear();
                waiting_.push_back(p);
                if (guess_ > 0.0) reach_ = std::sqrt(guess_);
                list_.enclose(waiting_);
                find_waiting(visit);
            }
        }
        const auto most = reached_.begin() + std::ssize(reached_) * 15 / 16;
        std::nth_element(reached_.begin(), most, reached_.end());
        reach_ = 1.1 * std::min(*std::max_element(most, reached_.end()), 1.5 * *most);  // robust
    }

  private:
    static constexpr double unlimited = std::numeric_limits<double>::infinity();
    static constexpr std::size_t few = 16;  // are ranked at once; performance only

    /// Visits all query points that wait.
    template <class Visit>
    void find_waiting(Visit&& visit) {
        if (!(reach_ > 0.0))
            reach_ = list_.half_diagonal() > 0.0 ? list_.half_diagonal()
                                                 : std::numeric_limits<double>::infinity();
        for (;;) {
            list_.extend_to(std::min(reach_, radius_));
            const bool complete = list_.complete() || list_.reach() >= radius_;
            double farther = 0.0;
            std::size_t left = 0;
            for (const std::uint32_t p : waiting_) {
                const double reached = select(p);
                if (reached <= list_.reach() || complete) {
                    visit(p, selected_);
                    reached_.push_back(reached);
                } else {
                    farther = std::max(farther, reached);
                    waiting_[left++] = p;
                }
            }
            if (left == 0) return;
            waiting_.resize(left);
            reach_ = std::min(1.001 * farther, 4.0 * list_.reach());
            list_.enclose(waiting_);
        }
    }

    /// Selects the k nearest listed points of the query point at place p.
    /// @return the distance of the k-th [m]; infinity if fewer are listed
    double select(std::size_t p) {
        selected_ = {};
        if (k_ == 0) return 0.0;  // the only point
        const double scale = list_.scale();
        const float most = list_.doubt_about(radius_ * scale).second;
        auto limit = static_cast<float>(guess_ * scale * scale);
        if (!(limit > 0.0f && limit < most)) limit = most;
        for (;;) {
            if (list_.collect(p, limit) >= k_) {
                const float d2 = kth(limit);
                const auto [below, above] = list_.doubt_about(std::sqrt(d2));
                if (above <= limit || limit == most) {
                    const auto [nearer, all] = with_widest(
                        [&, b = below, a = above](auto set) { return list_.count(set, b, a); });
                    selected_ = all - nearer > 1 ? settle(p, k_ - nearer, below, above)
                                                 : list_.take_within(d2);
                    if (radius_ < unlimited) drop_farther(p);
                    return learn(static_cast<double>(above) / (scale * scale));
                }
                limit = 1.1f * above;  // ties of the k-th may not be among the candidates
            } else if (limit < most) {
                limit = 2.5f * limit;
            } else {
                selected_ = list_.take_within(most);
                if (radius_ < unlimited) drop_farther(p);
                return std::numeric_limits<double>::infinity();
            }
            limit = std::min(most, limit);
        }
    }
    /// Removes points beyond the radius from the selection.
    void drop_farther(std::size_t p) {
        std::uint32_t *const first = selected_.data(), *const last = first + selected_.size();
        selected_ = {first, std::remove_if(first, last, [&](std::uint32_t at) {
                         return list_.distances().squared(p, at) > radius_ * radius_;
                     })};
    }

    /// Estimates the next squared k-th distance by the lesser of the last two.
    /// @return the distance
    double learn(double squared) {
        guess_ = (1.0 + 2.0 / std::sqrt(static_cast<double>(k_))) * std::min(squared, last_);
        last_ = squared;
        return std::sqrt(squared);
    }

    /// The k-th of the candidates' squared distances.
    /// Precondition: there are k, and all are within `high`.
    [[nodiscard]] float kth(float high) {
        const enclosure e = with_widest([&](auto i) { return enclosure_of_kth(i, high); });
        if (e.within - e.below <= lane_count) return e.kth;
        between_.clear();
        list_.for_each_between(e.low, e.high, [&](std::size_t c) {
            const double d2 = list_.squared_distances()[c];
            between_.push_back(d2);
        });
        const auto nth = between_.begin() + static_cast<std::ptrdiff_t>(k_ - e.below) - 1;
        std::nth_element(between_.begin(), nth, between_.end());
        return static_cast<float>(*nth);
    }

    /// Limits of the k-th squared distance: it is beyond `low` and within `high`.
    struct enclosure {
        float low, high;
        std::size_t below, within;  // the numbers of candidates within `low` and `high`
        float kth;                  // itself, if at most `lane_count` candidates are between
    };

    [[nodiscard, GNOMON_ALWAYS_INLINE]] enclosure enclosure_of_kth(auto instructions, float high) {
        std::size_t below = 0, within = list_.squared_distances().size();
        float low = -1.0f;
        for (int i = 0; i < 5 && within - below > few; ++i) {
            // If they are evenly spread, it lies between these two, nine times in ten.
            const auto rank = static_cast<float>(k_ - below);
            const auto all = static_cast<float>(within - below);
            const float margin = 1.0f + std::sqrt(std::min(rank, all - rank));
            const float from = std::max(low, 0.0f), step = (high - from) / (all + 1.0f);
            const float a = std::max(from, from + step * (rank - margin));
            const float b = std::min(high, from + step * (rank + margin));
            const auto [within_a, within_b] = list_.count(instructions, a, b);
            if (within_a >= k_) {
                high = a, within = within_a;
            } else {
                low = a, below = within_a;
                if (within_b >= k_)
                    high = b, within = within_b;
                else
                    low = b, below = within_b;
            }
        }
        if (within - below > lane_count) return {low, high, below, within, high};
        const float* const between = list_.between(instructions, low, high);
        return {low, high, below, within, kth_least(between, within - below, k_ - below)};
    }

    /// The k nearest points, and ties if the rule adds them: the candidates within `below`, and of
    /// the others up to `above` the `wanted` nearest by canonical distances.
    std::span<std::uint32_t> settle(std::size_t from, std::size_t wanted, float below,
                                    float above) {
        doubtful_.clear();
        candidates_.clear();
        list_.for_each_between(below, above, [&](std::size_t c) {
            const std::uint32_t at = list_.place(c);
            doubtful_.push_back({list_.distances().squared(from, at), tree_.index()[at]});
            candidates_.push_back(static_cast<std::uint32_t>(c));
        });
        // As in tree_query, whose sort this shares: for compile time only.
        sorted_.resize(doubtful_.size());
        std::copy(doubtful_.begin(), doubtful_.end(), sorted_.begin());
        std::sort(sorted_.data(), sorted_.data() + sorted_.size());
        const std::size_t kept =
            ties_ == tie_rule::all ? size_with_ties(sorted_, wanted, k_ + wanted) : wanted;
        for (std::size_t d = 0; d < doubtful_.size(); ++d)
            if (sorted_[kept - 1] < doubtful_[d]) list_.dismiss(candidates_[d]);
        return list_.take_within(above);
    }

    const Tree& tree_;
    std::size_t k_;
    tie_rule ties_;
    double radius_;
    const place_set* of_;
    leaf_list<Tree, Distances> list_;
    double last_ = std::numeric_limits<double>::infinity();  // squared k-th distance [m^2]
    double guess_ = 0.0, reach_ = 0.0;  // of the next one; within which leaves are listed [m]
    scratch<double> reached_;           // the k-th distances in a group [m]
    scratch<std::uint32_t> waiting_, alone_, candidates_;  // places; numbers of the doubtful ones
    std::span<std::uint32_t> selected_;
    scratch<double> between_;  // not of floats, to share a nth_element: for compile time only
    scratch<neighbor> doubtful_, sorted_;
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors of all points of a group of leaves at once. Their neighborhoods overlap,
/// so one walk through the tree lists the leaves that matter for any of them (leaf_list.hpp), and
/// what follows is done 32 points at a time:
///
///  1. Which listed leaves, and which of their points, are within a guess of the k-th distance (a
///     bit more than that of the points before)? About twice as many points as needed pass.
///  2. Which is the k-th? Distances on surfaces are nearly evenly spread in their squares, so two
///     limits are soon found between which it is with a few others, and these are compared all with
///     all, without a branch.
///  3. Are the floats precise enough to tell the k-th from the next? If not, as with tied
///     distances, those in doubt are told apart by their canonical distances in double.
///
/// A guess never decides: too few points, and it is raised; a k-th neighbor farther than the list
/// reaches, and the list is made longer. So the neighbors are exactly those of the canonical order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/leaf_list.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/size_with_ties.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// What is looked for: the k nearest, and those that the rule adds to them, none beyond a radius.
struct nearest_wanted {
    std::size_t k;
    tie_rule ties = tie_rule::by_index;
    double radius = std::numeric_limits<double>::infinity();  // [m]
    const std::vector<bool>* of = nullptr;  // the points whose neighbors are looked for; of all
};

/// Searches group by group. It learns from one what to expect of the next: one for each thread. (A
/// template, so that only who searches compiles it.)
template <class Tree>
class leaf_search {
  public:
    /// Precondition: the tree is not empty.
    leaf_search(const Tree& tree, const nearest_wanted& wanted)
        : tree_(tree),
          k_(std::min(wanted.k, tree.size() - 1)),
          ties_(wanted.ties),
          radius_(wanted.radius),
          of_(wanted.of),
          list_(tree) {}

    /// Calls visit(place, places of its k nearest) for each point of the group number `group` whose
    /// neighbors are looked for.
    template <class Visit>
    void operator()(std::size_t group, Visit&& visit) {
        const std::size_t first = group * Tree::points_per_group;
        const std::size_t last = std::min(first + Tree::points_per_group, tree_.size());
        waiting_.clear();
        for (std::size_t p = first; p < last; ++p)
            if (of_ == nullptr || (*of_)[tree_.index()[p]]) waiting_.push_back(p);
        if (waiting_.empty()) return;
        list_.enclose(waiting_);
        // The box of these, with its diagonal, holds that many neighbors of each.
        if (waiting_.size() > k_) reach_ = std::min(reach_, 2.0 * list_.half_diagonal());
        reached_.clear();
        if (list_.half_diagonal() <= list_.widest * reach_ || !(reach_ > 0.0)) {
            find_waiting(visit);
        } else {
            // Far apart for what is near them, as where the group holds a stray: one by one.
            alone_ = waiting_;
            for (const std::size_t p : alone_) {
                waiting_.assign(1, p);
                if (guess_ > 0.0) reach_ = std::sqrt(guess_);
                list_.enclose(waiting_);
                find_waiting(visit);
            }
        }
        // Stragglers would make the next list too long for all the others.
        const auto most = reached_.begin() + std::ssize(reached_) * 15 / 16;
        std::nth_element(reached_.begin(), most, reached_.end());
        reach_ = 1.1 * std::min(*std::max_element(most, reached_.end()), 1.5 * *most);
    }

  private:
    /// So many are sooner compared with each other than narrowed down.
    static constexpr std::size_t few = 16;

    /// Visits all that are waiting.
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
            for (const std::size_t p : waiting_) {
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

    /// Selects the k nearest of the group's point at place p, of those that are listed.
    /// @return how far the k-th is [m]; infinity if fewer are listed
    double select(std::size_t p) {
        selected_ = {};
        if (k_ == 0) return 0.0;  // a lonely point
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
                        [&](auto instructions) { return list_.count(instructions, below, above); });
                    selected_ = all - nearer > 1 ? settle(p, k_ - nearer, below, above)
                                                 : list_.take_within(d2);
                    drop_farther(p);
                    return learn(static_cast<double>(above) / (scale * scale));
                }
                limit = 1.1f * above;  // ties of the k-th may not be among the candidates
            } else if (limit < most) {
                limit = 2.5f * limit;
            } else {
                selected_ = list_.take_within(most);
                drop_farther(p);
                return std::numeric_limits<double>::infinity();
            }
            limit = std::min(most, limit);
        }
    }

    /// Deselects what is beyond the radius.
    void drop_farther(std::size_t p) {
        if (radius_ == std::numeric_limits<double>::infinity()) return;
        const auto is_farther = [&](std::uint32_t at) {
            return tree_.squared_distance(p, at) > radius_ * radius_;
        };
        const auto farther = std::ranges::remove_if(selected_, is_farther);
        selected_ = selected_.first(selected_.size() - farther.size());
    }

    /// Guesses the next squared k-th distance from this one and that before, lest a straggler makes
    /// the next one sift through too much.
    /// @return the distance
    double learn(double squared) {
        guess_ = (1.0 + 2.0 / std::sqrt(static_cast<double>(k_))) * std::min(squared, last_);
        last_ = squared;
        return std::sqrt(squared);
    }

    /// The k-th of the candidates' squared distances.
    /// Precondition: there are k, and all are within `high`.
    [[nodiscard]] float kth(float high) {
        return with_widest([&](auto instructions) { return kth(instructions, high); });
    }
    [[nodiscard, gnu::always_inline]] float kth(auto instructions, float high) {
        std::size_t below = 0, within = list_.squared_distances().size();
        // It is beyond `low` and within `high`, with some others.
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
        if (within - below <= lane_count)
            return kth_least(list_.between(instructions, low, high), within - below, k_ - below);
        // Many are about as far.
        between_.clear();
        const auto candidates = list_.squared_distances();
        list_.for_each_between(low, high,
                               [&](std::size_t c) { between_.push_back(candidates[c]); });
        const auto nth = between_.begin() + static_cast<std::ptrdiff_t>(k_ - below) - 1;
        std::nth_element(between_.begin(), nth, between_.end());
        return *nth;
    }

    /// The k nearest, and ties if the rule says so: those within `below`, and of those up to
    /// `above`, among which floats cannot tell the k-th from the next, the `wanted` nearest by
    /// canonical distances.
    std::span<std::uint32_t> settle(std::size_t from, std::size_t wanted, float below,
                                    float above) {
        doubtful_.clear();
        list_.for_each_between(below, above, [&](std::size_t c) {
            const std::uint32_t at = list_.place(c);
            doubtful_.push_back({{tree_.squared_distance(from, at), tree_.index()[at]}, c});
        });
        const std::size_t most = ties_ == tie_rule::all ? k_ + wanted : wanted;
        const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
        if (most < doubtful_.size()) {
            std::nth_element(doubtful_.begin(),
                             doubtful_.begin() + static_cast<std::ptrdiff_t>(most), doubtful_.end(),
                             nearer);
        }
        std::size_t kept = wanted;
        if (ties_ == tie_rule::all) {
            const auto nearest = std::span(doubtful_).first(std::min(most, doubtful_.size()));
            std::sort(nearest.begin(), nearest.end(), nearer);
            kept = size_with_ties(nearest, wanted, most, [](const auto& d) { return d.first; });
        }
        for (std::size_t d = kept; d < doubtful_.size(); ++d) list_.dismiss(doubtful_[d].second);
        return list_.take_within(above);
    }

    const Tree& tree_;
    std::size_t k_;
    tie_rule ties_;
    double radius_;
    const std::vector<bool>* of_;
    leaf_list<Tree> list_;
    double last_ = std::numeric_limits<double>::infinity();  // squared k-th distance [m^2]
    double guess_ = 0.0;                                     // of the next one
    double reach_ = 0.0;                                     // within which leaves are listed [m]
    std::vector<double> reached_;                            // the k-th distances in a group [m]
    std::vector<std::size_t> waiting_, alone_;
    std::span<std::uint32_t> selected_;
    std::vector<float> between_;
    std::vector<std::pair<neighbor, std::size_t>> doubtful_;
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors of all points of a group of leaves at once. Their neighborhoods overlap,
/// so one walk through the tree lists the leaves that matter for any of them, and what follows is
/// done in the nearest cache, in floats relative to the group's middle, 32 points at a time:
///
///  1. Which listed leaves, and which of their points, are within a guess of the k-th distance (a
///     bit more than that of the points before)? Half as many points again as needed pass.
///  2. Where is the limit that exactly k of these are within? Distances on surfaces are nearly
///     evenly spread in their squares, so interpolation finds it in three or four counts.
///  3. Are the floats precise enough to tell the k-th from the next? If not, as with tied
///     distances, all that passed are sorted by their canonical distances in double.
///
/// A guess never decides: too few points, and it is raised; a k-th neighbor farther than the list
/// reaches, and the list is made longer. So the neighbors are exactly those of the canonical order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/found_neighbors.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {

inline namespace GNOMON_LANES {

/// Searches group by group. It learns from one what to expect of the next: one for each thread. (A
/// template, so that only who searches compiles it.)
template <class Tree>
class leaf_search {
  public:
    /// Precondition: the tree is not empty.
    leaf_search(const Tree& tree, std::size_t k)
        : tree_(tree),
          k_(std::min(k, tree.size() - 1)),
          diagonal_(std::sqrt(tree.box().squared_diagonal())),
          found_(k_) {}

    /// Calls visit(index, found_neighbors) for each point of the group number `group`.
    template <class Visit>
    void operator()(std::size_t group, Visit&& visit) {
        const std::size_t first = group * group_size;
        const std::size_t last = std::min(first + group_size, tree_.size());
        waiting_.clear();
        for (std::size_t p = first; p < last; ++p) waiting_.push_back(p);
        enclose_waiting();
        // The box of the group, whose diagonal is 2 half_, holds that many neighbors of each.
        if (last - first > k_) reach_ = std::min(reach_, 2.0 * half_);
        reached_.clear();
        if (half_ <= widest * reach_ || !(reach_ > 0.0)) {
            find_waiting(visit);
        } else {
            for (std::size_t p = first; p < last; ++p) {
                waiting_.assign(1, p);
                if (guess_ > 0.0) reach_ = std::sqrt(guess_);
                enclose_waiting();
                find_waiting(visit);
            }
        }
        // Stragglers would make the next list too long for all the others.
        const auto most = reached_.begin() + std::ssize(reached_) * 15 / 16;
        std::nth_element(reached_.begin(), most, reached_.end());
        reach_ = 1.1 * std::min(*std::max_element(most, reached_.end()), 1.5 * *most);
    }

  private:
    static constexpr std::size_t group_size = leaf_tree::group_size * lane_count;  // in points
    /// How much wider than its neighborhoods a group may be: beyond, as where it holds a stray, its
    /// points are taken one by one, lest floats from its middle tell too little.
    static constexpr double widest = 256.0;

    /// Visits all that are waiting.
    template <class Visit>
    void find_waiting(Visit&& visit) {
        for (;;) {
            list_around_waiting();
            double farther = 0.0;
            std::size_t left = 0;
            for (const std::size_t p : waiting_) {
                const double reached = select(p);
                if (reached <= reach_ || complete_) {
                    found_.look_up(tree_, p, candidate_);
                    visit(tree_.index()[p], found_);
                    reached_.push_back(reached);
                } else {
                    farther = std::max(farther, reached);
                    waiting_[left++] = p;
                }
            }
            if (left == 0) return;
            waiting_.resize(left);
            reach_ = std::min(1.001 * farther, 4.0 * reach_);
            enclose_waiting();
        }
    }

    void enclose_waiting() {
        box_ = {position(waiting_[0]), position(waiting_[0])};
        for (const std::size_t p : waiting_) box_.add(position(p));
        for (std::size_t a = 0; a < 3; ++a) origin_[a] = 0.5 * box_.low[a] + 0.5 * box_.high[a];
        half_ = 0.5 * std::sqrt(box_.squared_diagonal());
    }

    /// Lists the leaves within `reach_` of the points that are waiting, their own among them.
    void list_around_waiting() {
        if (!(reach_ > 0.0)) reach_ = half_ > 0.0 ? half_ : diagonal_;
        reach_ = std::max(reach_, least_reach);
        complete_ = reach_ >= diagonal_;
        scale_ = half_ + reach_ > 0.0 ? 1.0 / (half_ + reach_) : 1.0;
        listed_ = 0;
        tree_.for_each_leaf_near(box_, reach_, [&](std::size_t leaf, const leaf_box& b) {
            if (leaf / leaf_tree::group_size == waiting_[0] / group_size)
                own_[leaf % leaf_tree::group_size] = listed_;
            list(leaf, b);
        });
        for (std::size_t l = listed_; l % lane_count != 0; ++l)
            boxes_[l / lane_count].set(l % lane_count, {far_, far_, far_}, {0.0f, 0.0f, 0.0f});
        const std::size_t most = (listed_ + 1) * lane_count;
        if (distance_.size() * lane_count < most) {
            distance_.resize(listed_ + 1);
            candidate_.resize(most);
        }
    }

    void list(std::size_t leaf, const leaf_box& box) {
        if (listed_ == points_.size()) {
            points_.resize(listed_ + lane_count);
            starts_.resize(listed_ + lane_count);
            boxes_.emplace_back();
        }
        std::array<float, 3> middle{}, half{};
        for (std::size_t a = 0; a < 3; ++a) {
            constexpr double beyond = 64.0;  // all that matters
            const double low = std::max(-beyond, (box.low[a] - origin_[a]) * scale_);
            const double high = std::min(beyond, (box.high[a] - origin_[a]) * scale_);
            middle[a] = static_cast<float>(0.5 * (low + high));
            half[a] = static_cast<float>(0.5 * (high - low));
            half[a] += 1e-6f * (std::abs(middle[a]) + half[a]);  // floats are off by 2^-24
        }
        boxes_[listed_ / lane_count].set(listed_ % lane_count, middle, half);
        const std::size_t start = leaf * lane_count;
        starts_[listed_] = static_cast<std::uint32_t>(start);
        lane_points& block = points_[listed_++];
        for (std::size_t l = 0; l < lane_count; ++l) block.x[l] = scaled(tree_.at(0)[start + l], 0);
        for (std::size_t l = 0; l < lane_count; ++l) block.y[l] = scaled(tree_.at(1)[start + l], 1);
        for (std::size_t l = 0; l < lane_count; ++l) block.z[l] = scaled(tree_.at(2)[start + l], 2);
        for (std::size_t l = std::min(lane_count, tree_.size() - start); l < lane_count; ++l)
            block.set(l, {far_, far_, far_});
    }

    [[nodiscard]] std::array<double, 3> position(std::size_t at) const {
        return {tree_.at(0)[at], tree_.at(1)[at], tree_.at(2)[at]};
    }

    /// A coordinate in floats from the middle of the group, in units in which the list reaches
    /// to 1.
    [[nodiscard]] float scaled(double coordinate, std::size_t axis) const {
        return static_cast<float>((coordinate - origin_[axis]) * scale_);
    }

    /// Leaves as candidates the k nearest of the group's point at place p, as far as they are
    /// listed.
    /// @return how far the k-th is [m]; infinity if fewer are listed
    double select(std::size_t p) {
        if (k_ == 0) return 0.0;             // a lonely point
        constexpr float everything = 16.0f;  // beyond all that is within reach of all
        auto limit = static_cast<float>(guess_ * scale_ * scale_);
        if (!(limit > 0.0f && limit < everything)) limit = everything;
        for (;;) {
            const std::size_t n = collect(p, limit);
            if (n >= k_) {
                const float d2 = kth(n, limit);
                // Of the floats: 2^-24 of each coordinate, at most half + d; the sum of squares its
                // own; and squares under the least normal float. Of the canonical distances:
                // squares under the least normal double.
                const float d = std::sqrt(d2);
                const float error = 1e-6f * (static_cast<float>(half_ * scale_) + d) + 1e-18f +
                                    static_cast<float>(1e-161 * scale_);
                const float above = (d + error) * (d + error);
                const float below = d > error ? (d - error) * (d - error) : -1.0f;
                if (above <= limit || limit == everything) {
                    if (count(n, above) - count(n, below) > 1)
                        settle(p, n, below, above);
                    else
                        keep_within(n, d2);
                    return learn(static_cast<double>(above) / (scale_ * scale_));
                }
                limit = 1.1f * above;  // ties of the k-th may not be among the candidates
            } else {
                if (limit == everything) return std::numeric_limits<double>::infinity();
                limit = 2.5f * limit;
            }
            limit = std::min(everything, limit);
        }
    }

    /// Guesses the next squared k-th distance from this one and that before, lest a straggler makes
    /// the next one sift through too much.
    /// @return the distance
    double learn(double squared) {
        guess_ = (1.0 + 2.0 / std::sqrt(static_cast<double>(k_))) * std::min(squared, last_);
        last_ = squared;
        return std::sqrt(squared);
    }

    /// All listed points within the limit of the one at place p, and their squared distances.
    /// @return how many
    std::size_t collect(std::size_t p, float limit) {
        const std::size_t own = own_[p % group_size / lane_count], lane = p % lane_count;
        const lane_points& queries = points_[own];
        const float x = queries.x[lane], y = queries.y[lane], z = queries.z[lane];
        float* const distance = distance_[0].at;
        std::size_t n = 0;
        for (std::size_t g = 0; g * lane_count < listed_; ++g) {
            const lanes gap2 = boxes_[g].squared_distances_times_4(x, y, z);
            for (std::uint32_t near = at_most(gap2, 4.00004f * limit); near != 0;
                 near &= near - 1) {
                const std::size_t b =
                    g * lane_count + static_cast<std::size_t>(std::countr_zero(near));
                const lanes d2 = points_[b].squared_distances(x, y, z);
                std::uint32_t within = at_most(d2, limit);
                if (b == own) within &= ~(std::uint32_t{1} << lane);  // not itself
                n += compress(d2, starts_[b], within, distance + n, candidate_.data() + n);
            }
        }
        for (std::size_t l = 0; l < lane_count; ++l) distance[n + l] = far_;
        return n;
    }

    /// How many of the n candidates are within a limit.
    [[nodiscard]] std::size_t count(std::size_t n, float limit) const {
        std::size_t within = 0;
        for (std::size_t b = 0; b * lane_count < n; ++b)
            within += count_at_most(distance_[b], limit);
        return within;
    }

    /// A limit that k of the n >= k candidates are within, or more if floats cannot tell them
    /// apart. Precondition: all are within `high`.
    [[nodiscard]] float kth(std::size_t n, float high) {
        float low = 0.0f;
        auto below = 0.0f, within = static_cast<float>(n);
        const auto wanted = static_cast<float>(k_);
        for (int i = 0; i < 5 && n > k_; ++i) {
            const float limit =
                low + (high - low) * (wanted + 0.5f - below) / (within - below + 0.5f);
            const std::size_t c = count(n, limit);
            if (c == k_) return limit;
            if (c < k_)
                low = limit, below = static_cast<float>(c);
            else
                high = limit, within = static_cast<float>(c);
        }
        sorted_.assign(distance_[0].at, distance_[0].at + n);
        const auto last = sorted_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
        std::nth_element(sorted_.begin(), last, sorted_.end());
        return *last;
    }

    /// Leaves as candidates, in their order, those within a limit.
    /// @return how many
    std::size_t keep_within(std::size_t n, float limit) {
        std::uint32_t* kept = candidate_.data();
        for (std::size_t b = 0; b * lane_count < n; ++b)
            kept = compress(candidate_.data() + b * lane_count, at_most(distance_[b], limit), kept);
        return static_cast<std::size_t>(kept - candidate_.data());
    }

    /// Leaves as candidates the k nearest: those within `below`, and of those up to `above`, among
    /// which floats cannot tell the k-th from the next, the nearest by canonical distances.
    void settle(std::size_t from, std::size_t n, float below, float above) {
        doubtful_.clear();
        const Eigen::Vector3d p = Eigen::Vector3d::Map(position(from).data());
        for (std::size_t c = 0; c < n; ++c) {
            const float d2 = distance_[c / lane_count][c % lane_count];
            if (d2 <= below || d2 > above) continue;
            const std::uint32_t at = candidate_[c];
            const Eigen::Vector3d o = Eigen::Vector3d::Map(position(at).data());
            doubtful_.push_back({{squared_distance(p, o), tree_.index()[at]}, at});
        }
        const std::size_t certain = keep_within(n, below);
        const auto wanted = static_cast<std::ptrdiff_t>(k_ - certain);
        const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
        if (wanted < std::ssize(doubtful_))
            std::nth_element(doubtful_.begin(), doubtful_.begin() + wanted, doubtful_.end(),
                             nearer);
        for (std::ptrdiff_t c = 0; c < wanted; ++c)
            candidate_[certain + static_cast<std::size_t>(c)] =
                doubtful_[static_cast<std::size_t>(c)].second;
        // In the order of the tree, whatever way they were found.
        std::sort(candidate_.begin(), candidate_.begin() + static_cast<std::ptrdiff_t>(k_));
    }

    static constexpr float far_ = std::numeric_limits<float>::infinity();
    /// The square of `scale_` must not overflow [m].
    static constexpr double least_reach = 1e-150;

    const Tree& tree_;
    std::size_t k_;
    double diagonal_;
    double last_ = std::numeric_limits<double>::infinity();  // squared k-th distance [m^2]
    double guess_ = 0.0;                                     // of the next one
    double reach_ = 0.0;                                     // within which leaves are listed [m]
    bool complete_ = false;                                  // whether that is all of them
    std::vector<double> reached_;                            // the k-th distances in a group [m]
    std::vector<std::size_t> waiting_;
    leaf_box box_{};                  // of them
    std::array<double, 3> origin_{};  // its middle
    double half_ = 0.0;               // half its diagonal [m]
    double scale_ = 1.0;
    std::size_t listed_ = 0;
    std::array<std::size_t, leaf_tree::group_size> own_{};  // where the group's leaves are listed
    std::vector<lane_boxes> boxes_;
    std::vector<lane_points> points_;
    std::vector<std::uint32_t> starts_;
    std::vector<lanes> distance_;
    std::vector<std::uint32_t> candidate_;
    std::vector<float> sorted_;
    std::vector<std::pair<neighbor, std::uint32_t>> doubtful_;
    found_neighbors found_;
};

/// Calls visit(i, found_neighbors) for every point i of the tree, with its k nearest neighbors.
/// Each chunk of work has a visitor of its own, which make_visitor() gives, and whose finish(), if
/// it has one, is called at the end of the chunk.
template <execution X>
void for_each_nearest(const leaf_tree& tree, std::size_t k, const X& run, auto&& make_visitor) {
    constexpr std::size_t groups_per_chunk = 16;
    if (tree.size() == 0) return;
    run((tree.groups() + groups_per_chunk - 1) / groups_per_chunk, [&](std::size_t chunk) {
        leaf_search search(tree, k);
        auto visit = make_visitor();
        const std::size_t first = chunk * groups_per_chunk;
        const std::size_t last = std::min(first + groups_per_chunk, tree.groups());
        for (std::size_t group = first; group < last; ++group) search(group, visit);
        if constexpr (requires { visit.finish(); }) visit.finish();
    });
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

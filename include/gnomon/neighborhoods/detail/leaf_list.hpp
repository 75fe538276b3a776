// SPDX-License-Identifier: BSL-1.0
/// @file
/// The leaves of a tree that matter for some points that lie together, made ready for looking at
/// all their points from each of these: in floats from the middle between them, 32 side by side, in
/// the nearest cache. Floats cannot always tell which of two points is nearer; how far they may err
/// is known, and what is nearer than that to the limit is told by the tree's doubles.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Lengths are in units of the list, in which it reaches to 1, unless in metres. (A template, so
/// that only who searches compiles it.)
template <class Tree>
class leaf_list {
  public:
    /// Farther than all that is within reach of all.
    static constexpr float everything = 4.0f;
    /// How many times the reach half the diagonal should be at most: beyond, floats tell too
    /// little.
    static constexpr double widest = 256.0;

    /// Precondition: the tree is not empty.
    explicit leaf_list(const Tree& tree)
        : tree_(tree), diagonal_(std::sqrt(tree.box().squared_diagonal())) {}

    /// Makes it a list for the points at some places of one group, and an empty one.
    void enclose(std::span<const std::size_t> places) {
        group_ = places.front() / Tree::points_per_group;
        box_ = {tree_.position(places.front()), tree_.position(places.front())};
        for (const std::size_t p : places) box_.add(tree_.position(p));
        for (std::size_t a = 0; a < 3; ++a) origin_[a] = 0.5 * box_.low[a] + 0.5 * box_.high[a];
        half_ = 0.5 * std::sqrt(box_.squared_diagonal());
    }

    /// Half the diagonal of the box of the points that it is for [m].
    [[nodiscard]] double half_diagonal() const { return half_; }

    /// Lists the leaves within `reach` [m], greater than 0, of that box, and the points' own.
    void extend_to(double reach) {
        reach_ = std::clamp(reach, least_reach, std::max(diagonal_, least_reach));
        scale_ = half_ + reach_ > 0.0 ? 1.0 / (half_ + reach_) : 1.0;
        listed_ = 0;
        tree_.for_each_leaf_near(box_, reach_, [&](std::size_t leaf, const leaf_box& b) {
            if (leaf / Tree::leaves_per_group == group_)
                own_[leaf % Tree::leaves_per_group] = listed_;
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

    /// All that is nearer than that is listed [m].
    [[nodiscard]] double reach() const { return reach_; }
    /// Whether that is all there is.
    [[nodiscard]] bool complete() const { return reach_ >= diagonal_; }
    /// [1/m]
    [[nodiscard]] double scale() const { return scale_; }

    /// Squared distances between which floats cannot tell whether a point is within d, which is
    /// counted as `everything` if it is more.
    [[nodiscard]] std::pair<float, float> doubt_about(double d) const {
        const auto limit = static_cast<float>(std::min<double>(d, everything));
        // Floats are off by 2^-24 of each coordinate, which is at most half + d, and of each sum of
        // squares, and by squares under the least normal float; canonical distances by squares
        // under the least normal double.
        const float error = 1e-6f * (static_cast<float>(half_ * scale_) + limit) + 1e-18f +
                            static_cast<float>(1e-161 * scale_);
        const float below = limit > error ? (limit - error) * (limit - error) : -1.0f;
        return {below, (limit + error) * (limit + error)};
    }

    /// Makes candidates of all listed points within a limit of the one at place p, one of those
    /// that the list is for, but not of that itself. The limit is a squared distance.
    /// @return how many
    std::size_t collect(std::size_t p, float limit) {
        const std::size_t own = own_[p % Tree::points_per_group / lane_count];
        const std::size_t lane = p % lane_count;
        const lane_points& queries = points_[own];
        const float x = queries.x[lane], y = queries.y[lane], z = queries.z[lane];
        candidates_ = with_widest([&](auto instructions) {
            float* const distance = distance_[0].at;
            std::size_t n = 0;
            for (std::size_t g = 0; g * lane_count < listed_; ++g) {
                const lanes gap2 = boxes_[g].squared_distances_times_4(x, y, z);
                std::uint32_t near = instructions.at_most(gap2, 4.00004f * limit);
                for (; near != 0; near &= near - 1) {
                    const std::size_t b =
                        g * lane_count + static_cast<std::size_t>(std::countr_zero(near));
                    const lanes d2 = points_[b].squared_distances(x, y, z);
                    std::uint32_t within = instructions.at_most(d2, limit);
                    if (b == own) within &= ~(std::uint32_t{1} << lane);  // not itself
                    n += instructions.compress(d2, starts_[b], within, distance + n,
                                               candidate_.data() + n);
                }
            }
            for (std::size_t l = 0; l < lane_count; ++l) distance[n + l] = far_;
            return n;
        });
        return candidates_;
    }

    /// The squared distances of the candidates.
    [[nodiscard]] std::span<const float> squared_distances() const {
        return {distance_[0].at, candidates_};
    }

    /// How many of the candidates are within each of two limits.
    [[nodiscard, gnu::always_inline]] std::pair<std::size_t, std::size_t> count(auto instructions,
                                                                                float a,
                                                                                float b) const {
        std::size_t within_a = 0, within_b = 0;
        for (std::size_t c = 0; c * lane_count < candidates_; ++c) {
            within_a += instructions.count_at_most(distance_[c], a);
            within_b += instructions.count_at_most(distance_[c], b);
        }
        return {within_a, within_b};
    }

    /// The squared distances of those beyond `below` and within `above`, and after them infinity.
    /// Precondition: there are at most 32.
    [[nodiscard, gnu::always_inline]] const float* between(auto instructions, float below,
                                                           float above) {
        float* end = few_.data();
        for (std::size_t c = 0; c * lane_count < candidates_; ++c) {
            const std::uint32_t bits = bits_between(instructions, c, below, above);
            end = instructions.compress(distance_[c].at, bits, end);
        }
        std::fill(end, few_.data() + lane_count, far_);
        return few_.data();
    }

    /// Calls visit(candidate) for those beyond `below` and within `above`.
    void for_each_between(float below, float above, auto&& visit) const {
        constexpr compiled_instructions instructions;
        for (std::size_t b = 0; b * lane_count < candidates_; ++b) {
            std::uint32_t bits = bits_between(instructions, b, below, above);
            for (; bits != 0; bits &= bits - 1)
                visit(b * lane_count + static_cast<std::size_t>(std::countr_zero(bits)));
        }
    }

    /// The place of a candidate.
    [[nodiscard]] std::uint32_t place(std::size_t candidate) const { return candidate_[candidate]; }

    /// Puts a candidate beyond all limits.
    void dismiss(std::size_t candidate) {
        distance_[candidate / lane_count][candidate % lane_count] = far_;
    }

    /// The places of those candidates that are within a limit, in their order. Ends the candidacy
    /// of all.
    [[nodiscard]] std::span<std::uint32_t> take_within(float limit) {
        std::uint32_t* const taken = with_widest([&](auto instructions) {
            std::uint32_t* end = candidate_.data();
            for (std::size_t b = 0; b * lane_count < candidates_; ++b)
                end = instructions.compress(candidate_.data() + b * lane_count,
                                            instructions.at_most(distance_[b], limit), end);
            return end;
        });
        candidates_ = 0;
        return {candidate_.data(), taken};
    }

  private:
    /// Which of 32 candidates are beyond `below` and within `above`.
    [[nodiscard, gnu::always_inline]] std::uint32_t bits_between(auto instructions,
                                                                 std::size_t block, float below,
                                                                 float above) const {
        return instructions.at_most(distance_[block], above) &
               ~instructions.at_most(distance_[block], below);
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

    /// A coordinate from the middle.
    [[nodiscard]] float scaled(double coordinate, std::size_t axis) const {
        return static_cast<float>((coordinate - origin_[axis]) * scale_);
    }

    static constexpr float far_ = std::numeric_limits<float>::infinity();
    /// The square of `scale_` must not overflow [m].
    static constexpr double least_reach = 1e-150;

    const Tree& tree_;
    double diagonal_;  // of all [m]
    std::size_t group_ = 0;
    leaf_box box_{};
    std::array<double, 3> origin_{};                         // its middle
    double half_ = 0.0;                                      // of its diagonal [m]
    double reach_ = 0.0;                                     // [m]
    double scale_ = 1.0;                                     // [1/m]
    std::size_t listed_ = 0;                                 // how many leaves
    std::array<std::size_t, Tree::leaves_per_group> own_{};  // where the group's leaves are listed
    std::vector<lane_boxes> boxes_;                          // of the leaves, 32 in each
    std::vector<lane_points> points_;                        // of each leaf
    std::vector<std::uint32_t> starts_;                      // their first places
    std::size_t candidates_ = 0;                             // how many points
    std::vector<lanes> distance_;                            // squared ones of the candidates
    std::vector<std::uint32_t> candidate_;                   // their places
    alignas(lanes) std::array<float, 2 * lane_count> few_;   // of the distances, with room to write
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The leaves of a tree within reach of some adjacent query points, prepared for distances from
/// these: coordinates in float relative to their center, 32 points in a structure of arrays. Where
/// the rounding of floats could decide, distances are compared in double.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>
#include <gnomon/neighborhoods/detail/leaf_distances.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Lengths are in units of the list, whose reach is at most 1, unless in metres. Distances are
/// those of leaf_distances.hpp. (A template of trees for compile time only.)
template <class Tree, class Distances = distances_from_points<Tree>>
class leaf_list {
  public:
    /// Farther than every point within reach of a query point.
    static constexpr float everything = 4.0f;
    /// The largest ratio of half the diagonal to the reach, for which floats decide enough.
    static constexpr double widest = 256.0;
    /// Precondition: the tree is not empty.
    /// @param among  only these places are listed; all, if null
    leaf_list(const Tree& tree, const Distances& distances, const place_set* among = nullptr)
        : tree_(tree),
          distances_(distances),
          among_(among),
          diagonal_(std::sqrt(tree.box().squared_diagonal())) {
        points_.reserve(std::min(tree.leaves() + lane_count, 4 * lane_count));  // performance only
    }

    /// Makes it an empty list for the query points at some places of one group.
    void enclose(std::span<const std::uint32_t> places) {
        group_ = places.front() / Tree::points_per_group;
        box_ = {tree_.position(places.front()), tree_.position(places.front())};
        for (const std::uint32_t p : places) distances_.enclose(p, box_);
        for (std::size_t a = 0; a < 3; ++a) origin_[a] = 0.5 * box_.low[a] + 0.5 * box_.high[a];
        half_ = 0.5 * std::sqrt(box_.squared_diagonal());
    }
    /// Half the diagonal of the box of the query points [m].
    [[nodiscard]] double half_diagonal() const { return half_; }
    /// Lists the leaves within `reach` [m], greater than 0, of that box, and the query points' own.
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
    /// All points nearer than this are listed [m].
    [[nodiscard]] double reach() const { return reach_; }
    /// Whether all points are listed.
    [[nodiscard]] bool complete() const { return reach_ >= diagonal_; }
    /// [1/m]
    [[nodiscard]] double scale() const { return scale_; }
    /// The squared distances between which floats leave undecided whether a point is within d,
    /// which is `everything` at most.
    [[nodiscard]] std::pair<float, float> doubt_about(double d) const {
        const auto limit = static_cast<float>(std::min<double>(d, everything));
        // Floats are off by 2^-24 of each coordinate, which is at most half + d, and of each sum of
        // squares, and by squares under the least normal float; canonical distances by squares
        // under the least normal double.
        const float error = 1e-6f * (static_cast<float>(half_ * scale_) + limit) + 1e-18f +
                            static_cast<float>(1e-161 * scale_);
        return Distances::doubt(limit, error);
    }

    /// Makes the listed points within a limit, a squared distance, of the query point at place p
    /// candidates, except the query point itself.
    /// @return the number of candidates
    std::size_t collect(std::size_t p, float limit) {
        const std::size_t own = own_[p % Tree::points_per_group / lane_count];
        const std::size_t lane = p % lane_count;
        const lane_points& queries = points_[own];
        const auto from =
            distances_.in_list(p, {queries.x[lane], queries.y[lane], queries.z[lane]}, scale_);
        candidates_ = with_widest([&](auto instructions) {
            float* const distance = distance_[0].at;
            std::size_t n = 0;
            for (std::size_t g = 0; g * lane_count < listed_; ++g) {
                std::uint32_t nearby = from.nearby(instructions, boxes_[g], limit);
                for (; nearby != 0; nearby &= nearby - 1) {
                    const std::size_t b =
                        g * lane_count + static_cast<std::size_t>(std::countr_zero(nearby));
                    const lanes d2 = from.squared_distances(points_[b]);
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
    /// The numbers of candidates within each of two limits.
    [[nodiscard, GNOMON_ALWAYS_INLINE]] std::pair<std::size_t, std::size_t> count(auto instructions,
                                                                                  float a,
                                                                                  float b) const {
        std::size_t within_a = 0, within_b = 0;
        for (std::size_t c = 0; c * lane_count < candidates_; ++c) {
            within_a += instructions.count_at_most(distance_[c], a);
            within_b += instructions.count_at_most(distance_[c], b);
        }
        return {within_a, within_b};
    }

    /// The squared distances of the candidates beyond `below` and within `above`, which are at most
    /// 32, followed by infinity.
    [[nodiscard, GNOMON_ALWAYS_INLINE]] const float* between(auto instructions, float below,
                                                             float above) {
        float* end = few_.data();
        for (std::size_t c = 0; c * lane_count < candidates_; ++c) {
            const std::uint32_t bits = bits_between(instructions, c, below, above);
            end = instructions.compress(distance_[c].at, bits, end);
        }
        std::fill(end, few_.data() + lane_count, far_);
        return few_.data();
    }

    /// Calls visit(candidate) for the candidates beyond `below` and within `above`.
    void for_each_between(float below, float above, auto&& visit) const {
        constexpr compiled_instructions instructions;
        for (std::size_t b = 0; b * lane_count < candidates_; ++b) {
            std::uint32_t bits = bits_between(instructions, b, below, above);
            for (; bits != 0; bits &= bits - 1)
                visit(b * lane_count + static_cast<std::size_t>(std::countr_zero(bits)));
        }
    }

    [[nodiscard]] const Distances& distances() const { return distances_; }
    /// The place of a candidate.
    [[nodiscard]] std::uint32_t place(std::size_t candidate) const { return candidate_[candidate]; }
    /// Puts a candidate beyond all limits.
    void dismiss(std::size_t candidate) {
        distance_[candidate / lane_count][candidate % lane_count] = far_;
    }

    /// The places of the candidates within a limit. Removes all candidates. (Not inline, as it is
    /// called in several places: for compile time only.)
    [[nodiscard, GNOMON_NOINLINE]] std::span<std::uint32_t> take_within(float limit) {
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
    [[nodiscard, GNOMON_ALWAYS_INLINE]] std::uint32_t bits_between(auto instructions,
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
        constexpr double beyond = 64.0;  // every point within reach
        std::array<float, 3> middle{}, half{};
        for (std::size_t a = 0; a < 3; ++a) {
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
        with_widest([&, scale = scale_](auto) {  // relative to the center, in units of the list
            const std::array to{block.x.at, block.y.at, block.z.at};
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t l = 0; l < lane_count; ++l)
                    to[a][l] = static_cast<float>((tree_.at(a)[start + l] - origin_[a]) * scale);
        });
        const std::size_t size = std::min(lane_count, tree_.size() - start);
        std::uint32_t missing = ~(~std::uint32_t{0} >> (lane_count - size));
        if (among_ != nullptr) missing |= ~among_->of_leaf(leaf);
        for (; missing != 0; missing &= missing - 1)
            block.set(static_cast<std::size_t>(std::countr_zero(missing)), {far_, far_, far_});
    }

    static constexpr float far_ = std::numeric_limits<float>::infinity();
    static constexpr double least_reach = 1e-150;  // the square of `scale_` must not overflow [m]

    const Tree& tree_;
    Distances distances_;
    const place_set* among_;
    double diagonal_;                     // of all [m]
    std::size_t group_ = 0, listed_ = 0;  // number of the group; how many leaves are listed
    leaf_box box_{};                      // of the query points
    std::array<double, 3> origin_{};      // its middle
    double half_ = 0.0, reach_ = 0.0;     // of its diagonal; of the list [m]
    double scale_ = 1.0;                  // [1/m]
    std::array<std::size_t, Tree::leaves_per_group> own_{};  // where the group's leaves are listed
    scratch<lane_boxes> boxes_;                              // of the leaves, 32 in each
    scratch<lane_points> points_;                            // of each leaf
    scratch<std::uint32_t> starts_;                          // their first places
    std::size_t candidates_ = 0;                             // how many points
    scratch<lanes> distance_;                                // squared ones of the candidates
    scratch<std::uint32_t> candidate_;                       // their places
    alignas(lanes) std::array<float, 2 * lane_count> few_;   // of the distances, with room to write
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

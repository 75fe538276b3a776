// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighbors of one position in a `leaf_tree`: a depth-first search, the nearer child of each node
/// first, which leaves out nodes whose boxes are farther than the k-th candidate or the radius.
/// Exact, with ties broken by the index. A node whose points are all at one position holds them in
/// the order of their indices, so that a search for k of them reads about k.
///
/// Friedman, Bentley and Finkel 1977; Arya et al. 1998 for the (1 + eps) bound.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/detail/size_with_ties.hpp>
#include <gnomon/neighborhoods/metric.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// The canonical distance, as a type of its own: the compiler then knows the metric.
struct canonical_metric {
    [[nodiscard]] double squared(double x, double y, double z) const {
        return x * x + y * y + z * z;
    }
};

/// What is searched for.
struct tree_question {
    std::size_t k = std::numeric_limits<std::size_t>::max();
    double squared_radius = std::numeric_limits<double>::infinity();  // [m^2], included
    tie_rule ties = tie_rule::by_index;
    double epsilon = 0.0;  // distances may be (1 + epsilon) times those of the nearest
    point_index except = std::numeric_limits<point_index>::max();  // this point is left out
    const place_set* among = nullptr;  // only these points are found; all, if there is no set
};

inline namespace GNOMON_LANES {

/// One search. Keeps the best candidates in `found`, which finish() puts into canonical order.
template <class Metric, class Found>
class tree_query {
  public:
    tree_query(const leaf_tree& tree, const Eigen::Vector3d& p, const tree_question& question,
               const Metric& metric, Found& found)
        : tree_(tree),
          at_{p[0], p[1], p[2]},
          question_(question),
          metric_(metric),
          found_(found),
          most_(question.ties == tie_rule::all && question.k <= tree.size() ? 2 * question.k
                                                                            : question.k),
          // Candidates are collected up to this number, then the farthest are dropped in linear
          // time (performance only).
          full_(most_ < tree.size() ? most_ + std::max(leaf_tree::leaf_size, most_ / 4)
                                    : tree.size() + 1),
          shrink_(1.0 / ((1.0 + question.epsilon) * (1.0 + question.epsilon))) {
        limit_ = horizon_ = question.squared_radius;
        found_.clear();
    }

    void operator()() {
        collect();
        finish();
    }

    /// Finds what is wanted, in no order; if ties are wanted, all that may be.
    void collect() {
        if (tree_.size() == 0 || question_.k == 0) return;
        std::array<pending, 64> stack;  // as deep as the tree, which has fewer than 2^32 leaves
        std::size_t depth = 0;
        stack[depth++] = {tree_.root(), bound(tree_.root())};
        while (depth > 0) {
            pending at = stack[--depth];
            while (may_be_wanted(at)) {  // down to a leaf
                if (at.node.is_leaf()) {
                    read(at.node.first);
                    break;
                }
                const auto [left, right] = at.node.children();
                // An exchange takes less time than a choice by copies (performance only).
                pending nearer{left, bound(left)}, farther{right, bound(right)};
                if (farther.squared < nearer.squared) std::swap(nearer, farther);
                stack[depth++] = farther;
                at = nearer;
            }
        }
        if (found_.size() > most_) drop_farthest();
    }

  private:
    struct pending {
        leaf_tree::subtree node;
        double squared;  // no point of it is nearer [m^2]
    };

    /// Bounds and distances may be rounded differently: what is a tie must not be left out.
    static constexpr double margin = 1.0 + 1e-12;
    static constexpr double tie_margin = 1.0 + 2e-9;  // more than that of size_with_ties

    static constexpr std::size_t few = 16;  // candidates that insertion keeps; performance only

    [[nodiscard]] double bound(const leaf_tree::subtree& node) const {
        const leaf_box& box = tree_.box(node);
        if constexpr (requires { metric_.lower_bound(at_, box); }) {
            // Of a metric in which the nearest position of a box is not that of each coordinate.
            return metric_.lower_bound(at_, box);
        }
        std::array<double, 3> gap;
        for (std::size_t a = 0; a < 3; ++a)
            gap[a] = std::max(std::max(box.low[a] - at_[a], at_[a] - box.high[a]), 0.0);
        return metric_.squared(gap[0], gap[1], gap[2]);
    }

    [[nodiscard]] bool may_be_wanted(const pending& p) const {
        return !is_beyond(p.squared) && !holds_only_later_ties(p.node) &&
               (question_.among == nullptr || question_.among->meets(p.node));
    }

    [[nodiscard]] bool is_beyond(double squared) const {
        return squared > horizon_ * margin + std::numeric_limits<double>::min();
    }

    /// Whether all points of a node are at one position and come after the last candidate.
    [[nodiscard]] bool holds_only_later_ties(const leaf_tree::subtree& node) const {
        if (!has_last_ || !tree_.box(node).is_point()) return false;
        const std::size_t first = node.first * leaf_tree::leaf_size;
        const auto q = tree_.position(first);
        return last_ < neighbor{metric_.squared(at_[0] - q[0], at_[1] - q[1], at_[2] - q[2]),
                                tree_.index()[first]};
    }

    void read(std::size_t leaf) {
        const std::size_t begin = leaf * leaf_tree::leaf_size;
        const double *x = tree_.at(0) + begin, *y = tree_.at(1) + begin, *z = tree_.at(2) + begin;
        std::array<double, leaf_tree::leaf_size> squared;
        // Of fixed length, for vector instructions.
        for (std::size_t l = 0; l < squared.size(); ++l)
            squared[l] = metric_.squared(at_[0] - x[l], at_[1] - y[l], at_[2] - z[l]);
        const std::size_t size = std::min(squared.size(), tree_.size() - begin);
        std::uint32_t within = 0;  // a mask first: branches would often be predicted wrongly
        for (std::size_t l = 0; l < squared.size(); l += slim_pack::size)
            within |= at_most(slim_pack(squared.data() + l), limit_) << l;
        within &= ~std::uint32_t{0} >> (squared.size() - size);
        for (; within != 0; within &= within - 1) {
            const auto l = static_cast<std::size_t>(std::countr_zero(within));
            const point_index i = tree_.index()[begin + l];
            if (i == question_.except) continue;
            if (question_.among != nullptr && !question_.among->contains(begin + l)) continue;
            const neighbor q{squared[l], i};
            if constexpr (requires { metric_.accepts(i); }) {  // a metric of some points only
                const bool is_near = most_ > few || found_.size() < most_ || q < found_.back();
                if (!is_near || !metric_.accepts(i)) continue;
            }
            if (most_ > few || found_.size() < most_)
                found_.push_back(q);
            else if (q < found_.back())
                found_.back() = q;
            else
                continue;
            if (most_ <= few) put_last_in_order();
        }
        if (found_.size() >= (most_ > few ? full_ : most_)) drop_farthest();
    }

    /// Moves the last one of few candidates, the others of which are in canonical order, to its
    /// place among them.
    void put_last_in_order() {
        const neighbor q = found_.back();
        neighbor* const first = found_.data();
        neighbor* at = first + (found_.size() - 1);
        for (; at != first && q < at[-1]; --at) *at = at[-1];
        *at = q;
    }

    /// Keeps the nearest `most_` candidates, and leaves out what is farther from now on.
    void drop_farthest() {
        const auto put_in_place = [this](std::size_t n) {
            neighbor* const first = found_.data();
            std::nth_element(first, first + n, first + found_.size());
        };
        const bool is_in_order = most_ <= few;
        if (!is_in_order) {
            put_in_place(most_ - 1);
            found_.resize(most_);
        }
        last_ = found_.back();  // before the k-th is put in place
        has_last_ = true;
        double kth = last_.squared_distance;
        if (most_ > question_.k) {
            if (!is_in_order) put_in_place(question_.k - 1);
            kth = std::min(kth, tie_margin * found_[question_.k - 1].squared_distance);
        }
        limit_ = std::min(limit_, kth);
        horizon_ = std::min(horizon_, kth * shrink_);
    }

    void finish() {
        if (most_ > few) std::sort(found_.data(), found_.data() + found_.size());
        if (found_.size() <= question_.k) return;
        found_.resize(question_.ties == tie_rule::all ? size_with_ties(found_, question_.k, most_)
                                                      : question_.k);
    }

    const leaf_tree& tree_;
    std::array<double, 3> at_;
    const tree_question& question_;
    const Metric& metric_;
    Found& found_;
    std::size_t most_, full_;
    double shrink_;
    double limit_;    // squared; candidates farther than that are not wanted [m^2]
    double horizon_;  // squared; nodes farther than that are not read [m^2]
    bool has_last_ = false;
    neighbor last_{};  // the farthest of the nearest `most_`
};

/// Replaces the content of `found` by the answer, in canonical order. O(log n + k log k) on average
/// for the k that are found. Precondition: p is finite.
template <class Metric = canonical_metric, class Allocator>
void search_tree(const leaf_tree& tree, const Eigen::Vector3d& p, const tree_question& question,
                 std::vector<neighbor, Allocator>& found, const Metric& metric = {}) {
    tree_query(tree, p, question, metric, found)();
}

/// The same in no order.
template <class Allocator>
void search_tree_unsorted(const leaf_tree& tree, const Eigen::Vector3d& p,
                          const tree_question& question, std::vector<neighbor, Allocator>& found) {
    tree_query(tree, p, question, canonical_metric{}, found).collect();
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

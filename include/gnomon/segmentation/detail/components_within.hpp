// SPDX-License-Identifier: BSL-1.0
/// @file
/// The connected components of the graph that joins points at most r apart, without a look at most
/// of its edges. From the leaves of a kd-tree upward, each node's children are joined, by a walk
/// through pairs of their subtrees (a dual-tree algorithm, in the manner of March, Ram and Gray
/// 2010). It passes over a pair
///
///  - whose boxes are more than r apart, and
///  - whose points are all in one component already, as most are where points are dense.
///
/// Leaves meet piece by piece, where a piece are those points of a leaf that are connected within
/// it: one edge joins two pieces, and no other edge between them need be looked for.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// The walk through one tree. (A template, so that only code that uses it compiles it.)
template <class Tree>
class component_walk {
  public:
    component_walk(const Tree& tree, double radius)
        : tree_(tree),
          limit_(radius * radius),
          certain_(limit_ > least ? limit_ * (1.0 - margin) : 0.0),
          possible_(limit_ > least ? limit_ * (1.0 + margin) : least),
          sets_(tree.size()),
          piece_(tree.size()),
          whole_(tree.nodes()) {}

    /// The components of the places of the tree.
    template <execution X>
    [[nodiscard]] union_find operator()(const X& run) {
        if (tree_.size() > 0) cut(tree_.root());
        run(parts_.size(), [this](std::size_t p) { join_within(parts_[p]); });
        run(parts_.size(), [this](std::size_t p) {
            for (std::size_t q = p + 1; q < parts_.size(); ++q) join(parts_[p], parts_[q]);
        });
        return std::move(sets_);
    }

  private:
    using subtree = typename Tree::subtree;
    using lane_set = std::uint32_t;  // points of a leaf: bit l is for its l-th

    /// How far other orders of summation, or fused ones, may be from the canonical distance, by
    /// rounding, in proportion to it.
    static constexpr double margin = 1e-12;
    static constexpr double least = 1e-290;  // [m^2]; rounding of less is not in proportion

    /// Cuts a subtree into parts for the threads.
    void cut(const subtree& t) {
        constexpr std::size_t enough = 64;  // parts (performance only)
        if (t.is_leaf() || enough * (t.last - t.first) <= tree_.leaves()) {
            parts_.push_back(t);
        } else {
            for (const subtree& child : t.children()) cut(child);
        }
    }

    void join_within(const subtree& t) {
        if (t.is_leaf()) return join_within_leaf(t);
        const auto [left, right] = t.children();
        join_within(left);
        join_within(right);
        join(left, right);
        whole_[t.node] = in_one_set(left, right);
    }

    void join(const subtree& a, const subtree& b) {
        if (a.last - a.first < b.last - b.first) return join(b, a);
        if (tree_.box(a).squared_distance_to(tree_.box(b)) > possible_ || in_one_set(a, b)) return;
        if (a.is_leaf()) return join_leaves(a, b);
        for (const subtree& child : a.children()) join(child, b);
    }

    /// Whether all points of both are known to be in the same component.
    [[nodiscard]] bool in_one_set(const subtree& a, const subtree& b) {
        return whole_[a.node] && whole_[b.node] &&
               sets_.find(first_of(a)) == sets_.find(first_of(b));
    }

    /// Finds the pieces of a leaf.
    void join_within_leaf(const subtree& leaf) {
        const lane_set all = lanes_of(leaf);
        for (lane_set left = all; left != 0;) {
            lane_set piece = lowest(left), next = piece;  // points whose neighbors are unknown
            left ^= piece;
            while (next != 0 && left != 0) {
                const lane_set found = nearby(point_at(leaf, next), leaf, left);
                next ^= lowest(next) | found;
                piece |= found;
                left ^= found;
            }
            for (lane_set rest = piece; rest != 0; rest ^= lowest(rest)) {
                sets_.unite(point_at(leaf, piece), point_at(leaf, rest));
                piece_[point_at(leaf, rest)] = piece;
            }
        }
        whole_[leaf.node] = piece_[first_of(leaf)] == all;
    }

    /// Joins the pieces of two leaves.
    void join_leaves(const subtree& a, const subtree& b) {
        lane_set in_a = nearby(tree_.box(b), a);
        const lane_set in_b = in_a != 0 ? nearby(tree_.box(a), b) : 0;
        while (in_a != 0) {
            lane_set piece = in_a & piece_[point_at(a, in_a)];
            in_a ^= piece;
            // The points of pieces that are not known to be connected with this one.
            lane_set others = in_b;
            const point_index set = sets_.find(point_at(a, piece));
            for (lane_set left = in_b; left != 0;) {
                const point_index q = point_at(b, left);
                left &= ~piece_[q];
                if (sets_.find(q) == set) others &= ~piece_[q];
            }
            for (; piece != 0 && others != 0; piece ^= lowest(piece)) {
                const point_index p = point_at(a, piece);
                for (lane_set found = nearby(p, b, others); found != 0; found &= others) {
                    const point_index q = point_at(b, found);
                    sets_.unite(p, q);
                    others &= ~piece_[q];
                }
            }
        }
    }

    /// The points of a leaf that may be within the radius of a box.
    [[nodiscard]] lane_set nearby(const leaf_box& box, const subtree& leaf) const {
        lane_set possible = 0;
        for (std::size_t l = 0; l < Tree::leaf_size; l += pack::size) {
            pack d2(0.0);
            for (std::size_t a = 0; a < 3; ++a) {
                const pack x(tree_.at(a) + first_of(leaf) + l);
                const pack d = x - clamp(x, box.low[a], box.high[a]);
                d2 += d * d;
            }
            possible |= at_most(d2, possible_) << l;
        }
        return possible & lanes_of(leaf);
    }

    /// Those of some points of a leaf that are within the radius of point p.
    [[nodiscard]] lane_set nearby(point_index p, const subtree& leaf, lane_set some) const {
        lane_set within = 0, certain = 0;
        for (std::size_t l = 0; l < Tree::leaf_size; l += pack::size) {
            pack d2(0.0);
            for (std::size_t a = 0; a < 3; ++a) {
                const pack d = pack(tree_.at(a) + first_of(leaf) + l) - tree_.at(a)[p];
                d2 += d * d;
            }
            within |= at_most(d2, possible_) << l;
            certain |= at_most(d2, certain_) << l;
        }
        within &= some;
        for (lane_set doubt = within & ~certain; doubt != 0; doubt ^= lowest(doubt))
            if (tree_.squared_distance(p, point_at(leaf, doubt)) > limit_) within ^= lowest(doubt);
        return within;
    }

    [[nodiscard]] static point_index first_of(const subtree& t) {
        return static_cast<point_index>(t.first * Tree::leaf_size);
    }
    [[nodiscard]] lane_set lanes_of(const subtree& leaf) const {
        const std::size_t n = std::min(tree_.size() - first_of(leaf), Tree::leaf_size);
        return ~lane_set{0} >> (Tree::leaf_size - n);
    }
    [[nodiscard]] static lane_set lowest(lane_set some) { return some & (~some + 1); }
    /// The first of some points of a leaf.
    [[nodiscard]] static point_index point_at(const subtree& leaf, lane_set some) {
        return first_of(leaf) + static_cast<point_index>(std::countr_zero(some));
    }

    const Tree& tree_;
    double limit_, certain_, possible_;  // squared: the radius, and what is within or beyond anyway
    union_find sets_;                    // of places in the tree
    scratch<lane_set> piece_;            // of its leaf that each is of
    scratch<char> whole_;                // nodes all of whose points are known to be connected
    scratch<subtree> parts_;
};

/// A label for each point: the connected components of the finite points, where points at most
/// `radius` [m] apart are joined; others are unlabeled. Nearly O(n), unless many points are hardly
/// farther than the radius from many of another component. Precondition: the radius is not
/// negative.
template <execution X>
[[nodiscard]] scratch<std::int32_t> components_within(const leaf_tree& tree, double radius,
                                                      const X& run) {
    union_find places = component_walk(tree, radius)(run);
    scratch<std::int32_t> labels(tree.points(), unlabeled);
    for (std::size_t p = 0; p < tree.size(); ++p)
        labels[tree.index()[p]] =
            static_cast<std::int32_t>(places.find(static_cast<point_index>(p)));
    return labels;
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

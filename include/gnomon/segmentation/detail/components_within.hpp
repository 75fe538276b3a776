// SPDX-License-Identifier: BSL-1.0
/// @file
/// The connected components of the graph that joins points at most r apart, without looking at most
/// of its edges. A walk through pairs of subtrees of a kd-tree, from the bottom up, passes over two
/// whose boxes are farther apart than r, and over two each of which is known to lie in one
/// component, the same for both: in dense places that are nearly all. (A dual-tree algorithm, as
/// those of Gray and Moore 2001 and of March, Ram and Gray 2010.)
///
/// Two subtrees that each lie in one component need but one edge between them. Where points lie so
/// densely that the diagonal of a box is at most r, no distance is calculated at all.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Walks. (A template, so that only who searches compiles it.)
template <class Tree>
class component_walk {
    using subtree = typename Tree::subtree;

  public:
    component_walk(const Tree& tree, double radius)
        : tree_(tree),
          limit_(radius * radius),
          certain_(limit_ > least ? limit_ * (1.0 - 1e-12) : 0.0),
          possible_(limit_ > least ? limit_ * (1.0 + 1e-12) : least),
          sets_(tree.size()),
          whole_(tree.nodes()) {}

    template <execution X>
    union_find operator()(const X& run) {
        std::vector<subtree> parts = this->parts();
        run(parts.size(), [&](std::size_t p) { join(parts[p]); });
        run(parts.size(), [&](std::size_t p) {
            for (std::size_t q = p + 1; q < parts.size(); ++q) join(parts[p], parts[q]);
        });
        return std::move(sets_);
    }

  private:
    static constexpr double least = 1e-290;

    std::vector<subtree> parts() const {
        constexpr std::size_t enough = 64;
        std::vector<subtree> level{tree_.root()}, next;
        while (level.size() < enough && level.front().last - level.front().first > 16) {
            next.clear();
            for (const subtree& t : level)
                for (const subtree& child : t.children()) next.push_back(child);
            level.swap(next);
        }
        return level;
    }

    static point_index first_of(const subtree& t) {
        return static_cast<point_index>(t.first * Tree::leaf_size);
    }
    bool one(const subtree& a, const subtree& b) {
        return whole_[a.node] != 0 && whole_[b.node] != 0 &&
               sets_.find(first_of(a)) == sets_.find(first_of(b));
    }

    void join(const subtree& t) {
        if (t.is_leaf()) return join_leaf(t);
        const auto [left, right] = t.children();
        join(left);
        join(right);
        join(left, right);
        whole_[t.node] = one(left, right);
    }

    void join(const subtree& a, const subtree& b) {
        if (!(tree_.box(a).squared_distance_to(tree_.box(b)) <= possible_)) return;
        if (one(a, b)) return;
        if (a.is_leaf() && b.is_leaf()) return join_leaves(a, b);
        if (a.last - a.first >= b.last - b.first) {
            for (const subtree& child : a.children()) join(child, b);
        } else {
            for (const subtree& child : b.children()) join(a, child);
        }
    }

    std::uint32_t lanes_of(const subtree& t) const {
        const std::size_t n = std::min(tree_.size() - first_of(t), Tree::leaf_size);
        return ~std::uint32_t{0} >> (Tree::leaf_size - n);
    }

    void join_leaf(const subtree& t) {
        const point_index first = first_of(t);
        std::uint32_t left = lanes_of(t);
        int pieces = 0;
        if (tree_.box(t).squared_diagonal() <= certain_) {
            for (left &= left - 1; left != 0; left &= left - 1)
                sets_.unite(first, first + static_cast<point_index>(std::countr_zero(left)));
            pieces = 1;
        }
        for (; left != 0; ++pieces) {
            std::uint32_t pending = left & (~left + 1);
            left ^= pending;
            for (; pending != 0 && left != 0;) {
                const auto l = first + static_cast<point_index>(std::countr_zero(pending));
                pending &= pending - 1;
                const std::uint32_t found = near(l, t) & left;
                left ^= found;
                pending |= found;
                for (std::uint32_t f = found; f != 0; f &= f - 1)
                    sets_.unite(l, first + static_cast<point_index>(std::countr_zero(f)));
            }
        }
        whole_[t.node] = pieces == 1;
    }

    void join_leaves(const subtree& a, const subtree& b) {
        const bool both = whole_[a.node] != 0 && whole_[b.node] != 0;
        for (std::uint32_t n = near(a, tree_.box(b)); n != 0; n &= n - 1) {
            const auto l = first_of(a) + static_cast<point_index>(std::countr_zero(n));
            for (std::uint32_t f = near(l, b); f != 0; f &= f - 1) {
                sets_.unite(l, first_of(b) + static_cast<point_index>(std::countr_zero(f)));
                if (both) return;
            }
        }
    }

    std::uint32_t near(const subtree& t, const leaf_box& box) {
        std::uint32_t bits = 0;
        for (std::size_t l = 0; l < Tree::leaf_size; l += pack::size) {
            pack sum(0.0);
            for (std::size_t a = 0; a < 3; ++a) {
                const pack x(tree_.at(a) + first_of(t) + l);
                const pack below = box.low[a] - x, above = x - box.high[a];
                const pack twice = below + magnitude(below) + above + magnitude(above);
                sum += twice * twice;
            }
            bits |= at_most(sum, 4.0 * possible_) << l;
        }
        return bits & lanes_of(t);
    }

    std::uint32_t near(point_index p, const subtree& t) {
        const std::size_t first = first_of(t);
        const pack px(tree_.at(0)[p]), py(tree_.at(1)[p]), pz(tree_.at(2)[p]);
        std::uint32_t certain = 0, possible = 0;
        for (std::size_t l = 0; l < Tree::leaf_size; l += pack::size) {
            const pack dx = pack(tree_.at(0) + first + l) - px;
            const pack dy = pack(tree_.at(1) + first + l) - py;
            const pack dz = pack(tree_.at(2) + first + l) - pz;
            const pack d2 = dx * dx + dy * dy + dz * dz;
            certain |= at_most(d2, certain_) << l;
            possible |= at_most(d2, possible_) << l;
        }
        for (std::uint32_t doubt = possible & ~certain; doubt != 0; doubt &= doubt - 1) {
            const auto l = std::countr_zero(doubt);
            if (squared_distance(position(p), position(first + static_cast<std::size_t>(l))) <=
                limit_)
                certain |= std::uint32_t{1} << l;
        }
        return certain & lanes_of(t);
    }

    Eigen::Vector3d position(std::size_t at) const {
        return {tree_.at(0)[at], tree_.at(1)[at], tree_.at(2)[at]};
    }

    const Tree& tree_;
    double limit_, certain_, possible_;
    union_find sets_;
    std::vector<char> whole_;
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The maximum spanning forest of a graph whose links state whether their two points have equal or
/// opposite signs (Kruskal 1956). It stores the sign of each point relative to the core of its
/// tree, and the weakest link on the path between them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// A link between the points a < b.
struct sign_link {
    double relation = 0.0;  ///< positive for equal signs, negative for opposite ones
    point_index a = 0;
    point_index b = 0;

    /// The certainty of the relation.
    [[nodiscard]] double strength() const { return std::abs(relation); }
};

/// A union-find structure without path compression. The root of the smaller of two joined trees
/// becomes a child of the root of the larger one, by an edge with the relation of the link that
/// joins them: no path has more than log2(n) edges. Links are processed from the strongest to the
/// weakest, so that the weakest edge on the path to the root, the core, is the weakest link of the
/// strongest path between the two points.
class signed_forest {
  public:
    /// Of n points and m links, O(m log m); `Links` is a vector of sign_link. A template, so that
    /// the sort is compiled only where it is used.
    template <class Links>
    signed_forest(std::size_t n, Links links) : nodes_(n) {
        for (std::size_t i = 0; i < n; ++i) nodes_[i].parent = static_cast<point_index>(i);
        std::sort(links.begin(), links.end(), [](const sign_link& x, const sign_link& y) {
            if (x.strength() != y.strength()) return x.strength() > y.strength();
            return x.a != y.a ? x.a < y.a : x.b < y.b;
        });
        for (const sign_link& l : links) join(l);
    }

    /// The path from a point to the core of its tree.
    struct way_to_core {
        point_index core;
        double sign;  ///< 1 or -1, relative to the core
        /// The strength of the weakest link; at the core, that of its strongest link, or 0 without.
        double weakest;
    };

    /// The path of point i. O(log n).
    [[nodiscard]] way_to_core way(std::size_t i) const {
        way_to_core w{static_cast<point_index>(i), 1.0, nodes_[i].strongest};
        while (nodes_[w.core].parent != w.core) {
            const node& hop = nodes_[w.core];
            w.sign *= hop.relation < 0.0 ? -1.0 : 1.0;
            w.weakest = std::abs(hop.relation);  // strengths decrease along the path
            w.core = hop.parent;
        }
        return w;
    }

    /// Numbers the trees from 0, the largest first, equally large ones by their smallest point, and
    /// writes to number[i] the number of the tree of each point for which counts(i) is true.
    /// @return the number of trees with such a point
    std::size_t number_trees(auto&& counts, std::vector<std::int32_t>& number) const {
        std::vector<point_index> roots;
        std::vector<std::int32_t> number_of(nodes_.size(), -1);
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (!counts(i)) continue;
            const point_index root = way(i).core;
            if (number_of[root] < 0) roots.push_back(root);
            number_of[root] = 0;
        }
        std::stable_sort(roots.begin(), roots.end(), [this](point_index a, point_index b) {
            return nodes_[a].size > nodes_[b].size;
        });
        for (std::size_t c = 0; c < roots.size(); ++c) {
            number_of[roots[c]] = static_cast<std::int32_t>(c);
        }
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (counts(i)) number[i] = number_of[way(i).core];
        }
        return roots.size();
    }

  private:
    struct node {
        point_index parent = 0;
        point_index size = 1;    // of the tree, if this is a root
        double relation = 1.0;   // to the parent
        double strongest = 0.0;  // of all links of this point: the first one
    };

    void join(const sign_link& l) {
        way_to_core a = way(l.a);
        way_to_core b = way(l.b);
        if (a.core == b.core) return;
        for (const point_index i : {l.a, l.b}) {
            if (nodes_[i].strongest == 0.0) nodes_[i].strongest = l.strength();
        }
        const double relation = l.relation * a.sign * b.sign;
        // Of equally large trees, that whose core has the stronger link becomes the root, so that
        // the result does not depend on the order of the points.
        const node& x = nodes_[a.core];
        const node& y = nodes_[b.core];
        if (x.size != y.size ? x.size < y.size : x.strongest < y.strongest) std::swap(a, b);
        nodes_[b.core].parent = a.core;
        nodes_[b.core].relation = relation;
        nodes_[a.core].size += nodes_[b.core].size;
    }

    std::vector<node> nodes_;
};

}  // namespace gnomon::detail

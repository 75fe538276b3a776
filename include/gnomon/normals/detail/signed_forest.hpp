// SPDX-License-Identifier: BSL-1.0
/// @file
/// The maximum spanning forest of a graph whose links tell whether their ends have the same sign,
/// by the method of Kruskal 1956, in a form that remembers the sign of each point relative to the
/// core of its tree and the weakest link on the way there.
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
    double relation = 0.0;  ///< > 0 for the same sign, < 0 for opposite ones; how surely
    point_index a = 0;
    point_index b = 0;

    [[nodiscard]] double strength() const { return std::abs(relation); }
};

/// The smaller of two joined trees is hung below the root of the larger one, as a hop that stands
/// for the link between them: no path has more than log2(n) hops. Links are joined from the
/// strongest to the weakest, so the weakest hop to the root of all, the core, is the weakest link
/// of the strongest path there.
class signed_forest {
  public:
    /// Of n points. O(m log m) for m links, `Links` being a vector of them. (As a template, it
    /// costs only those who use it the compilation of a sort.)
    template <class Links>
    signed_forest(std::size_t n, Links links) : nodes_(n) {
        for (std::size_t i = 0; i < n; ++i) nodes_[i].parent = static_cast<point_index>(i);
        std::sort(links.begin(), links.end(), [](const sign_link& x, const sign_link& y) {
            if (x.strength() != y.strength()) return x.strength() > y.strength();
            return x.a != y.a ? x.a < y.a : x.b < y.b;
        });
        for (const sign_link& l : links) join(l);
    }

    /// The way from a point to the core of its tree.
    struct way_to_core {
        point_index core;
        double sign;  ///< 1 or -1, relative to the core
        double
            weakest;  ///< strength of the weakest link; at the core, of its strongest; 0: of none
    };

    /// That of point i. O(log n).
    [[nodiscard]] way_to_core way(std::size_t i) const {
        way_to_core w{static_cast<point_index>(i), 1.0, nodes_[i].strongest};
        while (nodes_[w.core].parent != w.core) {
            const node& hop = nodes_[w.core];
            w.sign *= hop.relation < 0.0 ? -1.0 : 1.0;
            w.weakest = std::abs(hop.relation);  // no hop is stronger than the one before
            w.core = hop.parent;
        }
        return w;
    }

    /// Writes to number[i] the number of its tree, for each point that counts(i) accepts: from 0
    /// on, the largest tree first, equal ones by their smallest point. Returns how many trees there
    /// are.
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
        double strongest = 0.0;  // of all links of this point: the first that came
    };

    void join(const sign_link& l) {
        way_to_core a = way(l.a);
        way_to_core b = way(l.b);
        if (a.core == b.core) return;
        for (const point_index i : {l.a, l.b}) {
            if (nodes_[i].strongest == 0.0) nodes_[i].strongest = l.strength();
        }
        const double relation = l.relation * a.sign * b.sign;
        // Of equally large trees that whose core has the stronger link, for the order of the points
        // must not matter.
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

// SPDX-License-Identifier: BSL-1.0
/// @file
/// A kd-tree made for asking after the neighbors of all its points: balanced, its leaves exactly
/// full with 32 points (but the last), points that are near in space near in memory. It has no
/// pointers: nodes lie in preorder, so that the left child of a node, over m leaves, is next to it
/// and the right one behind the 2 m - 1 nodes of the left.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>

namespace gnomon::detail {

/// An axis-aligned box.
struct leaf_box {
    std::array<double, 3> low, high;

    void add(const std::array<double, 3>& p) {
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    [[nodiscard]] double squared_distance_to(const leaf_box& other) const {
        double sum = 0.0;
        for (std::size_t a = 0; a < 3; ++a) {
            const double gap = std::max({other.low[a] - high[a], low[a] - other.high[a], 0.0});
            sum += gap * gap;
        }
        return sum;
    }
    [[nodiscard]] double squared_diagonal() const {
        double sum = 0.0;
        for (std::size_t a = 0; a < 3; ++a) sum += (high[a] - low[a]) * (high[a] - low[a]);
        return sum;
    }
};

/// The finite points of a position_view in such a tree.
class leaf_tree {
  public:
    static constexpr std::size_t leaf_size = lane_count;
    /// Leaves 4 g to 4 g + 3 are a subtree, the group number g.
    static constexpr std::size_t leaves_per_group = 4;
    static constexpr std::size_t points_per_group = leaves_per_group * leaf_size;

    /// O(n log n), on as many threads as `run` has.
    template <class Points, execution X>
    leaf_tree(const Points& points, const X& run) {
        const auto entries = finite(points, run);
        if (size_ == 0) return;
        leaves_ = (size_ + leaf_size - 1) / leaf_size;
        const std::size_t places = leaves_ * leaf_size;
        for (auto& c : at_) {
            c = touched_array<double>(places, run);
            std::fill(c.get() + size_, c.get() + places, 0.0);
        }
        index_ = touched_array<point_index>(places, run);
        boxes_.resize(2 * leaves() - 1);
        build({entries.get(), size_}, run);
        for (std::size_t l = 0; l + 1 < leaves_ && !crowded_; ++l) {
            const std::size_t first = l * leaf_size;
            crowded_ = std::all_of(at_.begin(), at_.end(), [first](const auto& c) {
                return std::all_of(c.get() + first, c.get() + first + leaf_size,
                                   [&](double x) { return x == c[first]; });
            });
        }
    }

    /// The number of finite points.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t leaves() const { return leaves_; }
    [[nodiscard]] std::size_t groups() const {
        return (leaves_ + leaves_per_group - 1) / leaves_per_group;
    }
    /// Coordinate `axis` of all points; those of leaf l are the 32 from 32 l on.
    [[nodiscard]] const double* at(std::size_t axis) const { return at_[axis].get(); }
    /// The numbers of the points in the cloud, in the same order.
    [[nodiscard]] const point_index* index() const { return index_.get(); }
    [[nodiscard]] std::array<double, 3> position(std::size_t place) const {
        return {at_[0][place], at_[1][place], at_[2][place]};
    }
    /// The canonical squared distance of the points at two places [m^2].
    [[nodiscard]] double squared_distance(std::size_t p, std::size_t q) const {
        return gnomon::squared_distance({at_[0][p], at_[1][p], at_[2][p]},
                                        {at_[0][q], at_[1][q], at_[2][q]});
    }
    /// Whether so many points coincide that they fill a leaf: looking at each of them from each of
    /// them then takes too long.
    [[nodiscard]] bool crowded() const { return crowded_; }
    /// The box of all. Precondition: there are points.
    [[nodiscard]] const leaf_box& box() const { return boxes_[0]; }

    /// A node, by its number in preorder, and the leaves that it is over.
    struct subtree {
        std::size_t node, first, last;

        [[nodiscard]] bool is_leaf() const { return last - first == 1; }
        /// Its children. Precondition: it is no leaf.
        [[nodiscard]] std::array<subtree, 2> children() const {
            const std::size_t middle = middle_of(first, last);
            return {{{node + 1, first, middle}, {node + 2 * (middle - first), middle, last}}};
        }
    };
    /// All of it. Precondition: there are points.
    [[nodiscard]] subtree root() const { return {0, 0, leaves()}; }
    /// The number of nodes, leaves among them.
    [[nodiscard]] std::size_t nodes() const { return boxes_.size(); }
    [[nodiscard]] const leaf_box& box(const subtree& t) const { return boxes_[t.node]; }

    /// Calls visit(leaf, box) for all leaves within `distance` of a box, in their order.
    template <class Visit>
    void for_each_leaf_near(const leaf_box& box, double distance, Visit&& visit) const {
        std::array<subtree, 64> stack;  // as deep as the tree, which has fewer than 2^32 leaves
        std::size_t depth = 0;
        const double limit = distance * distance * (1.0 + 1e-12);
        stack[depth++] = root();
        while (depth > 0) {
            const subtree t = stack[--depth];
            if (!(boxes_[t.node].squared_distance_to(box) <= limit)) continue;
            if (t.is_leaf()) {
                visit(t.first, boxes_[t.node]);
                continue;
            }
            const auto [left, right] = t.children();
            stack[depth++] = right;
            stack[depth++] = left;
        }
    }

  private:
    /// Where a node over the leaves from first to last is split: between groups, if it holds more
    /// than one.
    [[nodiscard]] static std::size_t middle_of(std::size_t first, std::size_t last) {
        const std::size_t half = (last - first + 1) / 2;
        if (last - first <= leaves_per_group) return first + half;
        return first + (half + leaves_per_group - 1) / leaves_per_group * leaves_per_group;
    }

    struct entry {
        std::array<double, 3> at;
        point_index index;
    };

    /// Counts the finite points, and gathers them.
    template <class Points, execution X>
    std::unique_ptr<entry[]> finite(const Points& points, const X& run) {
        std::vector<std::size_t> ends(chunk_count(points.size()));
        for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) count += is_finite(points[i]) ? 1 : 0;
            ends[begin / chunk_size] = count;
        });
        std::inclusive_scan(ends.begin(), ends.end(), ends.begin());
        size_ = ends.empty() ? 0 : ends.back();
        auto entries = touched_array<entry>(size_, run);
        for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
            entry* to = entries.get() + (begin == 0 ? 0 : ends[begin / chunk_size - 1]);
            for (std::size_t i = begin; i < end; ++i) {
                const Eigen::Vector3d p = points[i];
                if (is_finite(p)) *to++ = {{p[0], p[1], p[2]}, static_cast<point_index>(i)};
            }
        });
        return entries;
    }

    /// The upper levels one after the other, the subtrees on each side by side.
    template <execution X>
    void build(std::span<entry> all, const X& run) {
        constexpr std::size_t enough = 64;  // subtrees, to keep all threads busy
        std::vector<subtree> level{root()}, next;
        while (level.size() < enough && level.front().last - level.front().first > 64) {
            next.assign(2 * level.size(), {});
            run(level.size(), [&](std::size_t s) {
                const auto [left, right] = split(all, level[s]);
                next[2 * s] = left;
                next[2 * s + 1] = right;
            });
            level.swap(next);
        }
        run(level.size(), [&](std::size_t s) { build_below(all, level[s]); });
    }

    /// A subtree on one thread. (This and split() are templates, so that only who builds a tree
    /// compiles them.)
    void build_below(auto all, const subtree& t) {
        if (t.is_leaf()) {
            const auto entries = entries_of(all, t);
            boxes_[t.node] = box_of(entries);
            for (std::size_t l = 0; l < entries.size(); ++l) {
                const std::size_t to = t.first * leaf_size + l;
                for (std::size_t a = 0; a < 3; ++a) at_[a][to] = entries[l].at[a];
                index_[to] = entries[l].index;
            }
            return;
        }
        const auto [left, right] = split(all, t);
        build_below(all, left);
        build_below(all, right);
    }

    [[nodiscard]] static std::span<entry> entries_of(std::span<entry> all, const subtree& t) {
        return all.first(std::min(t.last * leaf_size, all.size())).subspan(t.first * leaf_size);
    }

    [[nodiscard]] static leaf_box box_of(std::span<const entry> entries) {
        leaf_box box{entries[0].at, entries[0].at};
        for (const entry& p : entries) box.add(p.at);
        return box;
    }

    /// Sorts the points of a node to its children, across the longest side of its box.
    std::array<subtree, 2> split(auto all, const subtree& t) {
        const auto entries = entries_of(all, t);
        const leaf_box& box = boxes_[t.node] = box_of(entries);
        std::size_t axis = 0;
        for (std::size_t a = 1; a < 3; ++a)
            if (box.high[a] - box.low[a] > box.high[axis] - box.low[axis]) axis = a;
        const auto children = t.children();
        const auto at = static_cast<std::ptrdiff_t>((children[1].first - t.first) * leaf_size);
        std::nth_element(
            entries.begin(), entries.begin() + at, entries.end(),
            [axis](const entry& p, const entry& q) { return p.at[axis] < q.at[axis]; });
        return children;
    }

    std::size_t size_ = 0;
    std::size_t leaves_ = 0;
    bool crowded_ = false;
    std::array<std::unique_ptr<double[]>, 3> at_;
    std::unique_ptr<point_index[]> index_;
    std::vector<leaf_box> boxes_;  // of the nodes, in preorder
};

}  // namespace gnomon::detail

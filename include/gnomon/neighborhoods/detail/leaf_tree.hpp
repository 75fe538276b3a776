// SPDX-License-Identifier: BSL-1.0
/// @file
/// The kd-tree of `spatial_index`: a median split across the longest side of each box until leaves
/// hold exactly 32 points (the last one fewer). Points of a leaf are adjacent in memory, coordinate
/// by coordinate, so that vector instructions read them. There are no pointers: nodes lie in
/// preorder; the left child of a node over m leaves follows it, and the right child follows the
/// 2 m' - 1 nodes of a left subtree of m' leaves.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/kept_array.hpp>
#include <gnomon/core/detail/reset_on_move.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/finite_entries.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>
#include <gnomon/neighborhoods/detail/leaf_box.hpp>
#include <gnomon/neighborhoods/detail/leaf_subtree.hpp>

namespace gnomon::detail {

#if defined(GNOMON_COUNT_TREES)
/// The number of trees that were built, for tests of how often an algorithm builds one.
inline std::atomic<std::size_t> trees_built{0};
#endif

/// The finite points of a position_view in such a tree.
class leaf_tree {
  public:
    static constexpr std::size_t leaf_size = lane_count;
    /// Leaves 4 g to 4 g + 3 are a subtree, the group number g.
    static constexpr std::size_t leaves_per_group = leaf_subtree::leaves_per_group;
    static constexpr std::size_t points_per_group = leaves_per_group * leaf_size;
    /// The place of points that are not in the tree.
    static constexpr point_index no_place = std::numeric_limits<point_index>::max();

    leaf_tree() = default;

    /// O(n log n), on as many threads as `run` has.
    template <class Points, execution X>
    leaf_tree(const Points& points, const X& run) {
        rebuild(points, run);
        release_scratch();
    }

    /// Replaces the points, in the memory of the tree; allocates only to grow.
    template <class Points, execution X>
    void rebuild(const Points& points, const X& run) {
        clear_unless_built guard{this};
#if defined(GNOMON_COUNT_TREES)
        ++trees_built;
#endif
        place_of_.resize(points.size(), run);
        for_each_chunk(run, points.size(), [this](std::size_t begin, std::size_t end) {
            std::fill(place_of_.data() + begin, place_of_.data() + end, no_place);
        });
        entries_.gather(points, run);
        size_ = entries_.size();
        leaves_ = (size_ + leaf_size - 1) / leaf_size;
        const std::size_t places = leaves_ * leaf_size;
        for (auto& c : at_) c.resize(places, run);
        index_.resize(places, run);
        boxes_.resize(leaves_ > 0 ? 2 * leaves_ - 1 : 0, run);
        crowded_ = false;
        if (size_ == 0) return guard.dismiss();
        for (auto& c : at_) std::fill(c.data() + size_, c.data() + places, 0.0);
        build(entries_.all(), run);
        for (std::size_t l = 0; l + 1 < leaves_ && !crowded_; ++l) crowded_ = is_at_one_position(l);
        guard.dismiss();
    }

    /// Makes it a tree of no points, which keeps its memory.
    void clear() {
        size_ = leaves_ = 0;
        place_of_.resize(0, sequential{});
    }

    /// Gives back what only building needs.
    void release_scratch() { entries_.release(); }

    /// The number of finite points.
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t leaves() const { return leaves_; }
    [[nodiscard]] std::size_t groups() const {
        return (leaves_ + leaves_per_group - 1) / leaves_per_group;
    }
    /// Coordinate `axis` of all points; those of leaf l are the 32 from 32 l on.
    [[nodiscard]] const double* at(std::size_t axis) const { return at_[axis].data(); }
    /// The numbers of the points in the cloud, in the same order.
    [[nodiscard]] const point_index* index() const { return index_.data(); }
    /// The number of all points of the cloud, finite or not.
    [[nodiscard]] std::size_t points() const { return place_of_.size(); }
    /// The place of point i of the cloud; `no_place` if it is not finite.
    [[nodiscard]] point_index place_of(std::size_t i) const { return place_of_[i]; }
    [[nodiscard]] std::array<double, 3> position(std::size_t place) const {
        return {at_[0][place], at_[1][place], at_[2][place]};
    }
    /// The canonical squared distance of the points at two places [m^2].
    [[nodiscard]] double squared_distance(std::size_t p, std::size_t q) const {
        return gnomon::squared_distance({at_[0][p], at_[1][p], at_[2][p]},
                                        {at_[0][q], at_[1][q], at_[2][q]});
    }
    /// Whether one leaf or more is filled by points at one position. A search of all points for all
    /// points would then be quadratic in their number.
    [[nodiscard]] bool crowded() const { return crowded_; }
    /// The box of all points. Precondition: there are points.
    [[nodiscard]] const leaf_box& box() const { return boxes_[0]; }

    using subtree = leaf_subtree;
    /// All of it. Precondition: there are points.
    [[nodiscard]] subtree root() const { return {0, 0, leaves()}; }
    /// The number of nodes, leaves among them.
    [[nodiscard]] std::size_t nodes() const { return boxes_.size(); }
    [[nodiscard]] const leaf_box& box(const subtree& t) const { return boxes_[t.node]; }

    /// Calls visit(leaf, box) for all leaves within `distance` of a box, in their order.
    template <class Visit>
    void for_each_leaf_near(const leaf_box& box, double distance, Visit&& visit) const {
        std::array<subtree, 64> waiting;  // as deep as the tree, which has fewer than 2^32 leaves
        std::size_t depth = 0;
        const double limit = distance * distance * (1.0 + 1e-12);
        const auto is_near = [&](const subtree& t) {
            return boxes_[t.node].squared_distance_to(box) <= limit;
        };
        // Without a branch for each box, which would often be predicted wrongly.
        if (is_near(root())) waiting[depth++] = root();
        while (depth > 0) {
            subtree t = waiting[--depth];
            bool nearby = true;
            while (nearby && !t.is_leaf()) {
                const auto [left, right] = t.children();
                waiting[depth] = right;
                depth += static_cast<std::size_t>(is_near(right));
                nearby = is_near(left);
                t = left;
            }
            if (nearby) visit(t.first, boxes_[t.node]);
        }
    }

  private:
    /// A tree whose building ends by an exception is one of no points.
    struct clear_unless_built {
        leaf_tree* tree;

        ~clear_unless_built() {
            if (tree != nullptr) tree->clear();
        }
        void dismiss() { tree = nullptr; }
    };

    [[nodiscard]] bool is_at_one_position(std::size_t leaf) const {
        const std::size_t first = leaf * leaf_size;
        return std::all_of(at_.begin(), at_.end(), [first](const auto& c) {
            return std::all_of(c.data() + first, c.data() + first + leaf_size,
                               [&](double x) { return x == c[first]; });
        });
    }

    using entry = tree_entry;

    /// The upper levels one after the other, the subtrees on each side by side.
    template <execution X>
    void build(std::span<entry> all, const X& run) {
        constexpr std::size_t enough = 64;  // subtrees, to keep all threads busy
        std::array<subtree, enough> level{root()}, next{};
        std::size_t subtrees = 1;
        for (; subtrees < enough && level[0].last - level[0].first > 64; subtrees *= 2) {
            run(subtrees, [&](std::size_t s) {
                const auto [left, right] = split(all, level[s]);
                next[2 * s] = left;
                next[2 * s + 1] = right;
            });
            level = next;
        }
        run(subtrees, [&](std::size_t s) { build_below(all, level[s]); });
    }

    /// A subtree on one thread. (This and split() are templates, so that only code that builds a
    /// tree compiles them.)
    void build_below(auto all, const subtree& t) {
        if (t.is_leaf()) {
            const auto entries = entries_of(all, t);
            boxes_[t.node] = box_of(entries);
            if (boxes_[t.node].is_point()) sort_by_index(entries);
            for (std::size_t l = 0; l < entries.size(); ++l) {
                const std::size_t to = t.first * leaf_size + l;
                for (std::size_t a = 0; a < 3; ++a) at_[a][to] = entries[l].at[a];
                index_[to] = entries[l].index;
                place_of_[entries[l].index] = static_cast<point_index>(to);
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
        if (box.is_point()) {
            sort_by_index(entries);
            return children;
        }
        const auto at = static_cast<std::ptrdiff_t>((children[1].first - t.first) * leaf_size);
        std::nth_element(
            entries.begin(), entries.begin() + at, entries.end(),
            [axis](const entry& p, const entry& q) { return p.at[axis] < q.at[axis]; });
        return children;
    }

    reset_on_move<std::size_t> size_;
    reset_on_move<std::size_t> leaves_;
    bool crowded_ = false;
    std::array<kept_array<double>, 3> at_;
    kept_array<point_index> index_;
    kept_array<point_index> place_of_;
    kept_array<leaf_box> boxes_;  // of the nodes, in preorder
    finite_entries entries_;      // while building
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// A bounding volume hierarchy over axis-aligned boxes, built top-down with the binned surface area
/// heuristic (Wald 2007) and traversed from near to far.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/ray.hpp>

namespace gnomon::simulation::detail {

/// Half the surface area of nonempty bounds [m^2], which is proportional to the probability of a
/// hit.
[[nodiscard]] inline double half_area(const bounds& b) {
    const double x = b.high.x() - b.low.x();
    const double y = b.high.y() - b.low.y();
    const double z = b.high.z() - b.low.z();
    return x * y + y * z + z * x;
}

/// A binary tree over numbered boxes.
class bvh {
  public:
    bvh() = default;

    /// O(n log n). Precondition: all boxes are finite, and fewer than 2^31.
    explicit bvh(const std::vector<bounds>& boxes) : items_(boxes.size()) {
        std::iota(items_.begin(), items_.end(), std::uint32_t{0});
        if (boxes.empty()) return;
        nodes_.reserve(2 * boxes.size());
        nodes_.emplace_back();
        build(boxes, 0, 0, static_cast<std::uint32_t>(boxes.size()), 0);
    }

    /// Calls visit(item) for each item whose box the ray meets within r.reach, near boxes first.
    /// The visitor shortens the reach to the nearest hit.
    void walk(ray& r, auto&& visit) const {
        if (nodes_.empty()) return;
        r.reach = std::min(r.reach, std::numeric_limits<double>::max());  // infinity marks a miss
        const slopes s(r);
        std::array<pending, stack_size> stack;
        std::size_t height = 0;
        pending next{s.entry(nodes_[0].box, r.reach), 0};
        while (true) {
            if (next.entry <= r.reach) {
                const node& n = nodes_[next.node];
                if (n.items > 0) {
                    for (std::uint32_t i = 0; i < n.items; ++i) visit(items_[n.first + i]);
                } else {
                    pending nearer{s.entry(nodes_[n.first].box, r.reach), n.first};
                    pending farther{s.entry(nodes_[n.first + 1].box, r.reach), n.first + 1};
                    if (farther.entry < nearer.entry) std::swap(nearer, farther);
                    if (farther.entry <= r.reach) stack[height++] = farther;
                    next = nearer;
                    continue;
                }
            }
            if (height == 0) return;
            next = stack[--height];
        }
    }

  private:
    struct node {
        bounds box;
        std::uint32_t first = 0;  // the first item of a leaf, else the first of the two children
        std::uint32_t items = 0;
    };

    struct pending {
        double entry;  // range at which the ray enters the node; infinite if it does not
        std::uint32_t node;
    };

    /// A ray with its inverse direction, for slab tests.
    struct slopes {
        Eigen::Vector3d origin;
        std::array<double, 3> inverse;
        std::array<bool, 3> backwards;

        explicit slopes(const ray& r) : origin(r.origin) {
            for (int a = 0; a < 3; ++a) {
                const auto i = static_cast<std::size_t>(a);
                inverse[i] = 1.0 / r.direction[a];
                backwards[i] = inverse[i] < 0.0;
            }
        }

        /// A lower bound of the range at which the ray enters the box; infinite if it does not
        /// within `reach`. The slab method with a margin for rounding (Ize 2013). A NaN, from a ray
        /// within the plane of a side, fails the comparison and leaves the interval unchanged.
        [[nodiscard]] double entry(const bounds& box, double reach) const {
            constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
            double enter = 0.0;
            double leave = reach * (1.0 + rounding);
            for (int a = 0; a < 3; ++a) {
                const auto i = static_cast<std::size_t>(a);
                const double in =
                    ((backwards[i] ? box.high[a] : box.low[a]) - origin[a]) * inverse[i];
                const double out = ((backwards[i] ? box.low[a] : box.high[a]) - origin[a]) *
                                   inverse[i] * (1.0 + rounding);
                if (in > enter) enter = in;
                if (out < leave) leave = out;
            }
            return enter <= leave ? enter * (1.0 - rounding)
                                  : std::numeric_limits<double>::infinity();
        }
    };

    static constexpr std::uint32_t most_items = 4;  // in a leaf
    static constexpr std::size_t bins = 16;
    // Below this depth the items are halved, at most 32 times.
    static constexpr std::size_t most_uneven_splits = 64;
    static constexpr std::size_t stack_size = most_uneven_splits + 34;

    /// Splits the items [first, last) below node `at`.
    void build(const std::vector<bounds>& boxes, std::uint32_t at, std::uint32_t first,
               std::uint32_t last, std::size_t depth) {
        bounds centers;
        for (std::uint32_t i = first; i < last; ++i) {
            const bounds& b = boxes[items_[i]];
            nodes_[at].box.extend(b);
            centers.extend(b.middle());
        }
        if (last - first <= most_items) {
            nodes_[at].first = first;
            nodes_[at].items = last - first;
            return;
        }
        const std::uint32_t middle = split(boxes, centers, first, last, depth);
        const auto children = static_cast<std::uint32_t>(nodes_.size());
        nodes_[at].first = children;
        nodes_.emplace_back();
        nodes_.emplace_back();
        build(boxes, children, first, middle, depth + 1);
        build(boxes, children + 1, middle, last, depth + 1);
    }

    /// Partitions the items and returns where the second part begins.
    std::uint32_t split(const std::vector<bounds>& boxes, const bounds& centers,
                        std::uint32_t first, std::uint32_t last, std::size_t depth) {
        const std::uint32_t half = first + (last - first) / 2;
        if (depth >= most_uneven_splits) return half;

        double least = std::numeric_limits<double>::infinity();
        int best_axis = -1;
        std::size_t best_bin = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(centers.high[axis] > centers.low[axis])) continue;
            std::array<bounds, bins> box;
            std::array<std::uint32_t, bins> count{};
            for (std::uint32_t i = first; i < last; ++i) {
                const bounds& b = boxes[items_[i]];
                const std::size_t bin = bin_of(b, centers, axis);
                box[bin].extend(b);
                ++count[bin];
            }
            // The cost of the items above each split plane, then of those below it.
            std::array<double, bins> above{};
            bounds swept;
            std::uint32_t n = 0;
            for (std::size_t bin = bins - 1; bin > 0; --bin) {
                swept.extend(box[bin]);
                n += count[bin];
                above[bin] = n == 0 ? 0.0 : n * half_area(swept);
            }
            swept = bounds{};
            n = 0;
            for (std::size_t bin = 1; bin < bins; ++bin) {
                swept.extend(box[bin - 1]);
                n += count[bin - 1];
                if (n == 0 || n == last - first) continue;
                const double cost = n * half_area(swept) + above[bin];
                if (cost < least) {
                    least = cost;
                    best_axis = axis;
                    best_bin = bin;
                }
            }
        }
        if (best_axis < 0) return half;  // all centers coincide
        const auto middle = std::partition(
            items_.begin() + static_cast<std::ptrdiff_t>(first),
            items_.begin() + static_cast<std::ptrdiff_t>(last),
            [&](std::uint32_t item) { return bin_of(boxes[item], centers, best_axis) < best_bin; });
        return static_cast<std::uint32_t>(middle - items_.begin());
    }

    [[nodiscard]] static std::size_t bin_of(const bounds& b, const bounds& centers, int axis) {
        const double share =
            (b.middle()[axis] - centers.low[axis]) / (centers.high[axis] - centers.low[axis]);
        return std::min(bins - 1, static_cast<std::size_t>(share * bins));
    }

    std::vector<node> nodes_;
    std::vector<std::uint32_t> items_;  // of the leaves, contiguous
};

}  // namespace gnomon::simulation::detail

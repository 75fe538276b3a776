// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which points are one surface: the partition that every segmentation here returns, seen both
/// ways, as a label per point and as a group of points per label (Klasing 2010, Sec. 4.2.1).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/union_find.hpp>

namespace gnomon {

/// The label of points that belong to no segment.
inline constexpr std::int32_t unlabeled = -1;

/// Disjoint groups of points. Segmentations number them from the largest to the smallest, equal
/// ones by their smallest point index, so that the result does not depend on threads.
class segments {
  public:
    segments() = default;

    /// The groups of a labeling in which each label is `unlabeled` or at least 0.
    /// O(n + largest label), in memory too: number labels from 0 on.
    /// @throws std::invalid_argument  for another negative label
    explicit segments(std::vector<std::int32_t> labels) : labels_(std::move(labels)) {
        std::int32_t last = unlabeled;
        for (const std::int32_t l : labels_) {
            detail::require(l >= unlabeled, "segments: a label is neither -1 nor at least 0");
            last = std::max(last, l);
        }
        // Counting sort by label; the points of a group stay in ascending order.
        begin_.assign(static_cast<std::size_t>(std::int64_t{last} + 2), 0);
        for (const std::int32_t l : labels_) {
            if (l != unlabeled) ++begin_[static_cast<std::size_t>(l) + 1];
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        members_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < labels_.size(); ++i) {
            if (labels_[i] == unlabeled) continue;
            members_[next[static_cast<std::size_t>(labels_[i])]++] = static_cast<point_index>(i);
        }
    }

    /// Number of segments.
    [[nodiscard]] std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
    [[nodiscard]] bool empty() const { return size() == 0; }

    /// The indices of the points of segment `label`, ascending.
    [[nodiscard]] std::span<const point_index> operator[](std::size_t label) const& {
        return {members_.data() + begin_[label], members_.data() + begin_[label + 1]};
    }
    void operator[](std::size_t label) && = delete;  // its points would be gone

    /// The label of each point, `unlabeled` for those of no segment.
    [[nodiscard]] const std::vector<std::int32_t>& labels() const& { return labels_; }
    [[nodiscard]] std::vector<std::int32_t> labels() && { return std::move(labels_); }

    friend bool operator==(const segments&, const segments&) = default;

  private:
    std::vector<std::int32_t> labels_;
    std::vector<std::size_t> begin_{0};
    std::vector<point_index> members_;
};

namespace detail {

/// The segments that have points, renumbered from the largest to the smallest, equal ones by their
/// smallest point index, with the numbers that they had. O(n + s log s) for s segments. (As a
/// template, it costs only those who use it the compilation of a sort.)
[[nodiscard]] std::pair<segments, std::vector<std::size_t>> largest_first(const auto& found) {
    std::vector<std::size_t> order;
    for (std::size_t s = 0; s < found.size(); ++s) {
        if (!found[s].empty()) order.push_back(s);
    }
    std::sort(order.begin(), order.end(), [&found](std::size_t a, std::size_t b) {
        if (found[a].size() != found[b].size()) return found[a].size() > found[b].size();
        return found[a].front() < found[b].front();
    });
    std::vector<std::int32_t> labels(found.labels().size(), unlabeled);
    for (std::size_t s = 0; s < order.size(); ++s) {
        for (const point_index i : found[order[s]]) labels[i] = static_cast<std::int32_t>(s);
    }
    return {segments(std::move(labels)), std::move(order)};
}

/// The sets of a partition that have at least `min_points` members, largest first, where counts(i)
/// tells whether i may be a member at all. O(n log n).
[[nodiscard]] segments segments_of(union_find& sets, std::size_t min_points, auto&& counts) {
    std::vector<std::size_t> count(sets.size(), 0);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        if (counts(i)) ++count[sets.find(static_cast<point_index>(i))];
    }

    std::vector<point_index> roots;
    for (std::size_t i = 0; i < count.size(); ++i) {
        if (count[i] > 0 && count[i] >= min_points) roots.push_back(static_cast<point_index>(i));
    }
    std::stable_sort(roots.begin(), roots.end(),
                     [&count](point_index a, point_index b) { return count[a] > count[b]; });

    std::vector<std::int32_t> label_of_root(sets.size(), unlabeled);
    for (std::size_t r = 0; r < roots.size(); ++r) {
        label_of_root[roots[r]] = static_cast<std::int32_t>(r);
    }
    std::vector<std::int32_t> labels(sets.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        labels[i] = label_of_root[sets.find(static_cast<point_index>(i))];
    }
    return segments(std::move(labels));
}

}  // namespace detail
}  // namespace gnomon

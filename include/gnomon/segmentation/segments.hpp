// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which points are one surface: the partition that every segmentation here returns, seen both
/// ways, as a label per point and as a group of points per label (Klasing 2010, Sec. 4.2.1).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/begins_from_sizes.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon {

/// The label of points that belong to no segment.
inline constexpr std::int32_t unlabeled = -1;

namespace detail {

/// The groups of a labeling, by a counting sort: members[begin[l]] to members[begin[l + 1]] are the
/// indices of label l, ascending. Labels below 0 have no group. O(n + largest label).
void group_by_label(std::span<const std::int32_t> labels, auto& begin, auto& members) {
    const std::int32_t last = labels.empty() ? -1 : *std::max_element(labels.begin(), labels.end());
    begin.assign(static_cast<std::size_t>(std::max<std::int64_t>(last, -1) + 2), 0);
    for (const std::int32_t l : labels)
        if (l >= 0) ++begin[static_cast<std::size_t>(l) + 1];
    begins_from_sizes(begin);
    members.resize(begin.back());
    // Each begin[l] is advanced to the end of its group, which is the begin of the next one.
    for (std::size_t i = 0; i < labels.size(); ++i)
        if (labels[i] >= 0)
            members[begin[static_cast<std::size_t>(labels[i])]++] = static_cast<point_index>(i);
    std::copy_backward(begin.begin(), begin.end() - 1, begin.end());
    begin.front() = 0;
}

}  // namespace detail

/// Disjoint groups of points. Segmentations number them from the largest to the smallest, equal
/// ones by their smallest point index, so that the result does not depend on threads.
class segments {
  public:
    segments() = default;

    /// The groups of a labeling in which each label is `unlabeled` or at least 0.
    /// O(n + largest label), in memory too: number labels from 0 on.
    /// @throws std::invalid_argument  for another negative label
    explicit segments(std::vector<std::int32_t> labels) : labels_(std::move(labels)) {
        require_valid(labels_);
        detail::group_by_label(labels_, begin_, members_);
    }

    /// Replaces the groups by those of a labeling of n points, as the constructor, in the memory of
    /// this object; allocates only to grow. O(n + largest label). Precondition: `labels` does not
    /// refer to labels() of this object.
    /// @throws std::invalid_argument  for a negative label that is not `unlabeled`; the groups are
    ///                                then the same as before
    void assign(std::span<const std::int32_t> labels) {
        require_valid(labels);
        labels_.assign(labels.begin(), labels.end());
        detail::group_by_label(labels_, begin_, members_);
    }

    /// Number of segments.
    [[nodiscard]] std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
    [[nodiscard]] bool empty() const { return size() == 0; }

    /// The indices of the points of segment `label`, ascending.
    [[nodiscard]] std::span<const point_index> operator[](std::size_t label) const& {
        return {members_.data() + begin_[label], members_.data() + begin_[label + 1]};
    }
    void operator[](std::size_t label) && = delete;  // its points would be destroyed

    /// The label of each point: its segment, or `unlabeled`.
    [[nodiscard]] const std::vector<std::int32_t>& labels() const& { return labels_; }
    /// The labels, moved out of a temporary.
    [[nodiscard]] std::vector<std::int32_t> labels() && { return std::move(labels_); }

    friend bool operator==(const segments&, const segments&) = default;

  private:
    static void require_valid(std::span<const std::int32_t> labels) {
        for (const std::int32_t l : labels)
            detail::require(l >= unlabeled, "segments: a label is neither -1 nor at least 0");
    }

    std::vector<std::int32_t> labels_;
    std::vector<std::size_t> begin_{0};
    std::vector<point_index> members_;
};

namespace detail {

/// The groups of a labeling in scratch memory, for algorithms that need them only while they run.
class label_groups {
  public:
    /// @param labels  a contiguous range
    explicit label_groups(const auto& labels) { group_by_label(labels, begin_, members_); }

    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    /// The indices of the points of a label, ascending.
    [[nodiscard]] std::span<const point_index> operator[](std::size_t label) const {
        return {members_.data() + begin_[label], members_.data() + begin_[label + 1]};
    }

  private:
    scratch<std::size_t> begin_;
    scratch<point_index> members_;
};

/// Renumbers labels from the most frequent one to the least frequent one, equally frequent ones by
/// their smallest point index; those of fewer than `min_points` points become `unlabeled`.
/// O(n + largest label + s log s) for s labels. (A template, so that only its users compile a
/// sort.)
void number_by_size(auto& labels, std::size_t min_points = 0) {
    struct group {
        point_index size = 0;
        point_index first = 0;  // its smallest point index
    };
    scratch<group> groups;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == unlabeled) continue;
        const auto l = static_cast<point_index>(labels[i]);
        if (l >= groups.size()) groups.resize(std::max(l + std::size_t{1}, labels.size()));
        if (groups[l].size++ == 0) groups[l].first = static_cast<point_index>(i);
    }
    scratch<point_index> order;
    for (std::size_t l = 0; l < groups.size(); ++l)
        if (groups[l].size >= std::max<std::size_t>(min_points, 1))
            order.push_back(static_cast<point_index>(l));
    std::sort(order.begin(), order.end(), [&groups](point_index a, point_index b) {
        return groups[a].size != groups[b].size ? groups[a].size > groups[b].size
                                                : groups[a].first < groups[b].first;
    });
    scratch<std::int32_t> renumbered(groups.size(), unlabeled);
    for (std::size_t r = 0; r < order.size(); ++r)
        renumbered[order[r]] = static_cast<std::int32_t>(r);
    for (auto& l : labels)
        if (l != unlabeled) l = renumbered[static_cast<point_index>(l)];
}

/// Replaces labels by the smallest of their sets.
void unite_labels(auto& labels, union_find& sets) {
    for (std::int32_t& l : labels)
        if (l != unlabeled) l = static_cast<std::int32_t>(sets.find(static_cast<point_index>(l)));
}

/// The label of each element: its set, numbered as by number_by_size, where counts(i) returns
/// whether element i is a member of it.
[[nodiscard]] scratch<std::int32_t> labels_of_sets(union_find& sets, std::size_t min_points,
                                                   auto&& counts) {
    scratch<std::int32_t> labels(sets.size(), unlabeled);
    for (std::size_t i = 0; i < labels.size(); ++i)
        if (counts(i))
            labels[i] = static_cast<std::int32_t>(sets.find(static_cast<point_index>(i)));
    number_by_size(labels, min_points);
    return labels;
}

/// The segments of these labels. (A template, so that only its users compile a grouping.)
[[nodiscard]] segments segments_of(const auto& labels) {
    segments result;
    result.assign(labels);
    return result;
}

/// The segments of these labels, largest first. (A template, so that only its users compile a
/// sort.)
[[nodiscard]] segments numbered_segments_of(auto labels, std::size_t min_points = 0) {
    number_by_size(labels, min_points);
    return segments_of(labels);
}

}  // namespace detail
}  // namespace gnomon

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
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
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
/// their smallest point index. O(n + largest label + s log s) for s labels. (A template, so that
/// only its users compile a sort.)
/// @return the previous numbers, in the new order
template <class Labels>
scratch<std::int32_t> number_by_size(Labels& labels) {
    struct group {
        std::size_t size = 0;
        std::size_t first = 0;  // its smallest point index
    };
    scratch<group> groups;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] < 0) continue;
        const auto l = static_cast<std::size_t>(labels[i]);
        if (l >= groups.size()) groups.resize(l + 1);
        if (groups[l].size++ == 0) groups[l].first = i;
    }
    scratch<std::int32_t> order;
    for (std::size_t l = 0; l < groups.size(); ++l)
        if (groups[l].size > 0) order.push_back(static_cast<std::int32_t>(l));
    const auto of = [&groups](std::int32_t l) { return groups[static_cast<std::size_t>(l)]; };
    std::sort(order.begin(), order.end(), [&of](std::int32_t a, std::int32_t b) {
        return of(a).size != of(b).size ? of(a).size > of(b).size : of(a).first < of(b).first;
    });
    scratch<std::int32_t> number(groups.size(), unlabeled);
    for (std::size_t s = 0; s < order.size(); ++s)
        number[static_cast<std::size_t>(order[s])] = static_cast<std::int32_t>(s);
    for (std::int32_t& label : labels)
        if (label >= 0) label = number[static_cast<std::size_t>(label)];
    return order;
}

/// Labels the sets of a partition that have at least `min_points` members, from the largest to the
/// smallest, where counts(i) returns whether element i is counted as a member. O(n log n).
[[nodiscard]] scratch<std::int32_t> labels_of_sets(union_find& sets, std::size_t min_points,
                                                   auto&& counts) {
    scratch<point_index> count(sets.size(), 0);
    for (std::size_t i = 0; i < sets.size(); ++i)
        if (counts(i)) ++count[sets.find(static_cast<point_index>(i))];

    scratch<point_index> roots;
    for (std::size_t i = 0; i < count.size(); ++i)
        if (count[i] > 0 && count[i] >= min_points) roots.push_back(static_cast<point_index>(i));
    std::sort(roots.begin(), roots.end(), [&count](point_index a, point_index b) {
        return count[a] != count[b] ? count[a] > count[b] : a < b;
    });

    scratch<std::int32_t> label_of_root(sets.size(), unlabeled);
    for (std::size_t r = 0; r < roots.size(); ++r)
        label_of_root[roots[r]] = static_cast<std::int32_t>(r);
    scratch<std::int32_t> labels(sets.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
        labels[i] = label_of_root[sets.find(static_cast<point_index>(i))];
    return labels;
}

/// The segments of these sets; see labels_of_sets.
[[nodiscard]] segments segments_of(union_find& sets, std::size_t min_points, auto&& counts) {
    segments result;
    result.assign(labels_of_sets(sets, min_points, counts));
    return result;
}

}  // namespace detail
}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The parts of labeled regions that no neighbors connect: planes that meet nowhere may be the same
/// by chance, such as the middle of a road and a pavement beyond its lower side. Whether they are
/// one surface is for merging to decide, by what was seen between them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Gives labels of their own to the parts of regions that no neighbors connect. The largest part
/// keeps the label of its region, and so do parts of fewer than `min_points`. O(n (k + log n)) for
/// k neighbors.
/// @param graph   the neighbors of each point; of two points one may be a neighbor of the other
///                alone
/// @param labels  contiguous, from 0, or `unlabeled`
/// @return whether there are new labels
template <neighborhood_graph G, execution X>
[[nodiscard]] bool separate_parts(const G& graph, scratch<std::int32_t>& labels,
                                  std::size_t min_points, const X& run) {
    union_find connected(labels.size());
    for_each_chunk(run, labels.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (labels[i] == unlabeled) continue;
            for (const point_index j : graph[i])
                if (labels[j] == labels[i]) connected.unite(static_cast<point_index>(i), j);
        }
    });
    scratch<std::int32_t> part_of(labels.size(), unlabeled);
    std::int32_t next = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == unlabeled) continue;
        part_of[i] = static_cast<std::int32_t>(connected.find(static_cast<point_index>(i)));
        next = std::max(next, labels[i] + 1);
    }
    number_by_size(part_of, min_points);
    const label_groups parts(part_of);  // the largest first
    scratch<char> has_part(static_cast<std::size_t>(next), false);
    const std::int32_t first_new = next;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        char& has = has_part[static_cast<std::size_t>(labels[parts[p].front()])];
        if (has != 0) {
            for (const point_index i : parts[p]) labels[i] = next;
            ++next;
        }
        has = true;
    }
    return next > first_new;
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The labels of a cloud, and the planes of the regions that they are the numbers of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Replaces labels, but `unlabeled`, by number_of(label).
void renumber(auto& labels, auto&& number_of) {
    for (std::int32_t& label : labels)
        if (label != unlabeled) label = number_of(label);
}

/// Sets the sums and planes of the regions of labels. Regions that are too small, or no planes,
/// become empty, and their points unlabeled. O(n)
void fit_regions(const auto& cloud, std::size_t min_points, auto& labels, auto& regions) {
    std::int32_t most = unlabeled;
    for (const std::int32_t label : labels) most = std::max(most, label);
    regions.assign(static_cast<std::size_t>(most + 1), {});
    for (std::size_t i = 0; i < labels.size(); ++i)
        if (labels[i] != unlabeled) cloud.add(i, regions[static_cast<std::size_t>(labels[i])].sums);
    for (planar_region& r : regions) {
        r.fit = r.sums.fit();
        if (r.sums.summands < min_points || !r.fit.is_determined) r = {};
    }
    renumber(labels, [&](std::int32_t label) {
        return regions[static_cast<std::size_t>(label)].is_empty() ? unlabeled : label;
    });
}

/// Numbers regions again, without the empty ones. O(n)
void number_regions(auto& labels, auto& regions) {
    scratch<std::int32_t> number(regions.size(), unlabeled);
    std::size_t kept = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (regions[r].is_empty()) continue;
        number[r] = static_cast<std::int32_t>(kept);
        regions[kept++] = regions[r];
    }
    regions.resize(kept);
    renumber(labels, [&](std::int32_t label) { return number[static_cast<std::size_t>(label)]; });
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planar pieces of a curved surface: a road that falls to its sides is several planes. Two
/// regions next to each other belong to one surface if a paraboloid explains both better than their
/// planes do; at a crease or a step the planes are better. Apart from each other they may do so if
/// it explains them as well, and one of them is curved by itself.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/common_paraboloid.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_patch.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Whether two regions next to each other are pieces of one curved surface: their planes are
/// certainly turned, and not at an edge.
/// @param a, b          planar_regions
/// @param of_a, of_b    their patches
[[nodiscard]] bool are_of_curved_surface(const auto& a, const surface_patch& of_a, const auto& b,
                                         const surface_patch& of_b) {
    constexpr angle least = degrees(0.5);  // numerical: parallel planes meet in no line
    return are_turned(a, b, least) && !are_turned(a, b, widest_crease) &&
           common_paraboloid(of_a, of_b).is_better();
}

/// How much worse a paraboloid explains two patches apart from each other than their planes do, at
/// least one of which is of several regions; at most 1 if they may be merged. As for planes, the
/// smaller one must be near the paraboloid of the larger one.
[[nodiscard]] inline double dissimilarity_of_curved(const surface_patch& a, const surface_patch& b,
                                                    double max_offset) {
    constexpr double chi2_of_6 = 19.8;  // 99.7 %, of six degrees of freedom
    constexpr double never = std::numeric_limits<double>::infinity();
    if (std::min(a.regions, b.regions) == 0 || std::max(a.regions, b.regions) == 1) return never;
    const common_paraboloid both(a, b);
    if (!both.is_determined() || both.offset() > max_offset) return never;
    return both.worse() / chi2_of_6;
}

/// The sets of regions next to each other that are pieces of one curved surface. O(n), and O(1) for
/// each pair of them.
/// @param graph    the neighbors whose labels compete for each point
/// @param labels   numbers of the regions
template <neighborhood_graph G, execution X>
[[nodiscard]] union_find curved_surfaces(const planar_cloud& cloud, const G& graph,
                                         const auto& labels, const scratch<planar_region>& regions,
                                         const X& run) {
    const auto pairs = touching_regions(graph, labels, borders_of(graph, labels, run), run);
    const label_groups members(labels);
    scratch<surface_patch> patches;
    for (std::size_t r = 0; r < regions.size(); ++r)
        patches.push_back(patch_of(cloud, regions[r], members[r]));
    union_find sets(regions.size());
    run(pairs.size(), [&](std::size_t p) {
        const auto& [a, b] = pairs[p];
        if (are_of_curved_surface(regions[a], patches[a], regions[b], patches[b])) sets.unite(a, b);
    });
    return sets;
}

}  // namespace gnomon::detail

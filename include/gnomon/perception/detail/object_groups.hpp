// SPDX-License-Identifier: BSL-1.0
/// @file
/// The groups of cells of a scan that may be objects, and the view of each. Options are here those
/// of `perceive_views`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/perception/detail/neighbors_by_density.hpp>
#include <gnomon/perception/detail/perception_run.hpp>
#include <gnomon/perception/detail/separated_walls.hpp>
#include <gnomon/perception/perception.hpp>
#include <gnomon/perception/perception_result.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/recognition/wall.hpp>
#include <gnomon/segmentation/euclidean_clusters.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition::detail {

/// Surfaces of a group of cells, without their planes.
template <class R, execution X>
[[nodiscard]] perception_result<plane_fit> surfaces_in(const R& cells, const auto& options,
                                                       const X& run) {
    const spatial_index index(cells, run);
    const std::size_t k = neighbors_by_density(index, options.k, options.reach);
    perception<knn, plane_pca, conservative, smooth_surfaces> chain{.neighborhood = {.k = k},
                                                                    .noise = options.noise};
    chain.segmentation.surfaces.min_points = k / 2;
    perception_result<plane_fit> seen;
    constexpr bool needs_planes = false;
    gnomon::detail::perception_run(chain, index, seen, run, std::identity())(needs_planes);
    return seen;
}

/// The groups of some cells, and the walls that were not grouped.
struct separated_groups {
    segments groups;
    std::vector<wall> walls;
};

/// The groups of cells that may be objects: all in one, or those of at most a gap from each other
/// that are not in walls; and these walls. Takes over the noise that was measured on all.
template <execution X>
[[nodiscard]] separated_groups object_groups(const voxel_grid::means& cells, auto& options,
                                             const Eigen::Vector3d& up, const X& run) {
    if (!(options.gap < infinite_gap))
        return {segments(std::vector<std::int32_t>(cells.size(), 0)), {}};
    const auto seen = surfaces_in(cells, options, run);
    if (!options.noise && !seen.noise.is_across_surface) options.noise = seen.noise.curve;
    const noise_curve noise = options.noise ? *options.noise : seen.noise.curve;
    auto separated =
        separate_walls(cells, seen.surface, seen.surfaces, options.max_length, noise, up);
    const auto& left = separated.others;
    const auto nearby =
        euclidean_clusters(subset_view(cells, left), {.radius = options.gap, .min_points = 1}, run);
    std::vector<std::int32_t> labels(cells.size(), unlabeled);
    for (std::size_t i = 0; i < left.size(); ++i) labels[left[i]] = nearby.labels()[i];
    return {segments(std::move(labels)), std::move(separated.walls)};
}

/// What is seen of a group of cells.
struct seen_group {
    segments surfaces;
    std::optional<view> as_view;  ///< none if the group has too few parts
};

/// What is seen of the groups of at least `least` cells. Each is one task, since most are too small
/// to be shared by threads, but a single one is shared.
/// @param groups  the largest one first
[[nodiscard]] std::vector<seen_group> seen_groups(const voxel_grid::means& cells,
                                                  const segments& groups, std::size_t least,
                                                  const auto& options,
                                                  const std::optional<plane>& ground,
                                                  const auto& run) {
    std::size_t large = 0;
    while (large < groups.size() && groups[large].size() >= least) ++large;
    std::vector<seen_group> seen(large);
    const auto see = [&](std::size_t g, const auto& inner) {
        const subset_view group(cells, groups[g]);
        auto found = surfaces_in(group, options, inner);
        auto views = views_of(group, found.surface, found.surfaces,
                              {.gap = infinite_gap,
                               .min_parts = std::max<std::size_t>(1, options.min_parts),
                               .ground = ground},
                              inner);
        seen[g].surfaces = std::move(found.surfaces);
        if (!views.empty()) seen[g].as_view = std::move(views.front());
    };
    if (large == 1)
        see(0, run);
    else
        run(large, [&](std::size_t g) { see(g, sequential{}); });
    return seen;
}

}  // namespace gnomon::recognition::detail

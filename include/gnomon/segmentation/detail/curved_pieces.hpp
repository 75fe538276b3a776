// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planar pieces of a curved surface: a road that falls to its sides is several planes. Two
/// regions next to each other belong to one surface if a paraboloid explains both better than their
/// planes do; at a crease or a step the planes are better. Apart from each other they may do so if
/// it explains them as well, and one of them is curved by itself.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/common_paraboloid.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_patch.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// A grid of parts over the extent of some places. (Templates, so that only their users compile
/// them.)
class part_grid {
  public:
    part_grid(const Eigen::Vector3d& along, const Eigen::Vector3d& across) : axes_{along, across} {}

    void enclose(const auto& place) {
        for (std::size_t a = 0; a < 2; ++a) {
            low_[a] = std::min(low_[a], dot(axes_[a], place));
            high_[a] = std::max(high_[a], dot(axes_[a], place));
        }
    }
    [[nodiscard]] std::size_t part_of(const auto& place) const {
        return number(0, place) * parts_along + number(1, place);
    }

  private:
    [[nodiscard]] std::size_t number(std::size_t a, const auto& place) const {
        const double extent = high_[a] - low_[a];
        if (!(extent > 0.0)) return 0;
        constexpr auto parts = static_cast<double>(parts_along);
        return static_cast<std::size_t>(
            std::clamp(parts * (dot(axes_[a], place) - low_[a]) / extent, 0.0, parts - 1.0));
    }

    static constexpr double none = std::numeric_limits<double>::infinity();
    std::array<Eigen::Vector3d, 2> axes_;
    std::array<double, 2> low_{none, none}, high_{-none, -none};
};

/// The parts of a planar region. O(n)
/// @param cloud    a planar_cloud
/// @param members  of the region, all finite
template <class Cloud>
[[nodiscard]] surface_patch patch_of(const Cloud& cloud, const planar_region& region,
                                     std::span<const point_index> members) {
    const eigen_decomposition principal = symmetric_eigen(region.sums.positions.covariance());
    part_grid grid(column(principal.vectors, 0), column(principal.vectors, 1));
    for (const point_index i : members) grid.enclose(cloud.offsets[i]);
    std::array<plane_sums, parts_along * parts_along> sums{};
    for (const point_index i : members) cloud.add(i, sums[grid.part_of(cloud.offsets[i])]);
    surface_patch patch{{}, region.sums, region.fit.excess(), 1};
    for (const plane_sums& part : sums)
        if (part.count > 0) patch.parts.push_back(part_with(part, region));
    return patch;
}

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

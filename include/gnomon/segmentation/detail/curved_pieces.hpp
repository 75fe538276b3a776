// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planar pieces of a curved surface: a road that falls to its sides is several planes next to each
/// other. Two regions belong to one surface if a paraboloid explains both better than their planes
/// do. At a crease or a step the planes are better.
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
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/parabola_test.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// A grid of side x side parts over the extent of some places.
template <std::size_t side>
class part_grid {
  public:
    part_grid(const Eigen::Vector3d& along, const Eigen::Vector3d& across) : axes_{along, across} {}

    void enclose(const Eigen::Vector3d& place) {
        for (std::size_t a = 0; a < 2; ++a) {
            low_[a] = std::min(low_[a], dot(axes_[a], place));
            high_[a] = std::max(high_[a], dot(axes_[a], place));
        }
    }
    [[nodiscard]] std::size_t part_of(const Eigen::Vector3d& place) const {
        return number(0, place) * side + number(1, place);
    }

  private:
    [[nodiscard]] std::size_t number(std::size_t a, const Eigen::Vector3d& place) const {
        const double extent = high_[a] - low_[a];
        if (!(extent > 0.0)) return 0;
        constexpr auto parts = static_cast<double>(side);
        return static_cast<std::size_t>(
            std::clamp(parts * (dot(axes_[a], place) - low_[a]) / extent, 0.0, parts - 1.0));
    }

    static constexpr double none = std::numeric_limits<double>::infinity();
    std::array<Eigen::Vector3d, 2> axes_;
    std::array<double, 2> low_{none, none}, high_{-none, -none};
};

/// Whether two regions next to each other are pieces of one curved surface: their planes are
/// certainly turned, and not at an edge. O(n)
/// @param cloud  a planar_cloud
/// @param a, b   planar_regions
/// @param of_a   members, all finite; likewise of_b
template <class Cloud>
[[nodiscard]] bool are_of_curved_surface(const Cloud& cloud, const auto& a,
                                         std::span<const point_index> of_a, const auto& b,
                                         std::span<const point_index> of_b) {
    constexpr angle least = degrees(0.5);  // numerical: parallel planes meet in no line
    if (!are_turned(a, b, least) || are_turned(a, b, widest_crease)) return false;
    const Eigen::Vector3d &n = a.fit.plane.normal, &m = b.fit.plane.normal;
    plane_sums all = a.sums;
    all.add(b.sums);
    const Eigen::Vector3d along = direction_of(cross(n, m));
    const Eigen::Vector3d across = cross(all.fit().plane.normal, along);
    constexpr std::size_t side = 8;  // numerical: parts of a region along it, and across
    part_grid<side> grid(along, across);
    for (const auto& members : {of_a, of_b})
        for (const point_index i : members) grid.enclose(cloud.offsets[i]);
    parabola_test<2 * side * side, curved_terms::paraboloid> test(all, along);
    for (const auto& [region, members] : {std::pair(&a, of_a), std::pair(&b, of_b)}) {
        std::array<plane_sums, side * side> parts{};
        for (const point_index i : members) cloud.add(i, parts[grid.part_of(cloud.offsets[i])]);
        for (const plane_sums& part : parts) test.add(part, region->fit.plane);
    }
    return test.is_curved();
}

/// The sets of regions next to each other that are pieces of one curved surface. O(n) for each pair
/// of them.
/// @param graph    the neighbors whose labels compete for each point
/// @param labels   numbers of the regions
template <neighborhood_graph G, execution X>
[[nodiscard]] union_find curved_surfaces(const planar_cloud& cloud, const G& graph,
                                         const auto& labels, const scratch<planar_region>& regions,
                                         const X& run) {
    scratch<char> is_border = borders_of(graph, labels, run);
    const auto pairs = compete(cloud, graph, regions, labels, is_border, run).touching;
    const label_groups parts(labels);
    union_find sets(regions.size());
    run(pairs.size(), [&](std::size_t p) {
        const auto& [a, b] = pairs[p];
        if (are_of_curved_surface(cloud, regions[a], parts[a], regions[b], parts[b]))
            sets.unite(a, b);
    });
    return sets;
}

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The steps of `planes_on_cells`. All of them run on cells, at most one deviation wide, which
/// determine a surface as well as the points do, and are fewer. The last step gives the points
/// their segments.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/scratch_graph.hpp>
#include <gnomon/neighborhoods/detail/swept_graph.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/noise_knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/ray_cone.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/perception/perception_result.hpp>
#include <gnomon/segmentation/detail/cells.hpp>
#include <gnomon/segmentation/detail/curved_pieces.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_regions.hpp>
#include <gnomon/segmentation/detail/region_edges.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segment_planes.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The labels of points: each goes to the region, among those of its cell and of the cells around
/// it, that explains it best, or to none.
/// @param noise     of the points: perception_result::known_noise
/// @param cloud     of the cells
/// @param graph     the neighbors of each cell
/// @param of_cells  the labels of the cells: numbers of `regions`
/// @param edges     between these
template <execution X>
[[nodiscard]] scratch<std::int32_t> labels_of_points(const spatial_index& points, const auto& noise,
                                                     const cells& cells, const planar_cloud& cloud,
                                                     const auto& graph, const auto& of_cells,
                                                     const scratch<planar_region>& regions,
                                                     const auto& edges, const X& run) {
    scratch<std::int32_t> labels(points.size(), unlabeled);
    for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
        label_competition competition;
        for (std::size_t i = begin; i < end; ++i) {
            const point_index c = cells.of_point[i];
            if (c == cells::no_cell) continue;
            competition.begin(graph[c], of_cells, of_cells[c]);
            const bool is_seen = !noise.is_across_surface;
            const point_noise of_plane = noise_of_point(points, noise.of_planes, i, is_seen);
            const point_noise exact = noise_of_point(points, noise.curve, i, is_seen);
            const Eigen::Vector3d offset = difference(points[i], cloud.origin);
            const auto misfit = [&](std::int32_t label) {
                const planar_region& to = regions[static_cast<std::size_t>(label)];
                return is_certainly_off(offset, exact, to) ? -1.0 : misfit_of(offset, of_plane, to);
            };
            labels[i] = competition.winner(misfit, [&](std::int32_t own, std::int32_t other) {
                const Eigen::Vector3d ray = difference(points[i], points.viewpoints[i]);
                return edges.is_across(own, other, offset, ray);
            });
        }
    });
    return labels;
}

/// The cells of the points of an index, and what is found in them step by step.
template <class Estimate>
class cell_surfaces {
  public:
    using surface_type = std::vector<surfel<Estimate>>;
    using noise_type = typename perception_result<Estimate>::known_noise;

    /// @param points   of which the cells are
    /// @param index    memory for the index of the cells
    /// @param surface  memory for their surface elements
    template <execution X>
    cell_surfaces(const spatial_index& points, const noise_type& noise, spatial_index& index,
                  surface_type& surface, const X& run)
        : points_(points),
          noise_(noise),
          index_(index),
          surface_(surface),
          cells_(points, [&](std::size_t i) {
              constexpr double least = 1e-6;  // [m]; numerical: at no noise, a cell is a point
              const Eigen::Vector3d ray = difference(points[i], points.viewpoints[i]);
              return std::max(noise.of_planes.along(ray), least);
          }) {
        index.rebuild(cells_.means, run);
        index.viewpoints = cells_.viewpoints;
        if (index.viewpoints.empty() && !noise.is_across_surface)  // along rays from the origin
            index.viewpoints = Eigen::Vector3d(0.0, 0.0, 0.0);
    }

    /// The normals of the cells, and the graph of their nearest neighbors.
    template <class N, class E, execution X>
    void estimate(const N& neighborhood, const E& estimator, const X& run) {
        scratch_graph::arrays graph;
        if constexpr (std::same_as<N, noise_knn>) {
            noise_knn along_rays = neighborhood;
            if (noise_.is_across_surface) along_rays.sees_across_lines = false;
            sweep_any_sizes(index_.size(), run, graph, [&](auto&& make_recorder) {
                estimate_swept(surface_, index_, index_.viewpoints, index_.epsilon(), estimator,
                               run, [&](auto&& make_visitor) {
                                   along_rays.sweep(index_, run, make_visitor,
                                                    make_recorder);  // for both
                               });
            });
        } else {
            estimate_normals_into(surface_, index_, neighborhood, estimator, run);
            const knn nearest{.k = noise_knn{}.k};
            const auto k = nearest.neighbors_of_each(index_.tree().size());
            sweep_equal_sizes(*k, index_, run, graph, [&](auto&& make_recorder) {
                nearest.sweep(index_, run, make_recorder);
            });
        }
        graph_.emplace(std::move(graph));
        std::size_t k = noise_knn{}.k;
        if constexpr (std::same_as<N, noise_knn>) k = neighborhood.k;
        near_.emplace(*graph_, k);
        orient_normals(index_, surface_, run);
    }

    /// The planes.
    template <execution X>
    void find(const segment_planes_options& planes, const X& run) {
        cloud_.emplace(index_, noise_.of_planes, run, !noise_.is_across_surface);
        cloud_->counts = cells_.counts;
        const bool is_independent = !noise_.is_across_surface && !is_of_camera(index_);
        regions_.emplace(regions_of_planes(*cloud_, *graph_, *near_, surface_, planes.min_points,
                                           planes.max_angle, is_independent, run));
    }

    /// For each point the number of its region, or `unlabeled`; those of pieces of one curved
    /// surface are the same.
    template <execution X>
    [[nodiscard]] scratch<std::int32_t> labels_of_points(const X& run) {
        const auto& regions = regions_->regions();
        auto of_points = detail::labels_of_points(points_, noise_, cells_, *cloud_, *near_,
                                                  labels(), regions, regions_->edges(run), run);
        curved_ = curved_surfaces(*cloud_, *near_, labels(), regions, run);
        unite_labels(of_points, curved_);
        return of_points;
    }
    /// Gives away the sets of regions that are pieces of one curved surface, those of the last
    /// labels_of_points().
    [[nodiscard]] union_find take_curved() { return std::move(curved_); }

    [[nodiscard]] const spatial_index& index() const { return index_; }
    [[nodiscard]] const planar_cloud& cloud() const { return *cloud_; }
    /// The labels of the cells.
    [[nodiscard]] const scratch<std::int32_t>& labels() const { return regions_->labels(); }
    /// A point of a cell.
    [[nodiscard]] point_index point_of(point_index cell) const { return cells_.first[cell]; }
    /// The surface element of a point: that of its cell.
    [[nodiscard]] surfel<Estimate> element_of(std::size_t point) const {
        const point_index c = cells_.of_point[point];
        if (c != cells::no_cell) return surface_[c];
        surfel<Estimate> none;
        none.trust = trust::not_finite;
        return none;
    }

  private:
    const spatial_index& points_;
    const noise_type& noise_;
    spatial_index& index_;
    surface_type& surface_;
    cells cells_;
    union_find curved_;                   // of regions
    std::optional<scratch_graph> graph_;  // the nearest neighbors first, then others
    std::optional<first_neighbors<scratch_graph>> near_;  // the nearest of these
    std::optional<planar_cloud> cloud_;
    std::optional<plane_regions<scratch_graph, first_neighbors<scratch_graph>>> regions_;
};

}  // namespace gnomon::detail

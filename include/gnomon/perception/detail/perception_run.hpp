// SPDX-License-Identifier: BSL-1.0
/// @file
/// The steps of `perception`, in their order.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include <gnomon/core/detail/pooled_run.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/stopwatch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/supervised.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>
#include <gnomon/occlusion/detail/curved_merger.hpp>
#include <gnomon/occlusion/detail/examined_gap.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/cell_surfaces.hpp>
#include <gnomon/perception/detail/known_noise.hpp>
#include <gnomon/perception/perception_result.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/plane_estimate.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// One call of the chain. All its steps take scratch memory from the pools of the result, and write
/// their results over those of the last call.
template <class Chain, class R, class Estimate, execution X, class Proj>
class perception_run {
  public:
    perception_run(const Chain& chain, const R& points, perception_result<Estimate>& result,
                   const X& run, const Proj& projection)
        : chain_(chain),
          points_(points),
          result_(result),
          progress_(run),
          run_(run, result.memory.pool_of_work()),
          projection_(projection) {}

    /// @param needs_planes  whether the last step is taken, the planes of the surfaces
    void operator()(bool needs_planes = true) {
        const pool_scope scope(&result_.memory.pool());
        chain_.require_valid();
        result_.steps.clear();
        result_.gaps.clear();
        step("floor", [&] { keep(); });
        step("index", [&] { index_kept(); });
        step("noise", [&] { determine_noise(result_, *given_, chain_, run_); });
        if constexpr (Chain::is_on_cells)
            find_on_cells();
        else
            find_on_points();
        if (needs_planes) step("planes of surfaces", [&] { estimate_planes_of_all(); });
    }

  private:
    static constexpr bool merges = merge_policy<decltype(Chain::merge)>;
    static constexpr std::size_t steps =  // formula
        (Chain::is_on_cells ? 8 : 6) + (merges ? 1 : 0);

    void step(const char* name, auto&& work) {  // announced and timed
        begin_step(progress_, name, result_.steps.size() + 1, steps);
        const stopwatch watch;
        work();
        result_.steps.push_back({name, watch.seconds()});
    }
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(std::ranges::size(points_));
    }
    [[nodiscard]] bool keeps_all() const { return result_.kept.size() == size(); }

    /// Finds floor and ceiling, and lists the points that are neither.
    void keep() {
        result_.floor.reset();
        result_.ceiling.reset();
        if (chain_.leave_out) {
            const auto& out = *chain_.leave_out;
            result_.floor = find_floor(points_, out.up, out.floor, projection_);
            if (result_.floor) {
                result_.ceiling = find_ceiling(points_, *result_.floor, out.ceiling, projection_);
                crop_height_into(result_.kept, position_view<R, Proj>(points_, projection_),
                                 *result_.floor, result_.ceiling, out.bands);
                return;
            }
        }
        result_.kept.resize(size());
        std::iota(result_.kept.begin(), result_.kept.end(), point_index{0});
    }

    /// Also refuses view points that no step could use.
    void index_kept() {
        given_ = &index_of_kept();
        for (std::size_t i = 0; i < given_->size(); ++i)
            require(!given_->is_finite(i) || is_finite(given_->viewpoints[i]),
                    "perception: a view point is not finite");
    }

    const spatial_index& index_of_kept() {
        if (!keeps_all()) {
            result_.index.rebuild(subset_view<R, Proj>(points_, result_.kept, projection_), run_);
        } else if constexpr (std::same_as<R, spatial_index> && std::same_as<Proj, std::identity>) {
            result_.index.clear();
            return checked(points_);
        } else {
            result_.index.rebuild(points_, run_, projection_);
        }
        return result_.index;
    }

    /// `planes_on_cells`
    void find_on_cells() {
        const noise_curve& noise = result_.noise.of_planes;
        std::optional<cell_surfaces<Estimate>> found;
        step("cells", [&] {
            found.emplace(*given_, result_.noise, result_.memory.cells, result_.memory.surface,
                          run_);
        });
        step("normals", [&] {
            found->estimate(with_noise(chain_.neighborhood, noise.plus(flatness)),
                            with_noise(chain_.estimate, noise), run_);
            result_.surface.assign(size(), {});
            for (std::size_t i = 0; i < result_.kept.size(); ++i)
                result_.surface[result_.kept[i]] = found->element_of(i);
        });
        step("planes", [&] { found->find(chain_.segmentation.planes, run_); });
        scratch<std::int32_t> labels;
        step("assignment", [&] {
            labels = found->labels_of_points(run_);
            set_segments(result_.initial_segments, labels);
            result_.surfaces = result_.initial_segments;
        });
        if constexpr (merges)
            step("merging", [&] {
                result_.memory.parts.assign(found->labels());
                merge(found->index(), found->cloud(), labels, found->take_curved(),
                      [&](point_index c) { return found->point_of(c); });
            });
    }

    /// `smooth_surfaces`
    void find_on_points() {
        auto& surface = keeps_all() ? result_.surface : result_.memory.surface;
        const auto neighborhood = with_noise(chain_.neighborhood, result_.noise.curve);
        const auto estimate = with_noise(chain_.estimate, result_.noise.curve);
        step("normals", [&] {
            estimate_normals_into(surface, *given_, neighborhood, estimate, run_);
            const auto& repair = chain_.segmentation.repair;
            if constexpr (requires {
                              repair_anisotropic(*given_, neighborhood, surface, estimate, repair,
                                                 run_);
                          })
                repair_anisotropic(*given_, neighborhood, surface, estimate, repair, run_);
            orient_normals(*given_, surface, run_);
            if (keeps_all()) return;
            result_.surface.assign(size(), {});
            for (std::size_t i = 0; i < surface.size(); ++i)
                result_.surface[result_.kept[i]] = surface[i];
        });
        scratch<std::int32_t> labels;
        step("segmentation", [&] {
            segments& parts = result_.memory.parts;
            segment_surfaces_into(parts, *given_, surface, chain_.segmentation.surfaces, run_);
            labels.assign(parts.labels().begin(), parts.labels().end());
            set_segments(result_.initial_segments, labels);
            result_.surfaces = result_.initial_segments;
        });
        if constexpr (merges)
            step("merging", [&] {
                const planar_cloud cloud(*given_, result_.noise.of_planes, run_, true);
                merge(*given_, cloud, labels, union_find(), std::identity());
            });
    }

    /// Merges the segments in memory, where the noise along the rays is known.
    /// @param things, cloud  cells or kept points
    /// @param labels    the segments of the kept points
    /// @param curved    the sets of segments that are pieces of one curved surface
    /// @param point_of  point_of(thing): the number of a kept point of it
    void merge(const spatial_index& things, const planar_cloud& cloud,
               scratch<std::int32_t>& labels, union_find curved, auto&& point_of) {
        if (result_.noise.is_across_surface) return;
        const noise_curve& noise = result_.noise.of_planes;
        const visibility visible(points_, with_noise(chain_.visibility, noise), run_, projection_);
        const auto each_gap = [&](const examined_gap& gap) { note(gap, point_of); };
        union_find sets =
            merged_surfaces(things, cloud, result_.memory.parts, std::move(curved), visible,
                            chain_.merge, with_noise(chain_.merging, noise), run_, each_gap);
        unite_labels(labels, sets);
        set_segments(result_.surfaces, labels);
    }

    /// Makes segments of all points from labels of the kept ones.
    void set_segments(segments& all, const scratch<std::int32_t>& of_kept) const {
        scratch<std::int32_t> labels(size(), unlabeled);
        for (std::size_t i = 0; i < result_.kept.size(); ++i) labels[result_.kept[i]] = of_kept[i];
        number_by_size(labels);
        all.assign(labels);
    }

    /// Writes a gap to the result; its distances stay those between the things, the means of cells.
    void note(const examined_gap& gap, auto&& point_of) const {
        result_.gaps.push_back({{gap.lines.begin(), gap.lines.end()}, gap.seen, gap.merged});
        for (auto& line : result_.gaps.back().lines) {
            line.first = result_.kept[point_of(line.first)];
            line.second = result_.kept[point_of(line.second)];
        }
    }

    void estimate_planes_of_all() {
        const bool is_seen = !result_.noise.is_across_surface;
        const planar_cloud cloud(*given_, result_.noise.of_planes, run_, is_seen);
        const planar_cloud exact(*given_, result_.noise.curve, run_, is_seen);
        scratch<std::int32_t> labels;
        for (const point_index i : result_.kept) labels.push_back(result_.surfaces.labels()[i]);
        const label_groups parts(labels);
        result_.planes.assign(result_.surfaces.size(), {});
        run_(parts.size(),
             [&](std::size_t s) { result_.planes[s] = estimate_of(cloud, parts[s], exact); });
    }

    const Chain& chain_;
    const R& points_;
    perception_result<Estimate>& result_;
    const X& progress_;
    pooled_run<X> run_;
    const Proj& projection_;
    const spatial_index* given_ = nullptr;  // of the kept points
};

}  // namespace gnomon::detail

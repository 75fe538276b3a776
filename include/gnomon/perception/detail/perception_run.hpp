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
#include <vector>

#include <gnomon/core/detail/pooled_run.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/stopwatch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/supervised.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/occlusion/detail/fragment.hpp>
#include <gnomon/occlusion/detail/occlusion_merger.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/perception_result.hpp>
#include <gnomon/segmentation/assign_unlabeled.hpp>
#include <gnomon/segmentation/join_surfaces_of_revolution.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <gnomon/segmentation/split_outliers.hpp>

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

    void operator()() {
        const pool_scope scope(&result_.memory.pool());
        result_.seconds = {};
        step("preprocessing", result_.seconds.preprocessing, [&] { keep(); });
        step("index", result_.seconds.index, [&] { index_kept(); });
        step("normals", result_.seconds.normals, [&] { estimate(); });
        step("segmentation", result_.seconds.segmentation, [&] { segment(); });
        merging merged;
        merge(merged);
        step("assignment", result_.seconds.assignment, [&] { split(); });
        if (chain_.splitting) merge(merged);  // planes are more accurate without outliers
        result_.gaps.resize(merged.gaps);
        step("assignment", result_.seconds.assignment, [&] { assign_and_join(); });
    }

  private:
    /// What the second merging reuses of the first one.
    struct merging {
        std::optional<visibility> seen = {};
        scratch<fragment> fragments = {};
        std::size_t gaps = 0;  ///< in the result
    };

    /// The number of steps: not all chains merge, or split and merge again.
    [[nodiscard]] std::size_t steps() const {
        if constexpr (merge_policy<decltype(chain_.merge)>)
            return chain_.splitting ? 8 : 7;
        else
            return 6;
    }

    /// Announces a step, and adds its time to `seconds`.
    void step(const char* name, double& seconds, auto&& work) {
        begin_step(progress_, name, ++step_, steps());
        const stopwatch watch;
        work();
        seconds += watch.seconds();
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
            if (const auto guess = guess_floor(points_, out.up, projection_))
                result_.floor = find_floor(points_, *guess, out.floor, projection_);
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

    void index_kept() {
        if (!keeps_all()) {
            result_.index.rebuild(subset_view<R, Proj>(points_, result_.kept, projection_), run_);
        } else if constexpr (std::same_as<R, spatial_index> && std::same_as<Proj, std::identity>) {
            given_ = &checked(points_);
            result_.index.clear();
            return;
        } else {
            result_.index.rebuild(points_, run_, projection_);
        }
        given_ = &result_.index;
    }

    void estimate() {
        const auto& index = *given_;
        auto& surface = surface_of_kept();
        estimate_normals_into(surface, index, chain_.neighborhood, chain_.estimate, run_);
        if constexpr (requires {
                          repair_anisotropic(index, chain_.neighborhood, surface, chain_.estimate,
                                             chain_.repair, run_);
                      })
            repair_anisotropic(index, chain_.neighborhood, surface, chain_.estimate, chain_.repair,
                               run_);
        orient_normals(index, surface, run_);
        if (keeps_all()) return;
        result_.surface.assign(size(), {});
        for (std::size_t i = 0; i < surface.size(); ++i)
            result_.surface[result_.kept[i]] = surface[i];
    }

    /// The surface elements of the kept points.
    [[nodiscard]] std::vector<surfel<Estimate>>& surface_of_kept() const {
        return keeps_all() ? result_.surface : result_.memory.surface;
    }

    void segment() {
        segments& parts = keeps_all() ? result_.initial_segments : result_.memory.parts;
        segment_surfaces_into(parts, *given_, surface_of_kept(), chain_.segmentation, run_);
        if (!keeps_all()) assign_to_all(result_.initial_segments, parts);
        result_.surfaces = result_.initial_segments;
    }

    /// Makes segments of all points from those of the kept ones.
    void assign_to_all(segments& all, const segments& of_kept) const {
        scratch<std::int32_t> labels(size(), unlabeled);
        for (std::size_t i = 0; i < result_.kept.size(); ++i)
            labels[result_.kept[i]] = of_kept.labels()[i];
        all.assign(labels);
    }

    /// Calls change(segments) with result_.surfaces, or with those of the kept points, which then
    /// become those of all.
    void change_segments_of_kept(auto&& change) const {
        if (keeps_all()) return change(result_.surfaces);
        segments& parts = result_.memory.parts;
        scratch<std::int32_t> labels;
        labels.reserve(result_.kept.size());
        for (const point_index i : result_.kept) labels.push_back(result_.surfaces.labels()[i]);
        parts.assign(labels);
        change(parts);
        assign_to_all(result_.surfaces, parts);
    }

    /// Merges occluded segments. Points that were removed occlude as well as others.
    void merge(merging& state) {
        if constexpr (merge_policy<decltype(chain_.merge)>) {
            step("merging", result_.seconds.merging, [&] {
                const bool is_first = !state.seen;
                if (is_first) state.seen.emplace(points_, chain_.visibility, run_, projection_);
                merge_occluded_into(result_.surfaces, points_, result_.surface, result_.surfaces,
                                    *state.seen, chain_.merge, chain_.merging, run_, projection_,
                                    state.fragments, [&](const examined_gap& gap) {
                                        if (is_first || gap.merged) write(gap, state.gaps++);
                                    });
            });
        }
    }

    /// Writes gap number g of the result, over that of the last call.
    void write(const examined_gap& gap, std::size_t g) const {
        if (g == result_.gaps.size()) result_.gaps.emplace_back();
        considered_gap& to = result_.gaps[g];
        to.lines.assign(gap.lines.begin(), gap.lines.end());
        to.seen = gap.seen;
        to.merged = gap.merged;
    }

    void split() {
        if (!chain_.splitting) return;
        change_segments_of_kept([&](segments& parts) {
            split_outliers_into(parts, *given_, surface_of_kept(), parts, *chain_.splitting, run_);
        });
    }

    void assign_and_join() {
        if (!chain_.assignment && !chain_.revolution) return;
        change_segments_of_kept([&](segments& parts) {
            if (chain_.assignment)
                assign_unlabeled_into(parts, *given_, parts, *chain_.assignment, run_);
            if (chain_.revolution)
                join_surfaces_of_revolution_into(parts, *given_, surface_of_kept(), parts,
                                                 *chain_.revolution, run_);
        });
    }

    const Chain& chain_;
    const R& points_;
    perception_result<Estimate>& result_;
    const X& progress_;
    pooled_run<X> run_;
    const Proj& projection_;
    const spatial_index* given_ = nullptr;  // of the kept points
    std::size_t step_ = 0;
};

}  // namespace gnomon::detail

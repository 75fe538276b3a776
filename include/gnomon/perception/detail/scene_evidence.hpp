// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a scan shows of objects at places: their alignment, verification, silhouette and
/// probability.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/alignment_effort.hpp>
#include <gnomon/perception/detail/cells_of_object.hpp>
#include <gnomon/perception/detail/object_probability.hpp>
#include <gnomon/perception/detail/pose_search.hpp>
#include <gnomon/perception/detail/silhouette_fit.hpp>
#include <gnomon/perception/detail/whole_beams.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/detail/part_place.hpp>
#include <gnomon/recognition/detail/points_in_bounds.hpp>
#include <gnomon/recognition/detail/pose_verifier.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/verification.hpp>
#include <gnomon/recognition/wall.hpp>

namespace gnomon::recognition::detail {

/// The cells of a scan that may be of objects, what the sensor saw elsewhere, and for which places
/// the parts of the scan vote.
class scene_evidence {
  public:
    /// The probability below which a hypothesis is neither improved nor recognized, and not found.
    static constexpr double worth = 0.01;  // chosen on touching rooms of seeds 501 to 530
    /// Cells of a group, or near a place, with fewer of which there is no object.
    static constexpr std::size_t fewest = 20;  // chosen: of a stool at 5 m half face the sensor

    /// Keeps references to cells and mixed, and what the points refer to.
    /// @param points      of which `seen` has images
    /// @param divergence  full angle of the beams
    scene_evidence(const voxel_grid::means& cells, visibility seen, imaged_points points,
                   cast_votes votes, const noise_curve& noise, const plane& ground,
                   std::vector<wall> walls, angle divergence, const auto& run,
                   const mixed_cells* mixed = nullptr)
        : cells_(cells),
          index_(cells, run),
          surface_(estimate_normals(index_, knn{.k = neighbors}, plane_pca{}, run)),
          seen_(std::move(seen)),
          points_(std::move(points)),
          votes_(std::move(votes)),
          noise_(noise),
          ground_(ground),
          walls_(std::move(walls)),
          divergence_(divergence),
          mixed_(mixed) {}

    /// The places of objects for which parts vote.
    [[nodiscard]] auto voted_places(const auto& run) const { return votes_.places(run); }

    /// Places at which the surfaces of objects may be.
    /// @param is_left  (i): whether cell i is searched
    [[nodiscard]] std::vector<object_place> searched_places(std::span<const surface_model> surfaces,
                                                            const auto& is_left,
                                                            const auto& run) const {
        const rigid_motion frame = ground_motion(ground_, cells_.points.front());
        std::vector<ground_cell> cells;
        cells.reserve(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            if (!is_left(static_cast<point_index>(i))) continue;
            cells.push_back({frame.point_in(cells_.points[i]),
                             is_missing(surface_[i].normal)
                                 ? ground_cell::of_both_kinds
                                 : std::abs(frame.direction_in(surface_[i].normal).z())});
        }
        return search_poses(cells, frame, seen_, walls_, surfaces, run);
    }

    /// An object, aligned from a pose, and not verified. With too few cells it stays there.
    [[nodiscard]] found_object only_aligned(std::size_t object, const rigid_motion& start,
                                            const surface_model& model,
                                            const alignment_effort& much) const {
        const auto around = Eigen::Vector3d::Constant(0.10);  // [m]; chosen: `reach` of votes
        found_object h = unaligned({object, start, 0.0}, model, ground_.normal);
        std::vector<point_index> inside;
        for_each_point_in(index_, start, model.low() - around, model.high() + around,
                          [&](point_index i, const Eigen::Vector3d&) { inside.push_back(i); });
        if (inside.size() < fewest) return h;
        const auto& samples = much.all_samples ? model.all() : model.coarse();
        h.aligned = alignment_of_cells(cells_, surface_, inside, much.cells, samples, start,
                                       {.noise = noise_,
                                        .on_ground = true,
                                        .max_distance = much.max_distance,
                                        .last_distance = much.last_distance,
                                        .max_iterations = much.iterations});
        return h;
    }

    /// An object, aligned from a pose and verified.
    [[nodiscard]] found_object aligned(std::size_t object, const rigid_motion& start,
                                       const surface_model& model,
                                       const alignment_effort& much) const {
        found_object h = only_aligned(object, start, model, much);
        (void)verify(h, model, much, [](const verification&, std::size_t) { return false; });
        return h;
    }

    /// The same object, which was only aligned, verified if it fits better than before.
    [[nodiscard]] std::optional<found_object> verified_better(const found_object& than,
                                                              found_object h,
                                                              const surface_model& model,
                                                              const alignment_effort& much) const {
        const bool is_better = verify(h, model, much, [&](const verification& v, std::size_t left) {
            return !fits_better(v, than.evidence, left);
        });
        return is_better ? std::optional(std::move(h)) : std::nullopt;
    }

    /// The alignment of an object that was found, by the cells that whole beams hit, and by its
    /// silhouette.
    [[nodiscard]] alignment refined(const alignment& found, const surface_model& model) const {
        const alignment whole =
            aligned_by_whole_beams(found, model,
                                   {cells_, index_, surface_, mixed_, noise_, ground_.normal,
                                    divergence_, careful_effort.cells});
        return by_silhouette(whole, model, seen_, points_, noise_, divergence_, ground_.normal);
    }

    /// How the silhouette of an object at a pose agrees with the scan.
    [[nodiscard]] silhouette_match silhouette_of(const surface_model& model,
                                                 const rigid_motion& pose) const {
        return silhouette_fit(seen_, points_, noise_, divergence_, model, pose).match(pose);
    }

    /// Corrects the probability of a hypothesis by its silhouette.
    void compare_silhouette(found_object& h, const surface_model& model) const {
        if (h.probability < worth) return;
        h.silhouette = silhouette_of(model, h.aligned.pose);
        h.probability = probability_of(h);
    }

    /// Corrects the probability of a hypothesis after the points on its surface were recognized;
    /// without parts, and for a name of which no view was learned, all names are as probable.
    void recognize(found_object& h, const surface_model& model,
                   const object_recognizer<>& recognizer, const std::string& name) const {
        if (h.probability < worth) return;
        constexpr double least = -6.0;  // chosen: a probability of 0.25 %
        const auto on = cells_on(model, h.aligned.pose);
        const auto seen = perceive_views(
            subset_view(cells_, on),
            {.ground = ground_, .noise = noise_, .gap = infinite_gap, .min_points = fewest});
        h.log_recognized = -std::log(static_cast<double>(recognizer.classes()));
        if (!seen.views.empty()) {
            const auto& names = recognizer.names();
            const auto at = std::find(names.begin(), names.end(), name);
            if (at != names.end()) {
                const double p = recognizer.decide(seen.views.front())
                                     .probability[static_cast<std::size_t>(at - names.begin())];
                h.log_recognized = p > 0.0 ? std::max(least, std::log(p)) : least;
            }
        }
        h.probability = probability_of(h);
    }

    /// Corrects the probability of a hypothesis after other objects have taken cells.
    /// @param is_left  (i): whether cell i is of no object
    void update(found_object& h, const surface_model& model, const auto& is_left) const {
        if (h.probability < worth) return;  // nor is it improved or recognized
        const verification_options how{.noise = noise_};
        pose_verifier verifier(index_, seen_, model, h.aligned.pose, how);
        verifier.count_points(is_left);
        const verification& left = verifier.counts();
        h.evidence.points = left.points;
        h.evidence.explained = left.explained;
        h.evidence.near_surface = left.near_surface;
        h.evidence.on_surface = left.on_surface;
        h.probability = probability_of(h);
    }

    /// The cells on the surface of an object.
    [[nodiscard]] std::vector<point_index> cells_on(const surface_model& model,
                                                    const rigid_motion& pose) const {
        return detail::cells_on(index_, model, pose);
    }

    /// All cells.
    [[nodiscard]] const voxel_grid::means& cells() const { return cells_; }

  private:
    /// Verifies an object until it is refused. False then, or if it was aligned with no cells.
    /// @param is_refused  (counts, left): by the counts of all but the last `left` samples
    bool verify(found_object& h, const surface_model& model, const alignment_effort& much,
                const auto& is_refused) const {
        if (h.aligned.points == 0) return false;
        const verification_options how{.noise = noise_, .walls = walls_, .most = much.samples};
        pose_verifier verifier(index_, seen_, model, h.aligned.pose, how);
        const auto normal_of = [&](point_index i) { return surface_[i].normal; };
        if (!verifier.count_samples(normal_of, is_refused)) return false;
        verifier.count_points(all_points);
        h.evidence = verifier.counts();
        h.votes = votes_.at(h.object, h.aligned.pose);
        h.probability = probability_of(h);
        return true;
    }

    static constexpr std::size_t neighbors = 15;  // chosen: half of a usual neighborhood

    const voxel_grid::means& cells_;
    spatial_index index_;
    std::vector<surfel<plane_fit>> surface_;
    visibility seen_;
    imaged_points points_;
    cast_votes votes_;
    noise_curve noise_;
    plane ground_;
    std::vector<wall> walls_;
    angle divergence_;          // full angle of the beams
    const mixed_cells* mixed_;  // null if beams are narrow
};

}  // namespace gnomon::recognition::detail

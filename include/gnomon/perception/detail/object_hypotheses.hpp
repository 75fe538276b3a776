// SPDX-License-Identifier: BSL-1.0
/// @file
/// Hypotheses, objects at places, against a scan: their alignment, verification and probability.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/align_to_surface.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/pose_search.hpp>
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
#include <gnomon/recognition/verify_pose.hpp>

namespace gnomon::recognition::detail {

/// The probability of a hypothesis by its evidence: a logistic regression.
[[nodiscard]] inline double probability_of(const found_object& o) {
    const verification& v = o.evidence;
    const std::size_t through = v.seen_through + v.supported;
    constexpr double no_votes = 0.05;  // chosen: stands for none, in the weights below too
    const std::array<double, 7> variables{
        v.support(),
        through == 0 ? 1.0 : static_cast<double>(v.seen_through) / static_cast<double>(through),
        v.explanation(),
        v.observed(),
        v.containment(),
        std::log(no_votes + o.votes),
        o.log_recognized};
    // Log odds per variable, and without any. Chosen: fitted to what remains after competition
    // in furnished_room() with clutter, seeds 1 to 60, and with touching furniture, 1 to 10 and 31
    // to 60.
    constexpr std::array<double, 7> weights{4.1, -4.1, 2.1, 2.7, 13.4, 0.75, 0.92};
    constexpr double intercept = -17.7;
    double log_odds = intercept;
    for (std::size_t i = 0; i < variables.size(); ++i) log_odds += weights[i] * variables[i];
    return 1.0 / (1.0 + std::exp(-log_odds));
}

/// The cells of a scan that may be of objects, and what the sensor saw elsewhere.
class scene_evidence {
  public:
    /// The probability below which a hypothesis is neither improved nor recognized, and not found.
    static constexpr double worth = 0.05;  // chosen: a tenth of the one that is usually found

    scene_evidence(const voxel_grid::means& cells, visibility seen, const noise_curve& noise,
                   const plane& ground, const auto& run)
        : cells_(cells),
          index_(cells, run),
          surface_(estimate_normals(index_, knn{.k = neighbors}, plane_pca{}, run)),
          seen_(std::move(seen)),
          noise_(noise),
          ground_(ground) {}

    /// Places at which objects may stand, whatever their parts vote for.
    [[nodiscard]] std::vector<object_place> places(std::span<const surface_model> surfaces,
                                                   const auto& run) const {
        const rigid_motion frame = ground_motion(ground_, cells_.points.front());
        std::vector<ground_cell> cells;
        cells.reserve(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i)
            cells.push_back({frame.point_in(cells_.points[i]),
                             is_missing(surface_[i].normal)
                                 ? ground_cell::of_both_kinds
                                 : std::abs(frame.direction_in(surface_[i].normal).z())});
        return search_poses(cells, frame, seen_, surfaces, run);
    }

    /// A hypothesis, aligned from a place.
    [[nodiscard]] found_object hypothesis(const object_place& place,
                                          const surface_model& model) const {
        found_object result;
        result.object = place.object;
        result.votes = place.votes;
        return at_best(result, place.pose, model);
    }

    /// A hypothesis, or the same object aligned from a start next to it, if that is more probable:
    /// an alignment may end where a slat of the model is on the next slat of the chair.
    [[nodiscard]] found_object improved(const found_object& first,
                                        const surface_model& model) const {
        constexpr double step = 0.08;          // [m]; chosen, and tried on rooms of seeds 1 to 14
        constexpr angle turn = degrees(12.0);  // chosen: as wide at 40 cm from the middle
        found_object best = first;
        if (first.probability < worth) return best;
        const auto none = degrees(0.0);
        for (const rigid_motion& other :
             {rigid_motion::on_ground(step, 0.0, none), rigid_motion::on_ground(-step, 0.0, none),
              rigid_motion::on_ground(0.0, step, none), rigid_motion::on_ground(0.0, -step, none),
              rigid_motion::on_ground(0.0, 0.0, turn),
              rigid_motion::on_ground(0.0, 0.0, degrees(-turn.degrees()))}) {
            const found_object next = at_best(first, first.aligned.pose * other, model);
            if (next.probability > best.probability) best = next;
        }
        return best;
    }

    /// Corrects the probability of a hypothesis after the points on its surface were recognized;
    /// without parts all names are as probable.
    void recognize(found_object& h, const surface_model& model,
                   const object_recognizer<>& recognizer, const std::string& name) const {
        if (h.probability < worth) return;
        constexpr double least = -6.0;  // chosen: 0.25 %, less than one of 200 trees
        const auto on = cells_on(model, h.aligned.pose);
        const auto seen = perceive_views(
            subset_view(cells_, on),
            {.ground = ground_, .noise = noise_, .gap = infinite_gap, .min_points = fewest});
        h.log_recognized = -std::log(static_cast<double>(recognizer.classes()));
        if (!seen.views.empty()) {
            const auto& names = recognizer.names();
            const auto at = std::find(names.begin(), names.end(), name);
            const double p = at == names.end()
                                 ? 0.0
                                 : recognizer.decide(seen.views.front())
                                       .probability[static_cast<std::size_t>(at - names.begin())];
            h.log_recognized = p > 0.0 ? std::max(least, std::log(p)) : least;
        }
        h.probability = probability_of(h);
    }

    /// Corrects the probability of a hypothesis after other objects have taken cells.
    /// @param is_left  (i): whether cell i is of no object
    void update(found_object& h, const surface_model& model, const auto& is_left) const {
        if (h.probability < worth) return;  // it was not recognized
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
        constexpr double margin = 0.03;  // [m]; chosen: spacing of samples, and noise
        const Eigen::Vector3d around = Eigen::Vector3d::Constant(margin);
        Eigen::Vector3d low = model.low() - around;
        low.z() = std::max(low.z(), lowest);
        std::vector<point_index> on;
        std::vector<neighbor> nearest;
        for_each_point_in(index_, pose, low, model.high() + around,
                          [&](point_index i, const Eigen::Vector3d& x) {
                              model.points().nearest_within_into(nearest, x, 1, margin);
                              if (!nearest.empty()) on.push_back(i);
                          });
        std::ranges::sort(on);
        return on;
    }

    /// The number of all cells.
    [[nodiscard]] std::size_t size() const { return cells_.size(); }

  private:
    /// The same hypothesis, aligned from a pose.
    [[nodiscard]] found_object at_best(found_object hypothesis, const rigid_motion& start,
                                       const surface_model& model) const {
        constexpr double margin = 0.10;    // [m]: error of votes; chosen: `reach` of these
        constexpr std::size_t most = 600;  // performance only: cells that are aligned
        hypothesis.aligned = {};
        hypothesis.evidence = {};
        hypothesis.probability = 0.0;
        const Eigen::Vector3d around = Eigen::Vector3d::Constant(margin);
        std::vector<point_index> inside;
        for_each_point_in(index_, start, model.low() - around, model.high() + around,
                          [&](point_index i, const Eigen::Vector3d&) { inside.push_back(i); });
        if (inside.size() < fewest) return hypothesis;
        const std::size_t n = std::min(inside.size(), most);
        std::vector<point_index> some(n);
        for (std::size_t k = 0; k < n; ++k) some[k] = inside[k * inside.size() / n];
        std::vector<surface_model::oriented> normals(n);
        for (std::size_t k = 0; k < n; ++k) normals[k].normal = surface_[some[k]].normal;
        hypothesis.aligned =
            align_to_surface(subset_view(cells_, some), normals, model.points(), model.normals(),
                             start.inverse(),
                             {.noise = noise_, .on_ground = true, .max_distance = 0.15})
                .inverse();
        hypothesis.evidence =
            verify_pose(index_, surface_, seen_, model, hypothesis.aligned.pose, {.noise = noise_});
        hypothesis.probability = probability_of(hypothesis);
        return hypothesis;
    }

    static constexpr std::size_t fewest = 20;     // cells, as in views
    static constexpr std::size_t neighbors = 15;  // chosen: half of a usual neighborhood
    static constexpr double lowest = 0.05;        // [m]; as in verifications

    const voxel_grid::means& cells_;
    spatial_index index_;
    std::vector<surfel<plane_fit>> surface_;
    visibility seen_;
    noise_curve noise_;
    plane ground_;
};

}  // namespace gnomon::recognition::detail

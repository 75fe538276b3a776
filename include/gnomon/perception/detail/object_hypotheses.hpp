// SPDX-License-Identifier: BSL-1.0
/// @file
/// Hypotheses, objects at places, against a scan: their alignment, verification and probability,
/// and their competition for points.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

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
#include <gnomon/perception/found_object.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_votes.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/verify_pose.hpp>

namespace gnomon::recognition::detail {

/// The cells of a scan that may be of objects, and what the sensor saw elsewhere.
class scene_evidence {
  public:
    scene_evidence(const voxel_grid::means& cells, visibility seen, const noise_curve& noise,
                   const auto& run)
        : cells_(cells),
          index_(cells, run),
          surface_(estimate_normals(index_, knn{.k = neighbors}, plane_pca{}, run)),
          seen_(std::move(seen)),
          noise_(noise) {}

    /// A hypothesis, aligned from the place that was voted for.
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
                   const object_recognizer<>& recognizer, const std::string& name,
                   const plane& ground) const {
        if (h.probability < worth) return;
        constexpr double least = -6.0;  // chosen: 0.25 %, less than one of 200 trees
        const auto on = cells_on(model, h.aligned.pose);
        const auto seen = perceive_views(
            subset_view(cells_, on),
            {.ground = ground, .noise = noise_, .gap = infinite_gap, .min_points = fewest});
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

    /// The most probable hypotheses, of which each explains points of its own.
    /// @param of_cell  gets the numbers of the winners whose surface the cells are on
    [[nodiscard]] std::vector<found_object> winners(std::vector<found_object> hypotheses,
                                                    std::span<const surface_model> surfaces,
                                                    double min_probability,
                                                    std::vector<std::int32_t>& of_cell) const {
        constexpr double own_share = 0.5;  // chosen before any room was seen: the larger part
        std::ranges::stable_sort(hypotheses, std::greater{}, &found_object::probability);
        std::vector<found_object> found;
        for (found_object& h : hypotheses) {
            if (h.probability < min_probability || h.evidence.explained == 0) break;
            const auto explained = cells_on(surfaces[h.object], h.aligned.pose);
            const auto own = static_cast<std::size_t>(std::ranges::count_if(
                explained, [&](point_index c) { return of_cell[c] == unlabeled; }));
            if (static_cast<double>(own) < own_share * static_cast<double>(explained.size()) ||
                own == 0)
                continue;
            for (const point_index c : explained)
                if (of_cell[c] == unlabeled) of_cell[c] = static_cast<std::int32_t>(found.size());
            found.push_back(std::move(h));
        }
        return found;
    }

  private:
    /// The same hypothesis, aligned from a pose.
    [[nodiscard]] found_object at_best(found_object hypothesis, const rigid_motion& start,
                                       const surface_model& model) const {
        constexpr double margin = 0.10;    // [m]: error of votes; chosen: `reach` of these
        constexpr std::size_t most = 600;  // performance only: cells that are aligned
        hypothesis.aligned = {};
        hypothesis.evidence = {};
        hypothesis.probability = 0.0;
        std::vector<point_index> inside;
        for (std::size_t i = 0; i < cells_.size(); ++i)
            if (is_within(model, start.point_in(cells_.points[i]), margin))
                inside.push_back(static_cast<point_index>(i));
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

    static constexpr double worth = 0.05;         // performance only: probability
    static constexpr std::size_t fewest = 20;     // cells, as in views
    static constexpr std::size_t neighbors = 15;  // chosen: half of a usual neighborhood
    static constexpr double lowest = 0.05;        // [m]; as in verifications

    [[nodiscard]] static bool is_within(const surface_model& model, const Eigen::Vector3d& x,
                                        double margin) {
        for (int a = 0; a < 3; ++a)
            if (!(model.low()[a] - margin <= x[a] && x[a] <= model.high()[a] + margin))
                return false;
        return true;
    }

    /// The cells on the surface of an object.
    [[nodiscard]] std::vector<point_index> cells_on(const surface_model& model,
                                                    const rigid_motion& pose) const {
        constexpr double margin = 0.03;  // [m]; chosen: spacing of samples, and noise
        std::vector<point_index> on;
        std::vector<neighbor> nearest;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const Eigen::Vector3d x = pose.point_in(cells_.points[i]);
            if (x.z() < lowest || !is_within(model, x, margin)) continue;
            model.points().nearest_within_into(nearest, x, 1, margin);
            if (!nearest.empty()) on.push_back(static_cast<point_index>(i));
        }
        return on;
    }

    /// The probability of a hypothesis by its evidence: a logistic regression.
    [[nodiscard]] static double probability_of(const found_object& o) {
        const verification& v = o.evidence;
        const std::size_t through = v.seen_through + v.supported;
        constexpr double no_votes = 0.05;  // numerical: its logarithm is finite
        const std::array<double, 7> variables{
            v.support(),
            through == 0 ? 1.0 : static_cast<double>(v.seen_through) / static_cast<double>(through),
            v.explanation(),
            v.observed(),
            std::log1p(static_cast<double>(v.explained)),
            std::log(no_votes + o.votes),
            o.log_recognized};
        // Log odds per variable, and without any. Chosen: fitted to what remains after competition
        // in furnished_room() with clutter, seeds 1 to 24, and with touching furniture, 31 to 54.
        constexpr std::array<double, 7> weights{3.8, -8.4, 6.0, 4.9, 0.8, 2.0, 1.75};
        constexpr double intercept = -14.9;
        double log_odds = intercept;
        for (std::size_t i = 0; i < variables.size(); ++i) log_odds += weights[i] * variables[i];
        return 1.0 / (1.0 + std::exp(-log_odds));
    }

    const voxel_grid::means& cells_;
    spatial_index index_;
    std::vector<surfel<plane_fit>> surface_;
    visibility seen_;
    noise_curve noise_;
};

}  // namespace gnomon::recognition::detail

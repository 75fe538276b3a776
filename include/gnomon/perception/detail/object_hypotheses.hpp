// SPDX-License-Identifier: BSL-1.0
/// @file
/// Hypotheses, objects at poses, from the places at which they may stand: many are aligned roughly,
/// and the few that are worth it carefully.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/perception/detail/alignment_effort.hpp>
#include <gnomon/perception/detail/object_probability.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/surface_model.hpp>

namespace gnomon::recognition::detail {

/// Hypotheses that differ by less are one.
inline constexpr double apart_of_one = 0.03;        // [m]; chosen: three cells
inline constexpr angle turn_of_one = degrees(5.0);  // chosen: as wide at 35 cm from the middle

/// Whether two hypotheses are one object at one pose, less than `apart` [m] and `turn` off.
/// @param model  of the first
[[nodiscard]] inline bool is_same(const found_object& a, const found_object& b,
                                  const surface_model& model, double apart = apart_of_one,
                                  angle turn = turn_of_one) {
    if (a.object != b.object) return false;
    const rigid_motion between = a.aligned.pose.inverse() * b.aligned.pose;
    const angle heading = radians(std::atan2(between.rotation(1, 0), between.rotation(0, 0)));
    return gnomon::detail::length(between.position) < apart &&
           model.symmetry().difference(heading, degrees(0.0)) < turn;
}

/// Starts for an object that may face the other way, as a chair of which only the back is seen:
/// turned by half a circle about the vertical axis through the middle of its cells, and of the
/// whole object across. None for objects that such a turn leaves as they are.
[[nodiscard]] inline std::vector<rigid_motion> turned_around(const found_object& h,
                                                             const scene_evidence& scene,
                                                             const surface_model& model) {
    constexpr angle half = degrees(180.0);
    if (model.symmetry().difference(half, degrees(0.0)) < turn_of_one) return {};
    const auto on = scene.cells_on(model, h.aligned.pose);
    if (on.empty()) return {};
    Eigen::Vector3d seen = Eigen::Vector3d::Zero();  // of cells, in the frame of the object
    for (const point_index i : on) seen += h.aligned.pose.point_in(scene.cells().points[i]);
    seen *= 2.0 / static_cast<double>(on.size());
    const Eigen::Vector3d whole = model.low() + model.high();
    return {h.aligned.pose * rigid_motion::on_ground(whole.x(), seen.y(), half),
            h.aligned.pose * rigid_motion::on_ground(seen.x(), whole.y(), half)};
}

/// A hypothesis, or the same object aligned from a start next to it, and again from one next to
/// that, where it fits clearly better: an alignment may end where a slat of the model is on the
/// next slat of the chair. One that is not worth it after a round is not improved further.
/// @param better_from  (best, start): the same object, aligned from a start, if it fits better
/// @param also         further starts, which are tried once
[[nodiscard]] inline found_object improved(found_object best, const auto& better_from,
                                           const std::vector<rigid_motion>& also = {}) {
    constexpr int most = 3;        // rounds; chosen: few change in the third
    constexpr double step = 0.08;  // [m]; chosen, and tried on rooms of seeds 1 to 14
    // Tops of tables slide along themselves, in touching rooms of seeds 101 to 160 and 541 to 590:
    constexpr double wide = 0.16;          // [m]; chosen
    constexpr angle turn = degrees(12.0);  // chosen: as wide at 40 cm from the middle
    constexpr angle none = degrees(0.0);
    for (int round = 0; round < most; ++round) {
        const rigid_motion from = best.aligned.pose;
        bool is_better = false;
        const auto try_from = [&](const rigid_motion& start) {
            std::optional<found_object> next = better_from(best, start);
            if (!next) return;
            best = *std::move(next);
            is_better = true;
        };
        for (const rigid_motion& other :
             {rigid_motion::on_ground(wide, 0.0, none), rigid_motion::on_ground(-wide, 0.0, none),
              rigid_motion::on_ground(0.0, wide, none), rigid_motion::on_ground(0.0, -wide, none),
              rigid_motion::on_ground(step, 0.0, none), rigid_motion::on_ground(-step, 0.0, none),
              rigid_motion::on_ground(0.0, step, none), rigid_motion::on_ground(0.0, -step, none),
              rigid_motion::on_ground(0.0, 0.0, turn),
              rigid_motion::on_ground(0.0, 0.0, degrees(-turn.degrees()))})
            try_from(from * other);
        if (round == 0) std::ranges::for_each(also, try_from);
        if (!is_better || best.probability < scene_evidence::worth) break;
    }
    return best;
}

/// Aligns an object roughly from a start next to its pose. None if it returns to that pose.
[[nodiscard]] inline std::optional<found_object> aligned_elsewhere(const scene_evidence& scene,
                                                                   const found_object& best,
                                                                   const rigid_motion& start,
                                                                   const surface_model& model) {
    constexpr double apart = 0.01;        // [m]; chosen on rooms of seeds 1 to 60, of .01 and .03
    constexpr angle turn = degrees(2.0);  // chosen: as wide at 30 cm from the middle
    found_object rough = scene.only_aligned(best.object, start, model, repeated_effort);
    return is_same(best, rough, model, apart, turn) ? std::nullopt
                                                    : std::optional(std::move(rough));
}

/// A hypothesis that was aligned roughly, improved.
[[nodiscard]] inline found_object improved_roughly(const scene_evidence& scene,
                                                   const found_object& rough,
                                                   const surface_model& model) {
    return improved(rough, [&](const found_object& best, const rigid_motion& start) {
        std::optional<found_object> other = aligned_elsewhere(scene, best, start, model);
        return other ? scene.verified_better(best, *std::move(other), model, repeated_effort)
                     : std::nullopt;
    });
}

/// A hypothesis that was aligned carefully, improved, also if it faces the other way. Starts from
/// which a rough alignment returns are left out, since a careful one mostly returns, too.
[[nodiscard]] inline found_object improved_carefully(const scene_evidence& scene,
                                                     const found_object& careful,
                                                     const surface_model& model) {
    return improved(
        careful,
        [&](const found_object& best, const rigid_motion& start) -> std::optional<found_object> {
            if (!aligned_elsewhere(scene, best, start, model)) return std::nullopt;
            return scene.verified_better(
                best, scene.only_aligned(best.object, start, model, careful_effort), model,
                careful_effort);
        },
        turned_around(careful, scene, model));
}

/// A hypothesis, aligned carefully from its pose, and compared by its silhouette.
[[nodiscard]] inline found_object aligned_carefully(const scene_evidence& scene,
                                                    const found_object& rough,
                                                    const surface_model& model) {
    found_object careful = scene.aligned(rough.object, rough.aligned.pose, model, careful_effort);
    scene.compare_silhouette(careful, model);
    return careful;
}

/// An object that may stand at a place: aligned roughly from there.
[[nodiscard]] inline found_object aligned_roughly(const scene_evidence& scene,
                                                  const object_place& place,
                                                  std::span<const surface_model> models) {
    return scene.aligned(place.object, place.pose, models[place.object], rough_effort);
}

/// An object that may stand at a place: aligned from there, improved, and aligned carefully.
[[nodiscard]] inline found_object aligned_at(const scene_evidence& scene, const object_place& place,
                                             std::span<const surface_model> models) {
    const surface_model& model = models[place.object];
    return aligned_carefully(
        scene, improved_roughly(scene, aligned_roughly(scene, place, models), model), model);
}

/// The hypotheses of a probability of `least` or more, the most probable one first, and of those
/// that are one object at one pose only that.
[[nodiscard]] inline std::vector<found_object> distinct(std::vector<found_object> hypotheses,
                                                        std::span<const surface_model> models,
                                                        double least) {
    std::ranges::stable_sort(hypotheses, std::greater{}, &found_object::probability);
    std::vector<found_object> kept;
    for (found_object& h : hypotheses) {
        if (h.probability < least) break;
        if (std::ranges::none_of(
                kept, [&](const found_object& k) { return is_same(h, k, models[h.object]); }))
            kept.push_back(std::move(h));
    }
    return kept;
}

/// Hypotheses that are worth it: aligned roughly from all places, then improved, then aligned
/// carefully. Those that came to one pose are reduced to one before each of the last two steps.
/// @param least  the probability below which one that was aligned roughly is not improved
[[nodiscard]] inline std::vector<found_object> hypotheses_at(std::span<const object_place> places,
                                                             const scene_evidence& scene,
                                                             std::span<const surface_model> models,
                                                             double least, const auto& run) {
    std::vector<found_object> some(places.size());
    run(places.size(), [&](std::size_t i) { some[i] = aligned_roughly(scene, places[i], models); });
    const auto take = [&](const auto& step, double enough) {
        some = distinct(std::move(some), models, enough);
        run(some.size(),
            [&](std::size_t i) { some[i] = step(scene, some[i], models[some[i].object]); });
    };
    take(improved_roughly, least);
    take(aligned_carefully, scene_evidence::worth);
    return some;
}

/// Moves objects that were found, each aligned carefully, to the poses that fit best, and refines
/// these. They are as probable as before.
inline void settle(std::vector<found_object>& objects, const scene_evidence& scene,
                   std::span<const surface_model> models, const auto& run) {
    run(objects.size(), [&](std::size_t i) {
        found_object& o = objects[i];
        const surface_model& model = models[o.object];
        found_object settled = improved_carefully(scene, o, model);
        settled.silhouette = scene.silhouette_of(model, settled.aligned.pose);
        settled.aligned = scene.refined(settled.aligned, model);
        settled.log_recognized = o.log_recognized;
        settled.probability = o.probability;
        o = std::move(settled);
    });
}

}  // namespace gnomon::recognition::detail

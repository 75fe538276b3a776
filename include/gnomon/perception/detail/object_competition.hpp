// SPDX-License-Identifier: BSL-1.0
/// @file
/// Hypotheses compete for the cells of a scan: each object that is found explains cells of its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/point.hpp>
#include <gnomon/perception/detail/object_hypotheses.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition::detail {

/// Corrects the probabilities of the hypotheses that would be found without that, unless it was
/// done before.
inline void recognize_all(std::vector<found_object>& hypotheses, double least,
                          const auto& recognize, const auto& run) {
    run(hypotheses.size(), [&](std::size_t i) {
        found_object& h = hypotheses[i];
        const bool is_recognized = h.log_recognized < 0.0;
        if (h.probability >= least && !is_recognized) recognize(h);
    });
}

/// Changes the numbers of the objects whose surface the cells are on.
/// @param place  the new number of each object
inline void renumber(std::vector<std::int32_t>& of_cell, std::span<const std::int32_t> place) {
    for (std::int32_t& label : of_cell)
        if (label != unlabeled) label = place[static_cast<std::size_t>(label)];
}

/// The most probable hypotheses, of which each explains cells of its own.
///
/// Round by round: what is found in one takes its cells, which no longer count against the others
/// in the next, as those of a chair do against the table above its seat.
/// @param min_probability  of objects that are found, but at least scene_evidence::worth
/// @param recognize  (h): corrects the probability of a hypothesis by a recognizer, which only
///                   makes it less: called for those that would be found without it
/// @param of_cell  gets the numbers of the winners whose surface the cells are on
/// @return the most probable one first
/// Complexity: O(r h) verifications for r rounds and h hypotheses.
[[nodiscard]] inline std::vector<found_object> winners_of(
    std::vector<found_object> hypotheses, const scene_evidence& scene,
    std::span<const surface_model> surfaces, double min_probability, const auto& recognize,
    std::vector<std::int32_t>& of_cell, const auto& run) {
    constexpr double own_share = 0.5;  // chosen before any room was seen: the larger part
    const double least = std::max(min_probability, scene_evidence::worth);
    const auto is_left = [&](point_index c) { return of_cell[c] == unlabeled; };
    of_cell.assign(scene.cells().size(), unlabeled);
    std::vector<found_object> found;
    while (true) {
        const std::size_t before = found.size();
        recognize_all(hypotheses, least, recognize, run);
        std::ranges::stable_sort(hypotheses, std::greater{}, &found_object::probability);
        std::vector<found_object> others;
        for (found_object& h : hypotheses) {
            if (h.evidence.explained == 0) continue;
            if (h.probability < least) {
                others.push_back(std::move(h));
                continue;
            }
            const auto on = scene.cells_on(surfaces[h.object], h.aligned.pose);
            const auto own = static_cast<std::size_t>(std::ranges::count_if(on, is_left));
            if (static_cast<double>(own) < own_share * static_cast<double>(on.size()) || own == 0)
                continue;
            for (const point_index c : on)
                if (is_left(c)) of_cell[c] = static_cast<std::int32_t>(found.size());
            found.push_back(std::move(h));
        }
        hypotheses = std::move(others);
        if (found.size() == before) break;
        run(hypotheses.size(), [&](std::size_t i) {
            scene.update(hypotheses[i], surfaces[hypotheses[i].object], is_left);
        });
    }
    // The most probable one first, also of those that were found in other rounds.
    std::vector<std::size_t> order(found.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::size_t i) { return found[i].probability; });
    std::vector<found_object> sorted;
    std::vector<std::int32_t> place(found.size());
    for (const std::size_t i : order) {
        place[i] = static_cast<std::int32_t>(sorted.size());
        sorted.push_back(std::move(found[i]));
    }
    renumber(of_cell, place);
    return sorted;
}

/// The objects in a scene, at poses of careful alignments. First the hypotheses at voted places
/// compete, and the winners take their cells. Then the surfaces of all objects are searched in the
/// remaining cells, where fewer wrong places fit. Finally all hypotheses compete again.
/// Parameters and result are those of winners_of(). Complexity: that of hypotheses_at() for the
/// places, and twice that of winners_of().
[[nodiscard]] inline std::vector<found_object> objects_in(
    const scene_evidence& scene, std::span<const surface_model> surfaces, double min_probability,
    const auto& recognize, std::vector<std::int32_t>& of_cell, const auto& run) {
    const auto winners = [&](std::vector<found_object> some, double least) {
        return winners_of(std::move(some), scene, surfaces, least, recognize, of_cell, run);
    };
    // Less probable objects, where these are wanted, too, take no cells from others.
    const double clear = std::max(min_probability, find_objects_options{}.min_probability);
    auto hypotheses =
        hypotheses_at(scene.voted_places(run), scene, surfaces, scene_evidence::worth, run);
    recognize_all(hypotheses, clear, recognize, run);
    (void)winners(hypotheses, clear);
    const auto is_left = [&](point_index c) { return of_cell[c] == unlabeled; };
    // Without votes, and from places that are farther off, true objects are less probable at first.
    // Of .001 to .01, on touching rooms of seeds 101 to 160 and 541 to 590:
    constexpr double least_rough = 0.002;  // probability; chosen
    auto others = hypotheses_at(scene.searched_places(surfaces, is_left, run), scene, surfaces,
                                least_rough, run);
    std::ranges::move(others, std::back_inserter(hypotheses));
    return winners(std::move(hypotheses), min_probability);
}

/// Makes one object of those that settled at one pose, of which each had won cells elsewhere: the
/// first one stays, with the cells of all.
inline void unite(std::vector<found_object>& objects, std::vector<std::int32_t>& of_cell,
                  std::span<const surface_model> surfaces) {
    std::vector<found_object> kept;
    std::vector<std::int32_t> place;
    for (found_object& o : objects) {
        const auto same = std::ranges::find_if(
            kept, [&](const found_object& k) { return is_same(o, k, surfaces[o.object]); });
        place.push_back(static_cast<std::int32_t>(same - kept.begin()));
        if (same == kept.end()) kept.push_back(std::move(o));
    }
    objects = std::move(kept);
    renumber(of_cell, place);
}

}  // namespace gnomon::recognition::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How well the segments of a scan are its true surfaces. Only points that are kept count.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "joined_surfaces.hpp"

/// A true surface, and the segment that it has most in common with.
struct recovered_surface {
    std::size_t points = 0;               ///< of the surface, with a label or without
    double iou = 0.0;                     ///< intersection over union with the best segment
    std::int32_t surface = sim::nothing;  ///< its number in joined_surfaces
};

/// The true surfaces that have at least `fewest` points.
inline std::vector<recovered_surface> recovered(const joined_surfaces& surfaces,
                                                const std::vector<gnomon::point_index>& kept,
                                                const gnomon::segments& found, std::size_t fewest) {
    std::map<std::int32_t, std::map<std::int32_t, std::size_t>> common;
    std::map<std::int32_t, std::size_t> size;
    for (const auto i : kept) {
        const std::int32_t label = found.labels()[i];
        if (label == gnomon::unlabeled) continue;
        ++size[label];
        ++common[surfaces.of(i)][label];
    }
    std::vector<recovered_surface> result;
    for (const auto& [surface, points] : surfaces.points()) {
        if (points < fewest) continue;
        double best = 0.0;
        for (const auto& [label, both] : common[surface])
            best = std::max(
                best, static_cast<double>(both) / static_cast<double>(points + size[label] - both));
        result.push_back({points, best, surface});
    }
    return result;
}

/// The mean IoU; each surface counts once, or with its points. 1 if there are no surfaces.
inline double mean_iou(const std::vector<recovered_surface>& all, bool by_points) {
    double sum = 0.0, whole = 0.0;
    for (const recovered_surface& s : all) {
        const double weight = by_points ? static_cast<double>(s.points) : 1.0;
        sum += weight * s.iou;
        whole += weight;
    }
    return whole > 0.0 ? sum / whole : 1.0;
}

/// The share of the labeled points that are not of the surface of most points of their segment.
inline double impurity(const joined_surfaces& surfaces,
                       const std::vector<gnomon::point_index>& kept,
                       const gnomon::segments& found) {
    std::map<std::int32_t, std::map<std::int32_t, std::size_t>> count;
    for (const auto i : kept)
        if (found.labels()[i] != gnomon::unlabeled) ++count[found.labels()[i]][surfaces.of(i)];
    std::size_t labeled = 0, pure = 0;
    for (const auto& [label, of_surface] : count) {
        std::size_t most = 0;
        for (const auto& [surface, points] : of_surface) {
            labeled += points;
            most = std::max(most, points);
        }
        pure += most;
    }
    return labeled == 0 ? 0.0 : static_cast<double>(labeled - pure) / static_cast<double>(labeled);
}

/// The most frequent value of some points; the smallest of several.
inline std::int32_t most_frequent(const auto& points, auto&& value_of) {
    std::map<std::int32_t, std::size_t> count;
    for (const auto i : points) ++count[value_of(i)];
    return std::max_element(count.begin(), count.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

/// The tallies of merging, over pairs of initial segments that count once, or with the points of
/// the smaller one. Each is of the true surface of most of its points. A pair is wanted if an
/// occluder interrupts one flat surface between them, also by a chain of such pairs.
inline merge_tallies merging_of(const sim::bvh_caster& caster, const sim::true_scan& truth,
                                const joined_surfaces& surfaces, const gnomon::segments& parts,
                                const gnomon::segments& merged) {
    std::vector<std::int32_t> surface, label;
    for (std::size_t s = 0; s < parts.size(); ++s) {
        surface.push_back(most_frequent(parts[s], [&](auto i) { return surfaces.of(i); }));
        label.push_back(most_frequent(parts[s], [&](auto i) { return merged.labels()[i]; }));
    }
    const auto chain =
        chains_of_occluded_gaps(caster, truth, parts, [&](std::size_t i, std::size_t j) {
            return surface[i] == surface[j] && surface[i] != sim::nothing &&
                   surfaces.is_flat(surface[i]);
        });
    merge_tallies total;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = i + 1; j < parts.size(); ++j) {
            const bool is_done = label[i] == label[j] && label[i] != gnomon::unlabeled;
            merge_tally pair;
            if (chain[i] == chain[j]) {
                pair.wanted = 1.0;
                pair.right = is_done ? 1.0 : 0.0;
            } else if (is_done && surface[i] != surface[j]) {
                pair.wrong = 1.0;
            }
            total.pairs.add(pair, 1.0);
            total.by_points.add(pair,
                                static_cast<double>(std::min(parts[i].size(), parts[j].size())));
        }
    }
    return total;
}

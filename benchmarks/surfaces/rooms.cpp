// SPDX-License-Identifier: BSL-1.0
// The surfaces of random furnished rooms, by noise, density of the scan lines and trajectory: how
// well the segments are the true surfaces, and which interrupted surfaces are merged.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "../chapter4/record.hpp"
#include "furnished.hpp"
#include "perceived.hpp"
#include "scores.hpp"

#ifndef GNOMON_SIGMA_TOLD
#include "flatness_check.hpp"
#include "true_competition.hpp"
constexpr bool is_older = false;
#else
constexpr bool is_older = true;  // no noise and no planes are in the result
#endif

namespace {

/// What the command line selects; an empty name and no noise stand for all.
struct selection {
    std::uint64_t first = 10'001, rooms = 40;
    double noise = 0.0;  // [mm]
    std::string density, trajectory;
    unsigned threads = 2;  // rooms at a time

    [[nodiscard]] bool has(const setting& s) const {
        return (noise == 0.0 || noise == s.noise) && (density.empty() || density == s.density) &&
               (trajectory.empty() || trajectory == s.trajectory);
    }
};

constexpr const char* options =
    " [--seeds FIRST COUNT] [--noise MM] [--density half|whole|double]"
    " [--trajectory rotational|vertical|horizontal|moving] [--threads N]";

/// The whole number that a word is, or 0.
std::uint64_t number(const char* word) { return std::strtoull(word, nullptr, 10); }

/// Takes its options out of the command line; those that make no sense stay there.
selection selection_of(std::vector<char*>& words) {
    selection chosen;
    std::vector<char*> rest{words.front()};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string_view word = words[i];
        const auto is = [&](std::string_view option, const auto& values) {
            return word == option && i + 1 < words.size() &&
                   std::ranges::find(values, std::string_view(words[i + 1])) != values.end();
        };
        if (word == "--seeds" && i + 2 < words.size() && number(words[i + 2]) > 0) {
            chosen.first = number(words[++i]);
            chosen.rooms = number(words[++i]);
        } else if (is("--noise", std::array{"5", "15", "30"})) {
            chosen.noise = std::strtod(words[++i], nullptr);
        } else if (is("--density", densities)) {
            chosen.density = words[++i];
        } else if (is("--trajectory", trajectories)) {
            chosen.trajectory = words[++i];
        } else if (word == "--threads" && i + 1 < words.size() && number(words[i + 1]) > 0) {
            chosen.threads = static_cast<unsigned>(number(words[++i]));
        } else {
            rest.push_back(words[i]);
        }
    }
    words = rest;
    return chosen;
}

/// The scores of one room.
struct score {
    std::uint64_t seed = 0;
    double iou = 0.0, iou_by_points = 0.0, impurity = 0.0, seconds = 0.0;
    std::size_t surfaces = 0, segments = 0;
    merge_tallies merging;
    // Not of an older version of the library:
    std::size_t blobs = 0;                                // flat segments that have a blob
    double from_truth = 0.0, from_truth_by_points = 0.0;  // IoU of true_competition
};

/// Scores that require the noise and the planes of the result, which older versions do not return.
void add_scores_of_planes(score& to, const sim::true_scan& truth, const joined_surfaces& surfaces,
                          const auto& seen, std::size_t fewest) {
#ifndef GNOMON_SIGMA_TOLD
    to.blobs = flatness_of(truth.scan, seen).with_blob;
    const auto best = true_competition(truth, surfaces, seen).segments(truth.scan.size());
    const auto found = recovered(surfaces, seen.kept, best, fewest);
    to.from_truth = mean_iou(found, false);
    to.from_truth_by_points = mean_iou(found, true);
#else
    (void)to, (void)truth, (void)surfaces, (void)seen, (void)fewest;
#endif
}

score score_of(const setting& how, std::uint64_t seed) {
    constexpr std::size_t fewest = 100;  // points of a surface that counts
    const sim::scene world = furnished(seed);
    const sim::bvh_caster caster(world);
    const sim::true_scan truth = scan_of(world, caster, how, 1000 * seed + 1);
    const auto start = std::chrono::steady_clock::now();
    const auto seen = perceive(truth.scan, true, how.sigma());
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const joined_surfaces surfaces(truth, seen.kept);
    const auto found = recovered(surfaces, seen.kept, seen.surfaces, fewest);
    score result{seed,
                 mean_iou(found, false),
                 mean_iou(found, true),
                 impurity(surfaces, seen.kept, seen.surfaces),
                 taken.count(),
                 found.size(),
                 seen.surfaces.size(),
                 merging_of(caster, truth, surfaces, seen.initial_segments, seen.surfaces)};
    add_scores_of_planes(result, truth, surfaces, seen, fewest);
    return result;
}

/// The mean of a score over rooms.
double mean_of(const std::vector<score>& rooms, auto member) {
    double sum = 0.0;
    for (const score& s : rooms) sum += static_cast<double>(s.*member);
    return sum / static_cast<double>(rooms.size());
}

/// A row over rooms. Segments are pooled for precision and recall, and blobs added up.
json pooled(json row, const std::vector<score>& rooms) {
    const auto mean = [&](auto member) { return mean_of(rooms, member); };
    std::size_t blobs = 0;
    merge_tally merging;  // by points
    double pairs = 0.0;
    for (const score& s : rooms) {
        merging.add(s.merging.by_points, 1.0);
        pairs += s.merging.pairs.wanted;
        blobs += s.blobs;
    }
    row.update({{"rooms", rooms.size()},
                {"mean IoU", rounded(mean(&score::iou), 4)},
                {"by points", rounded(mean(&score::iou_by_points), 4)},
                {"impurity", rounded(mean(&score::impurity), 4)},
                {"wanted pairs", pairs},
                {"wanted", merging.wanted},
                {"right", merging.right},
                {"wrong", merging.wrong},
                {"precision", rounded(merging.precision(), 3)},
                {"recall", rounded(merging.recall(), 3)},
                {"segments", rounded(mean(&score::segments), 1)},
                {"time [s]", rounded(mean(&score::seconds), 2)}});
    if (!is_older) row["blobs"] = blobs;
    return row;
}

/// A row with the IoU that the competition of planes reaches, next to that of the chain.
json from_truth_of(json row, const std::vector<score>& rooms) {
    row.update(
        {{"rooms", rooms.size()},
         {"mean IoU", rounded(mean_of(rooms, &score::iou), 4)},
         {"from the truth", rounded(mean_of(rooms, &score::from_truth), 4)},
         {"by points", rounded(mean_of(rooms, &score::iou_by_points), 4)},
         {"by points, from the truth", rounded(mean_of(rooms, &score::from_truth_by_points), 4)}});
    return row;
}

json row_of(json row, const score& s) {
    row.update({{"seed", s.seed},
                {"surfaces", s.surfaces},
                {"IoU", rounded(s.iou, 5)},
                {"by points", rounded(s.iou_by_points, 5)},
                {"impurity", rounded(s.impurity, 5)},
                {"wanted", s.merging.by_points.wanted},
                {"right", s.merging.by_points.right},
                {"wrong", s.merging.by_points.wrong},
                {"segments", s.segments},
                {"time [s]", rounded(s.seconds, 3)}});
    if (!is_older) row.update({{"blobs", s.blobs}, {"from the truth", rounded(s.from_truth, 5)}});
    return row;
}

json measure(const effort& much, selection chosen) {
    if (much.quick) chosen.rooms = std::min<std::uint64_t>(chosen.rooms, 2);
    json settings = json::array(), by_noise = json::array(), rooms = json::array();
    json from_truth = json::array();
    for (const double noise : noises) {
        std::vector<score> of_noise;
        for (const std::string density : densities) {
            for (const std::string trajectory : trajectories) {
                const setting how{noise, density, trajectory};
                if (!chosen.has(how)) continue;
                std::vector<score> scores(chosen.rooms);
                gnomon::threads{chosen.threads}(scores.size(), [&](std::size_t r) {
                    scores[r] = score_of(how, chosen.first + r);
                });
                const json name{
                    {"noise [mm]", noise}, {"density", density}, {"trajectory", trajectory}};
                settings.push_back(pooled(name, scores));
                for (const score& s : scores) rooms.push_back(row_of(name, s));
                of_noise.insert(of_noise.end(), scores.begin(), scores.end());
                std::printf("%s\n", settings.back().dump().c_str());
                std::fflush(stdout);
            }
        }
        if (of_noise.empty()) continue;
        by_noise.push_back(pooled({{"noise [mm]", noise}}, of_noise));
        if (!is_older) from_truth.push_back(from_truth_of({{"noise [mm]", noise}}, of_noise));
    }
    return {{"by noise", by_noise},
            {"from the truth", from_truth},
            {"by setting", settings},
            {"rooms", rooms}};
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<char*> words(argv, argv + argc);
    const selection chosen = selection_of(words);
    return run_program(
        static_cast<int>(words.size()), words.data(),
        [&](const effort& much) { return measure(much, chosen); }, options);
}

// SPDX-License-Identifier: BSL-1.0
// Alg. 4.3 in random furnished rooms: how many of the surfaces that something before them has torn
// apart are mended, and what else is merged, by policy and by the way the sensor moves. One program
// for all policies at once, as the scans take longest: a row says how they did.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "figure.hpp"
#include "fragments.hpp"
#include "rooms.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace {

/// How a policy did in all rooms, seed by seed.
struct performance {
    struct of_seed {
        merge_tally pairs, by_points;
        double seconds = 0.0;  ///< of merging
    };
    std::map<std::string, std::vector<of_seed>> policies;
    std::vector<double> fragments, mixed, sight_seconds;  ///< in a room, seed by seed
};

performance performance_of(const std::string& trajectory, std::uint64_t rooms,
                           std::uint64_t seeds) {
    performance result;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        double count = 0.0, mixed = 0.0, sight_seconds = 0.0;
        std::map<std::string, performance::of_seed> totals;
        for (std::uint64_t number = 1; number <= rooms; ++number) {
            const gnomon::scene world = room(number);
            const gnomon::bvh_caster caster(world);
            const auto truth = scan_of(world, caster, trajectory, 1000 * number + seed);
            const segmented_room seen(truth.scan);
            const gnomon::subset_view points(truth.scan, seen.kept);
            fragments all(caster, truth, seen.kept, seen.parts);
            for (std::size_t s = 0; s < seen.parts.size(); ++s) {
                ++count;
                mixed += all.surface(s) == gnomon::nothing ? 1.0 : 0.0;
            }

            std::optional<gnomon::lines_of_sight> sights;
            sight_seconds += seconds_of([&] { sights.emplace(truth.scan); });
            const gnomon::lines_of_sight upright(truth.scan, {.pole = Eigen::Vector3d::UnitZ()});
            const auto measure = [&](const std::string& policy, const auto& merge) {
                performance::of_seed& total = totals[policy];
                gnomon::segments merged;
                total.seconds += seconds_of([&] { merged = merge(); });
                total.pairs += all.tally(merged, false);
                total.by_points += all.tally(merged, true);
            };
            const auto merge_by = [&](const std::string& policy, const auto& model) {
                measure(policy, [&] {
                    return gnomon::merge_occluded(points, seen.parts, *sights, model).segments;
                });
                measure("literal " + policy, [&] {
                    return gnomon::merge_occluded_literally(points, seen.parts, upright, model);
                });
            };
            measure("none", [&] { return seen.parts; });
            merge_by("conservative", gnomon::conservative{});
            merge_by("liberal", gnomon::liberal{});
        }
        for (const auto& [policy, total] : totals) result.policies[policy].push_back(total);
        result.fragments.push_back(count / static_cast<double>(rooms));
        result.mixed.push_back(mixed / count);
        result.sight_seconds.push_back(sight_seconds / static_cast<double>(rooms));
    }
    return result;
}

void report(benchmark::State& state, const performance& found, const std::string& policy,
            std::uint64_t rooms) {
    const auto count = [&](const char* name, const auto& value_of) {
        std::vector<double> of_seeds;
        for (const auto& s : found.policies.at(policy)) of_seeds.push_back(value_of(s));
        count_seeds(state, name, of_seeds);
    };
    count("precision", [](const auto& s) { return s.pairs.precision(); });
    count("recall", [](const auto& s) { return s.pairs.recall(); });
    count("precision_by_points", [](const auto& s) { return s.by_points.precision(); });
    count("recall_by_points", [](const auto& s) { return s.by_points.recall(); });
    count("wanted", [](const auto& s) { return s.pairs.wanted; });
    count("wrong", [](const auto& s) { return s.pairs.wrong; });
    count("wrong_coplanar", [](const auto& s) { return s.pairs.coplanar; });
    count("wrong_in_noise", [](const auto& s) { return s.pairs.in_noise; });
    count("ms", [&](const auto& s) { return 1e3 * s.seconds / static_cast<double>(rooms); });
    count_seeds(state, "ms_sights", [&] {
        std::vector<double> ms;
        for (const double s : found.sight_seconds) ms.push_back(1e3 * s);
        return ms;
    }());
    count_seeds(state, "fragments", found.fragments);
    count_seeds(state, "mixed", found.mixed);
    state.counters["rooms"] = static_cast<double>(rooms);
}

}  // namespace

void enter_benchmarks(const effort& much) {
    const std::uint64_t rooms = much.number("rooms", 100, 4);
    const std::uint64_t seeds = much.number("seeds", 5, 1);
    for (const char* trajectory : {"horizontal", "vertical", "rotational", "moving"}) {
        for (const char* policy :
             {"none", "conservative", "liberal", "literal conservative", "literal liberal"}) {
            const std::string name =
                std::string("merge_policies/trajectory:") + trajectory + "/policy:" + policy;
            benchmark::RegisterBenchmark(
                name.c_str(),
                [=, way = std::string(trajectory)](benchmark::State& state) {
                    static latest<performance> known;
                    for (auto _ : state) {
                        const performance& found =
                            known(way, [&] { return performance_of(way, rooms, seeds); });
                        state.PauseTiming();
                        report(state, found, policy, rooms);
                        state.ResumeTiming();
                    }
                })
                ->Iterations(1)
                ->Unit(benchmark::kMillisecond);
        }
    }
}

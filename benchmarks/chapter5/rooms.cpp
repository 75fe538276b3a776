// SPDX-License-Identifier: BSL-1.0
// Whole rooms with clutter, Sec. 5.7: which pieces of furniture are found and named, by methods
// that get nothing but the scan. In further rooms, objects touch walls and each other.
#include "rooms.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "offered_hypotheses.hpp"
#include "outcomes.hpp"
#include "room_methods.hpp"
#include <gnomon/perception/find_objects.hpp>

namespace {

/// A method, and the probabilities from which on it decides on objects, and finds any.
struct method {
    std::string name;
    room_method find;
    double min_probability = 0.90, least_probability = 0.0;
};

/// @param finder  refers to it
std::vector<method> methods_of(const effort& much, std::uint64_t seed,
                               const rec::object_finder& finder) {
    const double found = rec::find_objects_options{}.min_probability;
    return {{"thesis grouping", thesis_grouping(much, seed)},
            {"voting and verification", voting(finder), found, found}};
}

/// The rooms of a seed.
struct room_set {
    const char* name;
    bool touching;
    std::size_t rooms;
    std::size_t first = 0;  ///< added to the first room of the seed
};

/// The values of P_d of Fig. 5.10.
constexpr double thresholds[] = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99};

/// The judgements of one method on one set of rooms, seed by seed.
struct method_row {
    json key;
    std::vector<judgement> seeds = {};  ///< at the P_d of the method
    std::vector<std::vector<judgement>> by_threshold{std::size(thresholds)};  ///< the same at each
    std::vector<double> times = {};  ///< of the processor, all threads, per room [s]

    void begin_seed() {
        seeds.emplace_back();
        for (auto& of_threshold : by_threshold) of_threshold.emplace_back();
    }
    void judge(const seen_room& room, const method& by, const equal_headings& headings) {
        const double start = processor_time(CLOCK_PROCESS_CPUTIME_ID);
        const auto found = by.find(room.truth.scan);
        times.push_back(processor_time(CLOCK_PROCESS_CPUTIME_ID) - start);
        seeds.back().add(judgement_of(room, found, headings, by.min_probability));
        for (std::size_t t = 0; t < std::size(thresholds); ++t)
            if (thresholds[t] >= by.least_probability)
                by_threshold[t].back().add(judgement_of(room, found, headings, thresholds[t]));
    }
};

/// A value of each seed: the median, and the worst.
void add_values(json& row, const std::string& name, const std::vector<double>& values,
                double worst) {
    row[name] = rounded(median_of(values), 3);
    row[name + ", worst"] = rounded(worst, 3);
}
void add_share(json& row, const char* name, const std::vector<judgement>& seeds,
               double (judgement::*share)() const) {
    std::vector<double> values;
    for (const judgement& j : seeds) values.push_back((j.*share)());
    add_values(row, name, values, std::ranges::min(values));
}
void add_shares(json& row, const std::vector<judgement>& seeds) {
    add_share(row, "accuracy", seeds, &judgement::accuracy);
    add_share(row, "precision", seeds, &judgement::precision);
    add_share(row, "recall", seeds, &judgement::recall);
}

/// The rows of Fig. 5.10, for the thresholds at which the method was tested.
void add_curve(json& table, const method_row& row) {
    for (std::size_t t = 0; t < std::size(thresholds); ++t) {
        if (row.by_threshold[t].front().views == 0) continue;
        table.push_back(row.key);
        table.back()["P_d"] = thresholds[t];
        add_shares(table.back(), row.by_threshold[t]);
    }
}

json row_of(const method_row& row) {
    json result = row.key;
    add_shares(result, row.seeds);
    add_share(result, "whole", row.seeds, &judgement::wholeness);
    judgement all;
    for (const judgement& j : row.seeds) all.add(j);
    result["objects"] = all.objects;
    result["decided"] = all.decided;
    result["views"] = all.views;
    if (!all.poses.empty()) {
        result["poses"] = all.poses.size();
        std::vector<double> shares, means;  // of the seeds with poses
        for (const judgement& j : row.seeds) {
            if (!j.poses.empty()) shares.push_back(j.share_of_right_poses());
            if (const auto nees = j.nees(); !nees.empty())
                means.push_back(std::accumulate(nees.begin(), nees.end(), 0.0) /
                                static_cast<double>(nees.size()));
        }
        add_values(result, "within 2 cm and 2 deg", shares, std::ranges::min(shares));
        const auto nees = all.nees();
        result["of these determined"] = nees.size();
        if (!nees.empty()) {
            result["NEES / dof"] = rounded(median_of(means), 3);
            result["NEES / dof, least"] = rounded(std::ranges::min(means), 3);
            result["NEES / dof, largest"] = rounded(std::ranges::max(means), 3);
            result["NEES / dof, median"] = rounded(median_of(nees), 2);
        }
    }
    result["s per room"] = rounded(median_of(row.times), 2);
    std::printf("%s\n", result.dump().c_str());
    std::fflush(stdout);
    return result;
}

/// What is in the rooms.
struct room_contents {
    std::size_t rooms = 0, points = 0, pieces = 0, hardly_seen = 0;
    std::vector<background_group> background;
    std::vector<double> times;  ///< of the simulation, likewise [s]

    void add(const seen_room& room) {
        ++rooms;
        points += room.truth.scan.size();
        for (const true_piece& p : room.pieces)
            (p.points.size() < fewest_points ? hardly_seen : pieces) += 1;
        background.insert(background.end(), room.background.begin(), room.background.end());
    }

    [[nodiscard]] json row(const char* name) const {
        const auto per_room = [&](std::size_t n) {
            return rounded(static_cast<double>(n) / static_cast<double>(rooms), 2);
        };
        const auto close = std::ranges::count_if(
            background, [](const background_group& g) { return g.distance <= 0.5; });
        std::vector<double> heights;
        for (const background_group& g : background) heights.push_back(g.height);
        std::ranges::sort(heights);
        return {{"rooms", name},
                {"number", rooms},
                {"points per room", points / rooms},
                {"objects per room", per_room(pieces)},
                {"of fewer than 60 points", per_room(hardly_seen)},
                {"background groups per room", per_room(background.size())},
                {"of these within 0.5 m of an object", per_room(static_cast<std::size_t>(close))},
                {"height, least", rounded(heights.front(), 2)},
                {"height, median", rounded(median_of(heights), 2)},
                {"height, most", rounded(heights.back(), 2)},
                {"s of simulation per room", rounded(median_of(times), 2)}};
    }
};

/// The seeds of a measurement: those of the page, or those on which methods are developed.
struct seed_plan {
    std::vector<std::uint64_t> learning;
    std::vector<room_set> sets;
    std::uint64_t first_room = 0;  ///< added to 1000 times the place of the seed

    static seed_plan of_page(const effort& much) {
        seed_plan plan{.learning = {},
                       .sets = {{"cluttered", false, much.quick ? 1u : 40u},
                                {"touching", true, much.quick ? 1u : 10u},
                                {"touching, 30 more", true, much.quick ? 1u : 30u, 10}},
                       .first_room = 1000 * first_seed};
        for (std::uint64_t s = 0; s < much.seeds(); ++s) plan.learning.push_back(first_seed + s);
        // A test of the program does not show what the page shows.
        if (much.quick) return {.learning = {1}, .sets = plan.sets, .first_room = 1};
        return plan;
    }
    static seed_plan of_development(const effort& much) {
        const std::size_t rooms = much.quick ? 2 : 8;
        return {.learning = {1},
                .sets = {{"cluttered", false, rooms}, {"touching", true, rooms}},
                .first_room = 1};
    }
};

/// The time from the points of a room to names and poses on two threads, the first rooms of a plan
/// scanned in half of the time.
json times_of(const rec::object_finder& finder, const seed_plan& plan) {
    const auto models = sim::furniture_models();
    std::vector<double> times;  // [s]
    std::size_t points = 0;
    for (std::size_t r = 0; r < std::min<std::size_t>(20, plan.sets.front().rooms); ++r) {
        const seen_room room = room_of(models, plan.first_room + r, {.duration = 4.0});
        points = std::max(points, room.truth.scan.size());
        const double start = wall_time();
        (void)objects_in(room.truth.scan, finder, gnomon::threads{2});
        times.push_back(wall_time() - start);
    }
    return {{{"rooms", times.size()},
             {"points", points},
             {"threads", 2},
             {"s per room, median", rounded(median_of(times), 2)},
             {"most", rounded(std::ranges::max(times), 2)}}};
}

json measure(const effort& much, const seed_plan& plan) {
    const auto models = sim::furniture_models();
    const equal_headings headings = equal_headings_of(models);
    json times;
    std::vector<room_contents> contents(plan.sets.size());
    std::vector<method_row> rows;
    std::vector<offered_hypotheses> offers(plan.learning.size());
    for (std::size_t s = 0; s < plan.learning.size(); ++s) {
        const rec::object_finder finder = finder_of(much, plan.learning[s]);
        if (s == 0) times = times_of(finder, plan);
        const auto methods = methods_of(much, plan.learning[s], finder);
        for (std::size_t k = 0; k < plan.sets.size(); ++k) {
            const room_set& set = plan.sets[k];
            const std::size_t first = k * methods.size();
            if (s == 0)
                for (const method& m : methods)
                    rows.push_back({.key = {{"rooms", set.name}, {"method", m.name}}});
            for (std::size_t m = 0; m < methods.size(); ++m) rows[first + m].begin_seed();
            for (std::size_t r = set.first; r < set.first + set.rooms; ++r) {
                const double start = processor_time(CLOCK_PROCESS_CPUTIME_ID);
                const seen_room room =
                    room_of(models, plan.first_room + 1000 * s + r, {.touching = set.touching});
                contents[k].times.push_back(processor_time(CLOCK_PROCESS_CPUTIME_ID) - start);
                contents[k].add(room);
                if (!set.touching) offers[s].offer(room, finder, plan.first_room + 1000 * s + r);
                for (std::size_t m = 0; m < methods.size(); ++m)
                    rows[first + m].judge(room, methods[m], headings);
            }
        }
    }
    json table = json::array(), curves = json::array();
    json counts = json::array(), turns = json::array();
    for (const method_row& row : rows) {
        table.push_back(row_of(row));
        add_curve(curves, row);
    }
    for (std::size_t k = 0; k < contents.size(); ++k) {
        counts.push_back(contents[k].row(plan.sets[k].name));
        std::printf("%s\n", counts.back().dump().c_str());
    }
    for (const auto& [name, n] : headings)
        turns.push_back({{"model", name}, {"equal headings", n == 0 ? json("all") : json(n)}});
    return {{"whole rooms", table},
            {"whole rooms by P_d", curves},
            {"hypotheses offered at each piece", offers_table(offers)},
            {"time of a room", times},
            {"contents of the rooms", counts},
            {"symmetries", turns}};
}

}  // namespace

// --develop judges on the rooms of the seeds 1 to 8, on which methods are developed.
int main(int argc, char** argv) {
    const auto words = std::vector<char*>(argv, argv + argc);
    std::vector<char*> others;
    for (char* word : words)
        if (std::string_view(word) != "--develop") others.push_back(word);
    const bool develops = others.size() < words.size();
    return run_program(
        static_cast<int>(others.size()), others.data(),
        [&](const effort& much) {
            return measure(much,
                           develops ? seed_plan::of_development(much) : seed_plan::of_page(much));
        },
        " [--develop]");
}

// SPDX-License-Identifier: BSL-1.0
// Whole rooms with clutter, Sec. 5.7: which pieces of furniture are found and named, by methods
// that get nothing but the scan. In further rooms, objects touch walls and each other.
#include "rooms.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outcomes.hpp"
#include <gnomon/filters/subset.hpp>
#include <gnomon/perception/find_objects.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/view_augmentation.hpp>
#include <gnomon/simulation/clutter.hpp>
#include <gnomon/simulation/object_views.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace {

/// What is learned as background: pieces, and views of each.
constexpr std::size_t background_pieces = 24;
std::size_t views_of_background(std::size_t views_per_model) {
    return std::max<std::size_t>(1, 3 * views_per_model / background_pieces);
}

/// As learn_objects does: each scan, and two versions of it of which a part is hidden, for the
/// models and for background.
rec::object_recognizer<> learned(const effort& much, std::uint64_t seed) {
    const auto models = sim::furniture_models();
    const std::size_t n = views_per_model(much);
    const auto seen = [&](const std::vector<sim::furniture_model>& of, std::size_t views,
                          std::uint64_t s) {
        return views_of(with_hidden_parts(scans_of(of, views, {}, s, purpose::learning), s));
    };
    rec::object_recognizer<> model;
    learn_views(model, seen(models, n, seed), names_of(models));
    const auto others = sim::clutter_models(background_pieces, seed);
    // Other seeds than those of the models, so that their places differ.
    learn_views(model, seen(others, views_of_background(n), seed + 100'000),
                std::vector<std::string>(background_pieces, std::string(rec::background_name)));
    model.fit(gnomon::threads{});
    return model;
}

/// The grouping of the thesis: points of at most 10 cm from each other are one object, Sec. 5.5.1.
class thesis_grouping {
  public:
    explicit thesis_grouping(rec::object_recognizer<> model) : model_(std::move(model)) {}

    [[nodiscard]] std::vector<found_object> operator()(const gnomon::scan& scan) const {
        const auto seen = rec::perceive_views(
            scan, {.noise = gnomon::constant_noise{room_kind{}.sigma}}, gnomon::threads{});
        std::vector<found_object> found;
        for (std::size_t v = 0; v < seen.views.size(); ++v) {
            const rec::decision d = model_.decide(seen.views[v]);
            found.push_back({.name = model_.names()[d.best],
                             .probability = d.probability[d.best],
                             .points = {seen.groups[v].begin(), seen.groups[v].end()}});
        }
        return found;
    }

  private:
    rec::object_recognizer<> model_;
};

/// Votes of parts, alignment, verification and competition: `rec::object_finder`.
class voting {
  public:
    voting(const effort& much, std::uint64_t seed) {
        constexpr double spacing = 0.02;  // of samples of surfaces [m]
        const auto models = sim::furniture_models();
        const sim::object_view_options how{.beam = {.sigma = room_kind{}.sigma}, .seed = seed};
        for (const sim::furniture_model& model : models) {
            const auto samples = sim::sample_surface(model, {.spacing = spacing});
            finder_.add(model.name, rec::surface_model(samples, samples, spacing, std::nullopt,
                                                       &sim::surface_sample::position));
        }
        const std::size_t n = views_per_model(much);
        for (const auto& shot : sim::simulate_object_views(models, n, how))
            for (const rec::view& v : versions_of(shot, how))
                finder_.learn(v, shot.pose, shot.model);
        // Other seeds, as for the other method.
        auto elsewhere = how;
        elsewhere.seed += 100'000;
        for (const auto& shot : sim::simulate_object_views(
                 sim::clutter_models(background_pieces, seed), views_of_background(n), elsewhere))
            for (const rec::view& v : versions_of(shot, elsewhere)) finder_.learn_background(v);
        finder_.fit(gnomon::threads{});
    }

    [[nodiscard]] rec::found_objects find(const gnomon::scan& scan,
                                          const gnomon::threads& run) const {
        return finder_(scan, {.noise = gnomon::constant_noise{room_kind{}.sigma}}, run);
    }

    [[nodiscard]] std::vector<found_object> operator()(const gnomon::scan& scan) const {
        const auto result = find(scan, gnomon::threads{});
        std::vector<found_object> found;
        for (std::size_t i = 0; i < result.objects.size(); ++i) {
            const rec::found_object& o = result.objects[i];
            found.push_back({.name = finder_.names()[o.object],
                             .probability = o.probability,
                             .points = {result.points[i].begin(), result.points[i].end()},
                             .aligned = o.aligned});
        }
        // What remains of groups is background, if it is the larger part of them.
        for (std::size_t g = 0; g < result.seen.groups.size(); ++g) {
            std::vector<gnomon::point_index> rest;
            for (const gnomon::point_index i : result.seen.groups[g])
                if (result.points.labels()[i] == gnomon::unlabeled) rest.push_back(i);
            if (rest.size() >= fewest_points && 2 * rest.size() > result.seen.groups[g].size())
                found.push_back({.name = std::string(rec::background_name),
                                 .probability = 1.0,
                                 .points = std::move(rest)});
        }
        return found;
    }

  private:
    /// A view, and two versions of its scan of which a part is hidden, as other methods learn.
    [[nodiscard]] std::vector<rec::view> versions_of(const sim::object_view& shot,
                                                     const sim::object_view_options& how) {
        std::vector<rec::view> versions;
        gnomon::random_stream random(~how.seed, learned_++);
        for (int version = 0; version < 3; ++version) {
            gnomon::scan scan = shot.truth.scan;
            if (version > 0)
                scan = gnomon::subset(scan, rec::hide_part(scan, how.sensor.position, random));
            auto seen = rec::perceive_views(scan, {.ground = gnomon::plane{},
                                                   .noise = gnomon::constant_noise{how.beam.sigma},
                                                   .gap = rec::infinite_gap,
                                                   .min_points = fewest_cells});
            for (rec::view& v : seen.views) versions.push_back(std::move(v));
        }
        return versions;
    }

    rec::object_finder finder_;
    std::uint64_t learned_ = 0;
};

/// A method, and the probability from which on its objects are decided.
struct method {
    std::string name;
    object_finder find;
    double min_probability = 0.90;
};

std::vector<method> methods_of(const effort& much, std::uint64_t seed) {
    return {{"thesis grouping", thesis_grouping(learned(much, seed))},
            {"voting and verification", voting(much, seed),
             rec::find_objects_options{}.min_probability}};
}

/// The rooms of a seed.
struct room_set {
    const char* name;
    bool touching;
    std::size_t rooms;
};

/// The judgements of one method on one set of rooms, seed by seed.
struct method_row {
    json key;
    std::vector<judgement> seeds;
    std::vector<double> times;  ///< of the processor, all threads, per room [s]
};

json row_of(const method_row& row) {
    json result = row.key;
    const auto add = [&](const char* name, auto&& of) {
        std::vector<double> values;
        for (const judgement& j : row.seeds) values.push_back(of(j));
        result[name] = rounded(median_of(values), 3);
        result[std::string(name) + ", worst"] = rounded(std::ranges::min(values), 3);
    };
    add("accuracy", [](const judgement& j) { return j.accuracy(); });
    add("precision", [](const judgement& j) { return j.precision(); });
    add("recall", [](const judgement& j) { return j.recall(); });
    add("whole", [](const judgement& j) { return j.wholeness(); });
    judgement all;
    for (const judgement& j : row.seeds) all.add(j);
    result["objects"] = all.objects;
    result["decided"] = all.decided;
    result["views"] = all.views;
    if (!all.poses.empty()) {
        result["poses"] = all.poses.size();
        result["within 2 cm and 2 deg"] =
            rounded(static_cast<double>(std::ranges::count_if(all.poses, &pose_error::is_small)) /
                        static_cast<double>(all.poses.size()),
                    3);
        // Of those that are right: no covariance covers a place on the next slat.
        std::vector<double> nees;
        for (const pose_error& e : all.poses)
            if (e.is_small() && e.nees) nees.push_back(*e.nees);
        result["of these determined"] = nees.size();
        if (!nees.empty()) {
            const double sum = std::accumulate(nees.begin(), nees.end(), 0.0);
            result["NEES / dof"] = rounded(sum / static_cast<double>(nees.size()), 1);
            result["NEES / dof, median"] = rounded(median_of(nees), 1);
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
                                {"touching", true, much.quick ? 1u : 10u}},
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
json times_of(const effort& much, const seed_plan& plan) {
    const auto models = sim::furniture_models();
    const voting method(much, plan.learning.front());
    std::vector<double> times;  // [s]
    std::size_t points = 0;
    for (std::size_t r = 0; r < std::min<std::size_t>(20, plan.sets.front().rooms); ++r) {
        const seen_room room = room_of(models, plan.first_room + r, {.duration = 4.0});
        points = std::max(points, room.truth.scan.size());
        const auto start = std::chrono::steady_clock::now();
        (void)method.find(room.truth.scan, gnomon::threads{2});
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        times.push_back(taken.count());
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
    const json times = times_of(much, plan);  // first, while no other thread runs
    std::vector<room_contents> contents(plan.sets.size());
    std::vector<method_row> rows;
    for (std::size_t s = 0; s < plan.learning.size(); ++s) {
        const auto methods = methods_of(much, plan.learning[s]);
        for (std::size_t k = 0; k < plan.sets.size(); ++k) {
            const room_set& set = plan.sets[k];
            const std::size_t first = k * methods.size();
            if (s == 0)
                for (const method& m : methods)
                    rows.push_back({{{"rooms", set.name}, {"method", m.name}}, {}, {}});
            for (std::size_t m = 0; m < methods.size(); ++m) rows[first + m].seeds.emplace_back();
            for (std::size_t r = 0; r < set.rooms; ++r) {
                const double start = processor_time(CLOCK_PROCESS_CPUTIME_ID);
                const seen_room room =
                    room_of(models, plan.first_room + 1000 * s + r, {.touching = set.touching});
                contents[k].times.push_back(processor_time(CLOCK_PROCESS_CPUTIME_ID) - start);
                contents[k].add(room);
                for (std::size_t m = 0; m < methods.size(); ++m) {
                    const double before = processor_time(CLOCK_PROCESS_CPUTIME_ID);
                    auto found = methods[m].find(room.truth.scan);
                    rows[first + m].times.push_back(processor_time(CLOCK_PROCESS_CPUTIME_ID) -
                                                    before);
                    rows[first + m].seeds.back().add(
                        judgement_of(room, std::move(found), headings, methods[m].min_probability));
                }
            }
        }
    }
    json table = json::array(), counts = json::array(), turns = json::array();
    for (const method_row& row : rows) table.push_back(row_of(row));
    for (std::size_t k = 0; k < contents.size(); ++k) {
        counts.push_back(contents[k].row(plan.sets[k].name));
        std::printf("%s\n", counts.back().dump().c_str());
    }
    for (const auto& [name, n] : headings)
        turns.push_back({{"model", name}, {"equal headings", n == 0 ? json("all") : json(n)}});
    return {{"whole rooms", table},
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

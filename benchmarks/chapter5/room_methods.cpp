// SPDX-License-Identifier: BSL-1.0
#include "room_methods.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/plane.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/filters/subset.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/view_augmentation.hpp>
#include <gnomon/simulation/clutter.hpp>
#include <gnomon/simulation/object_views.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace {

/// The recognizer learns all views of a model, and one of three votes: more votes cost time in each
/// room, and more views that do not vote hardly any. Chosen on touching rooms of seeds 101 to 160.
constexpr std::size_t views_per_vote = 3;

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

/// What is seen of an object, and in two versions of its scan of which a part is hidden, as other
/// methods learn.
/// @param number  of the shot, so that no two hide the same
std::vector<rec::view> versions_of(const sim::object_view& shot,
                                   const sim::object_view_options& how, std::uint64_t number) {
    std::vector<rec::view> versions;
    gnomon::random_stream random(~how.seed, number);
    for (int version = 0; version < 3; ++version) {
        gnomon::scan scan = shot.truth.scan;
        if (version > 0)
            scan = gnomon::subset(scan, rec::hide_part(scan, how.sensor.position, random));
        auto seen = rec::perceive_views(scan, {.ground = gnomon::plane{},
                                               .noise = noise_in_rooms,
                                               .gap = rec::infinite_gap,
                                               .min_points = fewest_cells});
        for (rec::view& v : seen.views) versions.push_back(std::move(v));
    }
    return versions;
}

/// Calls learn(view, shot, number of the shot) for the versions of shots, in order.
void learn_shots(const std::vector<sim::object_view>& shots, const sim::object_view_options& how,
                 const auto& learn) {
    std::vector<std::vector<rec::view>> versions(shots.size());
    gnomon::threads{}(shots.size(),
                      [&](std::size_t i) { versions[i] = versions_of(shots[i], how, i); });
    for (std::size_t i = 0; i < shots.size(); ++i)
        for (const rec::view& v : versions[i]) learn(v, shots[i], i);
}

}  // namespace

room_method thesis_grouping(const effort& much, std::uint64_t seed) {
    return [model = learned(much, seed)](const gnomon::scan& scan) {
        const auto seen = rec::perceive_views(
            scan, {.noise = noise_in_rooms, .divergence = wide_beam}, gnomon::threads{});
        std::vector<found_object> found;
        for (std::size_t v = 0; v < seen.views.size(); ++v) {
            const rec::decision d = model.decide(seen.views[v]);
            found.push_back({.name = model.names()[d.best],
                             .probability = d.probability[d.best],
                             .points = {seen.groups[v].begin(), seen.groups[v].end()}});
        }
        return found;
    };
}

rec::object_finder finder_of(const effort& much, std::uint64_t seed) {
    constexpr double spacing = 0.02;  // of samples of surfaces [m]
    rec::object_finder finder;
    const auto models = sim::furniture_models();
    for (const sim::furniture_model& model : models) {
        const auto samples = sim::sample_surface(model, {.spacing = spacing});
        finder.add(model.name, rec::surface_model(samples, samples, spacing, std::nullopt,
                                                  &sim::surface_sample::position));
    }
    const std::size_t n = views_per_vote * views_per_model(much);
    sim::object_view_options how{.beam = {.sigma = room_kind{}.sigma}, .seed = seed};
    learn_shots(sim::simulate_object_views(models, n, how, gnomon::threads{}), how,
                [&](const rec::view& v, const sim::object_view& shot, std::size_t number) {
                    if (number % views_per_vote == 0)
                        finder.learn(v, shot.pose, shot.model);
                    else
                        finder.learn(v, shot.model);
                });
    how.seed += 100'000;  // as for the other method
    learn_shots(sim::simulate_object_views(sim::clutter_models(background_pieces, seed),
                                           views_of_background(n), how, gnomon::threads{}),
                how, [&](const rec::view& v, const sim::object_view&, std::size_t) {
                    finder.learn_background(v);
                });
    finder.fit(gnomon::threads{});
    return finder;
}

rec::found_objects objects_in(const gnomon::scan& scan, const rec::object_finder& finder,
                              const gnomon::threads& run) {
    return finder(scan, how_rooms_are_seen, run);
}

room_method voting(const rec::object_finder& finder) {
    return [&finder](const gnomon::scan& scan) {
        const auto result = objects_in(scan, finder, gnomon::threads{});
        std::vector<found_object> found;
        for (std::size_t i = 0; i < result.objects.size(); ++i) {
            const rec::found_object& o = result.objects[i];
            found.push_back({.name = finder.names()[o.object],
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
    };
}

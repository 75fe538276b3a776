// SPDX-License-Identifier: BSL-1.0
// What is in this room that was never learned, and how often?
#include <cstddef>
#include <cstdio>
#include <utility>
#include <vector>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition.hpp>
#include <gnomon/simulation.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

std::vector<rec::view> views_of_model(const sim::furniture_model& model, std::size_t count,
                                      std::uint64_t seed) {
    std::vector<rec::view> views;
    const sim::object_view_options how{.scanner = {.resolution = gnomon::degrees(0.5)},
                                       .seed = seed};
    for (std::size_t v = 0; v < count; ++v) {
        const auto shot = sim::simulate_object_view(model, v, how);
        const auto seen =
            rec::perceive_views(shot.truth.scan, {.ground = gnomon::plane{},
                                                  .noise = gnomon::constant_noise{0.005},
                                                  .gap = rec::infinite_gap});
        if (!seen.views.empty()) views.push_back(seen.views.front());
    }
    return views;
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv,
                     "Groups views of furniture that was never learned, and adds it to a model."))
        return 0;
    const auto models = sim::furniture_models();
    const std::size_t desk = 9, armchair = 5;  // these are unknown at first
    rec::object_recognizer model;
    for (std::size_t m = 0; m < models.size(); ++m)
        if (m != desk && m != armchair)
            for (const rec::view& v : views_of_model(models[m], 12, 1))
                model.learn(v, models[m].name);
    model.fit(gnomon::threads{});
    std::vector<rec::view> views;
    for (const std::size_t m : {desk, armchair, std::size_t{0}})
        for (rec::view& v : views_of_model(models[m], 8, 2)) views.push_back(std::move(v));

    // [unknown]
    const rec::view_novelty novelty(model, gnomon::threads{});
    std::vector<rec::view> unknown;
    for (const rec::view& v : views)
        if (novelty(v) > 0.95) unknown.push_back(v);  // more novel than 95 % of the learned views

    const std::vector<std::size_t> group = novelty.groups_of(unknown);
    for (std::size_t i = 0; i < unknown.size(); ++i)
        if (group[i] == 0) model.learn(unknown[i], "what I call it");
    model.fit(gnomon::threads{});
    // [unknown]
    std::size_t groups = 0, named = 0;
    for (const std::size_t g : group) groups = g >= groups ? g + 1 : groups;
    for (const rec::view& v : views_of_model(models[desk], 8, 3))
        named += model.names()[model.decide(v).best] == "what I call it" ? 1 : 0;
    std::printf(
        "%zu of %zu views are unknown, in %zu groups; %zu of 8 fresh views have the new name\n",
        unknown.size(), views.size(), groups, named);
}

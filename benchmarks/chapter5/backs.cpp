// SPDX-License-Identifier: BSL-1.0
// Models that differ in the place of their backs only: the same seat on the same legs, and the same
// board above it, so that only relations of parts
// distinguish them.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_kernels.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/word_histograms.hpp>
#include <gnomon/simulation/box.hpp>

namespace {

/// A chair whose back is a board on two thin posts, so that seat and board look the same wherever
/// it stands.
sim::furniture_model chair_with_back_at(const std::string& name, double x, double y) {
    sim::scene world;
    const std::int32_t object = world.add_object(name);
    const auto block = [&](const char* part, Eigen::Vector3d size, Eigen::Vector3d middle) {
        world.add(world.add_part(object, part), sim::box{size.x(), size.y(), size.z()},
                  sim::at(middle.x(), middle.y(), middle.z()));
    };
    block("seat", {0.42, 0.42, 0.04}, {0.0, 0.0, 0.43});
    for (const double side : {-0.19, 0.19}) {
        for (const double end : {-0.19, 0.19}) block("leg", {0.04, 0.04, 0.41}, {end, side, 0.205});
        block("post", {0.015, 0.015, 0.12}, {x, y + 0.8 * side, 0.51});
    }
    block("back", {0.03, 0.42, 0.33}, {x, y, 0.735});
    return {name, world};
}

std::vector<sim::furniture_model> models() {
    constexpr double rear = -0.195;
    return {chair_with_back_at("at the rear edge", rear, 0.0),
            chair_with_back_at("8 cm inwards", rear + 0.08, 0.0),
            chair_with_back_at("16 cm inwards", rear + 0.16, 0.0),
            chair_with_back_at("12 cm to the side", rear, 0.12)};
}

void add_seed(outcomes_by_row& rows, const effort& much, std::uint64_t seed) {
    const auto all = models();
    const auto names = names_of(all);
    // The number of views in all is that of the twelve models. Seats that are farther are two scan
    // lines.
    const std::size_t n = 3 * views_per_model(much);
    constexpr view_kind near{.farthest = 3.0};
    const scan_set scans = scans_of(all, n, near, seed, purpose::learning),
                   tests = scans_of(all, n, near, seed, purpose::test);
    const view_set training = views_of(with_hidden_parts(scans, seed)), seen = views_of(tests);
    const auto add = [&](const char* mode, bool has_relations, outcomes found) {
        rows.add({{"mode", mode}, {"relations", has_relations}}, std::move(found));
    };
    const auto add_default = [&](const char* mode, bool has_profile) {
        const auto run = [&](bool has_relations, auto model) {
            learn(model, training, names);
            add(mode, has_relations,
                outcomes_of(seen, [&](const rec::view& v) { return model.decide(v); }));
        };
        run(true,
            rec::object_recognizer({}, rec::default_features, rec::default_relations, has_profile));
        run(false,
            rec::object_recognizer({}, rec::default_features, rec::no_relations, has_profile));
    };
    add_default("default", true);
    add_default("default, without height profile", false);

    const view_set once = views_of(scans);
    const rec::part_kernels soft(once.views, once.classes, names.size(), rec::default_features,
                                 rec::default_relations);
    add("soft words", true, outcomes_of(soft, seen, soft.temperature()));
    const rec::part_kernels alone(once.views, once.classes, names.size(), rec::default_features,
                                  rec::no_relations, {.pair_weight = 0.0});
    add("soft words", false, outcomes_of(alone, seen, alone.temperature()));

    const auto add_thesis = [&](const char* mode, const density& how,
                                const rec::word_histogram_options& options) {
        const view_set examples = views_of(scans, how), test = views_of(tests, how);
        const auto features = rec::scaled_by_largest(rec::thesis_features, examples.views);
        const rec::word_histograms with(examples.views, examples.classes, names.size(), features,
                                        rec::thesis_relations, options);
        add(mode, true, outcomes_of(with, test, 1.0));
        const rec::word_histograms without(examples.views, examples.classes, names.size(), features,
                                           rec::no_relations, options);
        add(mode, false, outcomes_of(without, test, 1.0));
    };
    add_thesis("thesis, as printed", thesis_density, {});
    add_thesis("thesis, repaired", repaired_density, {.counts_absence = true});
}

json measure(const effort& much) {
    outcomes_by_row rows;
    for (std::uint64_t s = 0; s < much.seeds(); ++s) add_seed(rows, much, first_seed + s);
    return {{"models that differ in their backs", rows.table(usual_measures())}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

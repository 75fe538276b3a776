// SPDX-License-Identifier: BSL-1.0
// Skimmed points, Sec. 5.8.4: a beam of 10 mrad that hits two surfaces returns a range between
// them. Recognition of such scans that has learned scans by thin beams, or such scans, too; and
// that knows the width of the beam, and leaves out what it returns at silhouettes.
#include <cstddef>
#include <cstdint>
#include <utility>

#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/word_histograms.hpp>

namespace {

constexpr view_kind thin{}, wide{.skims = true};

/// Both sets, of the same number of versions, one after the other.
view_set joined(view_set a, const view_set& b) {
    a.views.insert(a.views.end(), b.views.begin(), b.views.end());
    a.classes.insert(a.classes.end(), b.classes.begin(), b.classes.end());
    a.parts.insert(a.parts.end(), b.parts.begin(), b.parts.end());
    return a;
}

void add_seed(outcomes_by_row& rows, const effort& much, std::uint64_t seed) {
    const auto models = sim::furniture_models();
    const auto names = names_of(models);
    const std::size_t n = views_per_model(much);
    const scan_set thin_scans = scans_of(models, n, thin, seed, purpose::learning),
                   wide_scans = scans_of(models, n, wide, seed, purpose::learning),
                   thin_tests = scans_of(models, n, thin, seed, purpose::test),
                   wide_tests = scans_of(models, n, wide, seed, purpose::test);

    const auto add = [&](const char* mode, const char* trained, const char* tested,
                         outcomes found) {
        rows.add({{"mode", mode}, {"learned", trained}, {"tested", tested}}, std::move(found));
    };

    const view_set thin_seen = views_of(thin_tests), wide_seen = views_of(wide_tests);
    scan_set narrowed = wide_tests;
    narrowed.divergence = wide_beam;
    const view_set narrowed_seen = views_of(narrowed);
    const auto add_default = [&](const char* trained, const view_set& training) {
        rec::object_recognizer model;
        learn(model, training, names);
        const auto decide = [&](const rec::view& v) { return model.decide(v); };
        add("default", trained, "thin", outcomes_of(thin_seen, decide));
        add("default", trained, "skimmed", outcomes_of(wide_seen, decide));
        add("default", trained, "skimmed, width given", outcomes_of(narrowed_seen, decide));
    };
    const view_set with_thin = views_of(with_hidden_parts(thin_scans, seed));
    const view_set with_wide = views_of(with_hidden_parts(wide_scans, seed));
    add_default("thin", with_thin);
    add_default("thin and skimmed", joined(with_thin, with_wide));

    const view_set thin50 = views_of(thin_tests, thesis_density),
                   wide50 = views_of(wide_tests, thesis_density);
    const auto add_thesis = [&](const char* trained, const view_set& training) {
        const rec::word_histograms thesis(
            training.views, training.classes, names.size(),
            rec::scaled_by_largest(rec::thesis_features, training.views), rec::thesis_relations);
        add("thesis", trained, "thin", outcomes_of(thesis, thin50, 1.0));
        add("thesis", trained, "skimmed", outcomes_of(thesis, wide50, 1.0));
    };
    const view_set thin_training = views_of(thin_scans, thesis_density),
                   wide_training = views_of(wide_scans, thesis_density);
    add_thesis("thin", thin_training);
    add_thesis("thin and skimmed", joined(thin_training, wide_training));
}

json measure(const effort& much) {
    outcomes_by_row rows;
    for (std::uint64_t s = 0; s < much.seeds(); ++s) add_seed(rows, much, first_seed + s);
    return {{"skimmed points", rows.table(usual_measures())}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

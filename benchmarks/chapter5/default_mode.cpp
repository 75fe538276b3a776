// SPDX-License-Identifier: BSL-1.0
// The recommended mode, object_recognizer, compared with soft words: fresh views of known models,
// the meaning of their probabilities, what its pieces contribute, and times.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_kernels.hpp>
#include <gnomon/recognition/part_relation.hpp>

namespace {

struct named_kind {
    const char* name;
    view_kind kind;
};

const std::vector<named_kind> kinds{
    {"8 s, 5 mm", {}},
    {"4 s, 5 mm", {.duration = 4.0}},
    {"8 s, 15 mm", {.sigma = 0.015}},
    {"8 s, 5 mm, half occluded", {.occluded_share = 0.5}},
};

/// The first version of each view.
view_set unhidden(const view_set& training) {
    view_set first;
    for (std::size_t i = 0; i < training.views.size(); i += training.versions) {
        first.views.push_back(training.views[i]);
        first.classes.push_back(training.classes[i]);
    }
    return first;
}

class study {
  public:
    explicit study(const effort& much) : much_(much) {
        for (std::uint64_t s = 0; s < much.seeds(); ++s) add_seed(first_seed + s);
    }

    json tables() {
        auto measures = usual_measures();
        measures.push_back(calibration_measure());
        json all{{"fresh views", views_.table(measures)}};
        all["precision and missed views by P_d"] = by_probability();
        const std::vector<measure_by_seed> some{measures[0], measures[1], measures[2], measures[3]};
        all["without one of its pieces, all seeds together"] = ablation_.pooled(some);
        all["evidence"] = evidence();
        all["learning"] = learning_;
        all["decisions"] = decisions();
        return all;
    }

  private:
    void add_seed(std::uint64_t seed) {
        const auto models = sim::furniture_models();
        const auto names = names_of(models);
        const std::size_t n = views_per_model(much_);
        const double begin = wall_time(), work = processor_time(CLOCK_PROCESS_CPUTIME_ID);
        const scan_set scans = scans_of(models, n, {}, seed, purpose::learning);
        const double simulated = wall_time();
        const view_set training = views_of(with_hidden_parts(scans, seed));
        const double perceived = wall_time();
        rec::object_recognizer model;
        learn(model, training, names);
        const double end = wall_time(), worked = processor_time(CLOCK_PROCESS_CPUTIME_ID) - work;
        learning_.push_back({{"seed", seed},
                             {"views", scans.scans.size()},
                             {"simulated [s]", rounded(simulated - begin, 1)},
                             {"perceived [s]", rounded(perceived - simulated, 1)},
                             {"learned [s]", rounded(end - perceived, 1)},
                             {"all [s]", rounded(end - begin, 1)},
                             {"time of the processor [s]", rounded(worked, 1)},
                             {"temperature", rounded(model.learned().temperature, 2)}});
        std::printf("%s\n", learning_.back().dump().c_str());

        const view_set once = unhidden(training);
        const rec::part_kernels soft(once.views, once.classes, names.size(), rec::default_features,
                                     rec::default_relations);
        rec::object_recognizer no_relations({}, rec::default_features, rec::no_relations);
        learn(no_relations, training, names);
        rec::object_recognizer no_profile({}, rec::default_features, rec::default_relations, false);
        learn(no_profile, training, names);
        rec::object_recognizer parts_alone({}, rec::default_features, rec::no_relations, false);
        learn(parts_alone, training, names);
        rec::object_recognizer nothing_hidden;
        learn(nothing_hidden, once, names);
        const rec::part_kernels soft_parts(once.views, once.classes, names.size(),
                                           rec::default_features, rec::no_relations,
                                           {.pair_weight = 0.0});
        const rec::part_kernels soft_uncounted(once.views, once.classes, names.size(),
                                               rec::default_features, rec::no_relations,
                                               {.pair_weight = 0.0, .counts_parts = false});

        for (const auto& [name, kind] : kinds) {
            const scan_set tests = scans_of(models, n, kind, seed, purpose::test);
            const view_set seen = views_of(tests);
            const auto explained = [&](const auto& m) {
                return outcomes_of(seen, [&](const rec::view& v) { return m.explain(v); });
            };
            const auto decided = [&](const auto& m) {
                return outcomes_of(seen, [&](const rec::view& v) { return m.decide(v); });
            };
            const outcomes of_default = explained(model);
            const outcomes of_soft = outcomes_of(soft, seen, soft.temperature());
            views_.add({{"views", name}, {"mode", "default"}}, of_default);
            views_.add({{"views", name}, {"mode", "soft words"}}, of_soft);
            const auto ablated = [&](const char* mode, const char* without, outcomes found) {
                ablation_.add({{"views", name}, {"mode", mode}, {"without", without}},
                              std::move(found));
            };
            ablated("default", "-", of_default);
            ablated("default", "relations", decided(no_relations));
            ablated("default", "height profile", decided(no_profile));
            ablated("default", "relations and height profile", decided(parts_alone));
            ablated("default", "hidden parts in training", decided(nothing_hidden));
            ablated("soft words", "-", of_soft);
            ablated("soft words", "pairs", outcomes_of(soft_parts, seen, soft_parts.temperature()));
            ablated("soft words", "pairs and number of parts",
                    outcomes_of(soft_uncounted, seen, soft_uncounted.temperature()));
            if (kind.duration == 8.0 && kind.sigma == 0.005 && kind.occluded_share == 0.0)
                add_times(model, tests, seen);
        }
    }

    void add_times(const rec::object_recognizer<>& model, const scan_set& tests,
                   const view_set& seen) {
        for (std::size_t i = 0; i < tests.scans.size(); ++i) {
            const double start = processor_time();
            const auto d = model.decide(seen.views[i]);
            const double decided = processor_time();
            const auto e = model.explain(seen.views[i]);
            const double explained = processor_time();
            decide_.push_back(decided - start);
            explain_.push_back(explained - decided);
            parts_ += static_cast<double>(seen.views[i].parts.size());
            if (e.best != d.best) std::printf("decide and explain differ\n");
            const std::size_t points = tests.scans[i].size();
            if (points < 1'900 || points > 2'100) continue;
            const double begin = processor_time();
            const auto whole = model.decide(view_of(tests.scans[i], tests.sigma));
            whole_.push_back(processor_time() - begin);
            if (whole.best != d.best) std::printf("a view differs from itself\n");
        }
    }

    json by_probability() const {
        json rows = json::array();
        for (const auto& [key, seeds] : views_.rows()) {
            if (key.at("mode") != "default") continue;
            for (const double p : {0.0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99}) {
                std::vector<double> precision, missed;
                for (const outcomes& o : seeds) {
                    precision.push_back(o.precision(p));
                    missed.push_back(o.missed(p));
                }
                rows.push_back({{"views", key.at("views")},
                                {"P_d", p},
                                {"precision", rounded(median_of(precision), 3)},
                                {"missed", rounded(median_of(missed), 3)}});
            }
        }
        return rows;
    }

    /// The largest difference of the sum of the evidence from the log-ratio.
    json evidence() const {
        json rows = json::array();
        for (const char* mode : {"default", "soft words"}) {
            double largest = 0.0;
            for (const auto& [key, seeds] : views_.rows()) {
                if (key.at("mode") != mode) continue;
                for (const outcomes& o : seeds) largest = std::max(largest, o.evidence_error());
            }
            char text[32];
            std::snprintf(text, sizeof text, "%.1e", largest);
            rows.push_back({{"mode", mode}, {"largest error of the sum", text}});
        }
        return rows;
    }

    json decisions() const {
        const auto row = [](const char* what, std::vector<double> t) {
            std::ranges::sort(t);
            const std::size_t n = t.size();
            return json{{"from", what},
                        {"views", n},
                        {"median [ms]", n > 0 ? rounded(1e3 * t[n / 2], 3) : 0.0},
                        {"95 % below [ms]", n > 0 ? rounded(1e3 * t[(95 * n) / 100], 3) : 0.0}};
        };
        return json::array({row("segments", decide_), row("segments, with evidence", explain_),
                            row("1,900 to 2,100 points", whole_)});
    }

    effort much_;
    outcomes_by_row views_, ablation_;
    json learning_ = json::array();
    std::vector<double> decide_, explain_, whole_;
    double parts_ = 0.0;
};

json measure(const effort& much) { return study(much).tables(); }

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

// SPDX-License-Identifier: BSL-1.0
// What was not learned. Two of the models at a time are withheld: are their views novel, and do
// groups of novel views stand for models? And fallen furniture, by features that need no ground.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/view_novelty.hpp>

namespace {

/// -sum p log p of counts, by their key.
double entropy(const auto& counts, double n) {
    double sum = 0.0;
    for (const auto& [key, count] : counts) sum -= count / n * std::log(count / n);
    return sum;
}

/// Of a grouping: the harmonic mean of homogeneity and completeness (Rosenberg and Hirschberg
/// 2007); 1 if groups are the classes.
double v_measure(const std::vector<std::size_t>& classes, const std::vector<std::size_t>& groups) {
    std::map<std::size_t, double> by_class, by_group;
    std::map<std::pair<std::size_t, std::size_t>, double> both;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        by_class[classes[i]] += 1.0;
        by_group[groups[i]] += 1.0;
        both[{classes[i], groups[i]}] += 1.0;
    }
    const auto n = static_cast<double>(classes.size());
    const double of_classes = entropy(by_class, n), of_groups = entropy(by_group, n),
                 joint = entropy(both, n);
    const double homogeneity = of_classes > 0.0 ? 1.0 - (joint - of_groups) / of_classes : 1.0,
                 completeness = of_groups > 0.0 ? 1.0 - (joint - of_classes) / of_groups : 1.0;
    const double sum = homogeneity + completeness;
    return sum > 0.0 ? 2.0 * homogeneity * completeness / sum : 0.0;
}

/// What two withheld models show.
struct withheld {
    double area = 0.0, rejected_known = 0.0, rejected_novel = 0.0, v_measure = 0.0;
    std::size_t groups = 0;
};

withheld without(const std::array<std::size_t, 2>& two, const view_set& training,
                 const view_set& tests, const std::vector<std::string>& names) {
    const auto is_novel = [&](std::size_t c) { return c == two[0] || c == two[1]; };
    view_set learned;
    learned.versions = training.versions;
    for (std::size_t i = 0; i < training.views.size(); ++i) {
        if (is_novel(training.classes[i])) continue;
        learned.views.push_back(training.views[i]);
        learned.classes.push_back(training.classes[i]);
    }
    rec::object_recognizer model;
    learn(model, learned, names);
    const rec::view_novelty novelty(std::move(model), gnomon::threads{});
    constexpr double rejected_share = 0.05;  // of known views
    std::vector<double> known, novel;
    std::vector<rec::view> rejected;
    std::vector<std::size_t> classes;
    withheld result;
    for (std::size_t i = 0; i < tests.views.size(); ++i) {
        const bool is_new = is_novel(tests.classes[i]);
        const double x = novelty(tests.views[i]);
        (is_new ? novel : known).push_back(x);
        if (!(x > 1.0 - rejected_share)) continue;
        (is_new ? result.rejected_novel : result.rejected_known) += 1.0;
        rejected.push_back(tests.views[i]);
        classes.push_back(tests.classes[i]);
    }
    result.area = probability_of_less(known, novel);
    result.rejected_known /= static_cast<double>(known.size());
    result.rejected_novel /= static_cast<double>(novel.size());
    const auto groups = novelty.groups_of(rejected);
    result.v_measure = v_measure(classes, groups);
    result.groups = std::set(groups.begin(), groups.end()).size();
    return result;
}

/// All models in random pairs, each withheld once.
std::vector<std::array<std::size_t, 2>> pairs_of(std::size_t n, std::uint64_t seed) {
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    gnomon::random_stream random(seed);
    for (std::size_t i = n; i > 1; --i) {
        const auto j = static_cast<std::size_t>(random.uniform() * static_cast<double>(i));
        std::swap(order[i - 1], order[j]);
    }
    std::vector<std::array<std::size_t, 2>> pairs;
    for (std::size_t i = 0; i + 1 < n; i += 2) pairs.push_back({order[i], order[i + 1]});
    return pairs;
}

/// The model on its back, its front, or one of its sides, on the ground.
sim::furniture_model fallen(const sim::furniture_model& model, std::size_t side) {
    const gnomon::angle quarter = gnomon::degrees(side % 2 == 0 ? 90.0 : -90.0);
    const sim::pose turned = side < 2 ? sim::pitch(quarter) : sim::roll(quarter);
    sim::scene lying;
    sim::add(lying, model, turned);
    sim::scene resting;
    sim::add(resting, model, sim::at(0.0, 0.0, -lying.extent().low.z()) * turned);
    return {model.name, resting};
}

/// Views of models that lie on any of four sides, the same number on each.
view_set fallen_views(const std::vector<sim::furniture_model>& models, std::size_t views,
                      std::uint64_t seed, purpose use, bool hides_parts) {
    view_set all;
    constexpr std::size_t sides = 4;
    for (std::size_t side = 0; side < sides; ++side) {
        std::vector<sim::furniture_model> lying;
        for (const auto& m : models) lying.push_back(fallen(m, side));
        const std::uint64_t other_seed = sides * seed + side;
        const scan_set scans = scans_of(lying, views / sides, {}, other_seed, use);
        const view_set seen = views_of(hides_parts ? with_hidden_parts(scans, other_seed) : scans);
        all.views.insert(all.views.end(), seen.views.begin(), seen.views.end());
        all.classes.insert(all.classes.end(), seen.classes.begin(), seen.classes.end());
        all.versions = seen.versions;
    }
    return all;
}

/// What views are called: by their model, or by its class.
struct naming {
    const char* what;
    std::vector<std::string> names;
    std::vector<std::uint32_t> of_model;

    [[nodiscard]] view_set operator()(view_set views) const {
        for (std::uint32_t& c : views.classes) c = of_model[c];
        return views;
    }
};

bool is_chair(const std::string& model) {
    return model.find("chair") != std::string::npos || model == "carver";
}

std::array<naming, 2> both_namings(const std::vector<std::string>& models) {
    naming by_model{"models", models, {}}, by_class{"classes", {"chair", "stool", "table"}, {}};
    for (std::uint32_t m = 0; m < models.size(); ++m) {
        by_model.of_model.push_back(m);
        by_class.of_model.push_back(is_chair(models[m]) ? 0 : models[m] == "stool" ? 1 : 2);
    }
    return {by_model, by_class};
}

/// How fallen furniture is recognized by a model that learned it upright, and also fallen.
class fallen_study {
  public:
    void add(const view_set& upright, std::size_t views, std::uint64_t seed,
             const std::vector<sim::furniture_model>& models) {
        const auto names = names_of(models);
        const view_set also = fallen_views(models, views, seed, purpose::learning, true);
        const view_set tests = fallen_views(models, views, seed, purpose::test, false);
        const rec::object_recognizer invariant({}, rec::invariant_features, rec::default_relations,
                                               false);
        for (const naming& how : both_namings(names)) {
            const auto run = [&](const char* learned, const char* features, auto model,
                                 const std::vector<const view_set*>& examples) {
                for (const view_set* e : examples) learn_views(model, how(*e), how.names);
                model.fit(gnomon::threads{});
                const outcomes all =
                    outcomes_of(how(tests), [&](const rec::view& v) { return model.decide(v); });
                outcomes chairs;
                for (std::size_t i = 0; i < all.all.size(); ++i)
                    if (is_chair(names[tests.classes[i]])) chairs.all.push_back(all.all[i]);
                const json key{{"learned", learned}, {"features", features}, {"names", how.what}};
                add_rows(key, all, std::move(chairs));
            };
            run("upright", "default", rec::object_recognizer<>(), {&upright});
            run("upright", "invariant", invariant, {&upright});
            run("upright and fallen", "default", rec::object_recognizer<>(), {&upright, &also});
            run("upright and fallen", "invariant", invariant, {&upright, &also});
        }
    }

    [[nodiscard]] json table() const { return rows_.table(usual_measures()); }

  private:
    void add_rows(json key, outcomes all, outcomes chairs) {
        key["views"] = "all";
        rows_.add(key, std::move(all));
        key["views"] = "of chairs";
        rows_.add(key, std::move(chairs));
    }

    outcomes_by_row rows_;
};

json measure(const effort& much) {
    const auto models = sim::furniture_models();
    const auto names = names_of(models);
    const std::size_t n = views_per_model(much);
    json novelty = json::array(), pairs = json::array();
    fallen_study lying;
    for (std::uint64_t seed = first_seed; seed < first_seed + much.seeds(); ++seed) {
        const view_set training =
            views_of(with_hidden_parts(scans_of(models, n, {}, seed, purpose::learning), seed));
        const view_set tests = views_of(scans_of(models, n, {}, seed, purpose::test));
        std::vector<withheld> found;
        for (const auto& two : pairs_of(models.size(), seed)) {
            found.push_back(without(two, training, tests, names));
            const withheld& w = found.back();
            pairs.push_back({{"seed", seed},
                             {"withheld", names[two[0]] + ", " + names[two[1]]},
                             {"AUROC", rounded(w.area, 3)},
                             {"known views rejected", rounded(w.rejected_known, 3)},
                             {"novel views rejected", rounded(w.rejected_novel, 3)},
                             {"groups", w.groups},
                             {"V-measure", rounded(w.v_measure, 3)}});
            std::printf("%s\n", pairs.back().dump().c_str());
            std::fflush(stdout);
        }
        const auto mean = [&](double withheld::*value) {
            double sum = 0.0;
            for (const withheld& w : found) sum += w.*value;
            return rounded(sum / static_cast<double>(found.size()), 3);
        };
        novelty.push_back({{"seed", seed},
                           {"AUROC", mean(&withheld::area)},
                           {"known views rejected", mean(&withheld::rejected_known)},
                           {"novel views rejected", mean(&withheld::rejected_novel)},
                           {"V-measure", mean(&withheld::v_measure)}});

        lying.add(training, n, seed, models);
    }
    return {{"two models withheld, means of six pairs", novelty},
            {"pairs", pairs},
            {"fallen furniture", lying.table()}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

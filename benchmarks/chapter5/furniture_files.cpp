// SPDX-License-Identifier: BSL-1.0
// Furniture from mesh files: chairs, tables, and other furniture. Models that were never seen, by
// leaving out a fifth of the models at a time, and fresh views of models that were learned.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "furniture_classes.hpp"
#include "outcomes.hpp"
#include "views.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/object_recognizer.hpp>

namespace {

constexpr std::array<const char*, 3> class_names{"chair", "table", "other"};
using furniture::class_of;
using enum furniture::class_number;

/// Of each model, the fold in which it is left out: models of a class are in all folds alike, in a
/// random order.
constexpr std::size_t folds = 5;
std::vector<std::size_t> folds_of(const std::vector<sim::furniture_model>& models,
                                  std::uint64_t seed) {
    gnomon::random_stream random(seed, 77);
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for (std::size_t m = 0; m < models.size(); ++m) order.emplace_back(random.bits(), m);
    std::ranges::sort(order);
    std::vector<std::size_t> fold(models.size());
    std::size_t next = 0;
    for (std::uint32_t c = 0; c < classes; ++c)
        for (const auto& [key, m] : order)
            if (class_of(models[m].name) == c) fold[m] = next++ % folds;
    return fold;
}

/// The class of a decision whose classes are models or classes: the sum of their probabilities.
outcome class_outcome(const rec::decision& d, const rec::view& v,
                      const std::vector<std::uint32_t>& class_of_name, std::uint32_t truth,
                      std::size_t number_of_classes) {
    std::array<double, classes> p{};
    for (std::size_t i = 0; i < class_of_name.size(); ++i) p[class_of_name[i]] += d.probability[i];
    double sum = 0.0;
    for (std::size_t c = 0; c < number_of_classes; ++c) sum += p[c];
    const auto best = static_cast<std::size_t>(
        std::max_element(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(number_of_classes)) -
        p.begin());
    return {.probability = p[best] / sum,
            .is_right = best == truth,
            .has_parts = !v.parts.empty(),
            .best = best,
            .truth = truth};
}

class study {
  public:
    study(const effort& much, std::vector<sim::furniture_model> models)
        : much_(much), models_(std::move(models)), names_(names_of(models_)) {
        for (const std::string& name : names_) class_of_model_.push_back(class_of(name));
        for (std::uint64_t s = 0; s < much.seeds(); ++s) add_seed(first_seed + s);
    }

    json tables() const {
        json models = json::array();
        for (std::uint32_t c = 0; c < classes; ++c) {
            std::string list;
            for (std::size_t m = 0; m < names_.size(); ++m)
                if (class_of_model_[m] == c) list += (list.empty() ? "" : ", ") + names_[m];
            models.push_back({{"class", class_names[c]}, {"models", list}});
        }
        return {{"files", models},
                {"models that were never seen", unseen_.table(usual_measures())},
                {"never seen, by model", by_model()},
                {"fresh views of known models", known_.table(usual_measures())}};
    }

  private:
    void add_seed(std::uint64_t seed) {
        const std::size_t n = much_.quick ? 2 : 40;
        const scan_set scans = scans_of(models_, n, {}, seed, purpose::learning);
        const view_set training = views_of(with_hidden_parts(scans, seed));
        const view_set tests = views_of(scans_of(models_, n, {}, seed, purpose::test));
        leave_models_out(seed, training, tests);

        rec::object_recognizer model;
        learn(model, training, names_);
        known_.add({{"answer", "model"}},
                   outcomes_of(tests, [&](const rec::view& v) { return model.decide(v); }));
        outcomes of_class{std::vector<outcome>(tests.views.size())};
        for (std::size_t i = 0; i < tests.views.size(); ++i) {
            const rec::view& v = tests.views[i];
            of_class.all[i] = class_outcome(model.decide(v), v, class_of_model_,
                                            class_of_model_[tests.classes[i]], classes);
        }
        known_.add({{"answer", "class"}}, of_class);
    }

    void leave_models_out(std::uint64_t seed, const view_set& training, const view_set& tests) {
        const auto fold_of = folds_of(models_, seed);
        for (const bool learns_models : {false, true}) {
            outcomes three, two;
            for (std::size_t fold = 0; fold < (much_.quick ? 1 : folds); ++fold) {
                rec::object_recognizer model;
                for (std::size_t i = 0; i < training.views.size(); i += training.versions) {
                    const std::uint32_t m = training.classes[i];
                    if (fold_of[m] == fold) continue;
                    model.learn({training.views.data() + i, training.versions},
                                learns_models ? names_[m] : class_names[class_of_model_[m]]);
                }
                model.fit(gnomon::threads{});
                std::vector<std::uint32_t> class_of_name;
                for (const std::string& name : model.names())
                    class_of_name.push_back(learns_models ? class_of(name) : number_of(name));
                for (std::size_t i = 0; i < tests.views.size(); ++i) {
                    const std::uint32_t m = tests.classes[i];
                    if (fold_of[m] != fold) continue;
                    const rec::view& v = tests.views[i];
                    const auto d = model.decide(v);
                    const std::uint32_t truth = class_of_model_[m];
                    three.all.push_back(class_outcome(d, v, class_of_name, truth, classes));
                    if (truth != other)
                        two.all.push_back(class_outcome(d, v, class_of_name, truth, 2));
                    if (!learns_models) {
                        by_model_[m].all.push_back(three.all.back());
                    }
                }
            }
            const char* learned = learns_models ? "models" : "classes";
            unseen_.add({{"learned", learned}, {"answer", "chair, table, other"}}, three);
            unseen_.add({{"learned", learned}, {"answer", "chair, table"}}, two);
        }
    }

    [[nodiscard]] static std::uint32_t number_of(const std::string& name) {
        return static_cast<std::uint32_t>(std::ranges::find(class_names, name) -
                                          class_names.begin());
    }

    json by_model() const {
        json rows = json::array();
        for (const auto& [m, found] : by_model_) {
            rows.push_back({{"model", names_[m]},
                            {"top 1", rounded(found.top1(), 3)},
                            {"right", rounded(found.right(), 3)}});
        }
        return rows;
    }

    effort much_;
    std::vector<sim::furniture_model> models_;
    std::vector<std::string> names_;
    std::vector<std::uint32_t> class_of_model_;
    outcomes_by_row unseen_, known_;
    std::map<std::uint32_t, outcomes> by_model_;
};

json measure(const effort& much) {
    const std::string folder = std::string(CHAPTER5_DATA) + "/furniture";
    if (!furniture::is_there(folder)) return json::object();
    return study(much, furniture::read_all(folder)).tables();
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

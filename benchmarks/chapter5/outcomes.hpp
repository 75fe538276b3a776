// SPDX-License-Identifier: BSL-1.0
/// @file
/// How recognition is tested. A view is decided if the probability of the best class is P_d or
/// more; views without parts are not decided, and never dropped. Precision is the share of right
/// ones of the decided, missed the share of undecided ones, and right that of the right and
/// decided, of all views.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "../chapter4/record.hpp"
#include "views.hpp"
#include <gnomon/recognition/calibration.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/posterior.hpp>

/// The views of each model, to learn and in each set to test.
[[nodiscard]] inline std::size_t views_per_model(const effort& much) { return much.quick ? 4 : 40; }

/// P_d of the thesis, Sec. 5.6.3, and the share of undecided views that it has there.
inline constexpr double usual_probability = 0.90, thesis_missed = 0.304;

/// The decision on one view.
struct outcome {
    double probability = 0.0;  ///< of the best class
    bool is_right = false;     ///< whether that is the true one
    bool has_parts = false;
    std::size_t best = 0;
    std::size_t truth = 0;
    double evidence_error = 0.0;  ///< of the sum of the evidence, if there is any

    [[nodiscard]] bool is_decided(double p_d) const { return has_parts && probability >= p_d; }
};

/// The decisions on a set of views.
struct outcomes {
    std::vector<outcome> all;

    [[nodiscard]] double share(auto&& counts) const {
        return static_cast<double>(std::ranges::count_if(all, counts)) /
               static_cast<double>(all.size());
    }
    [[nodiscard]] double missed(double p_d = usual_probability) const {
        return share([&](const outcome& o) { return !o.is_decided(p_d); });
    }
    [[nodiscard]] double right(double p_d = usual_probability) const {
        return share([&](const outcome& o) { return o.is_decided(p_d) && o.is_right; });
    }
    /// 1 if nothing is decided.
    [[nodiscard]] double precision(double p_d = usual_probability) const {
        const double decided = 1.0 - missed(p_d);
        return decided > 0.0 ? right(p_d) / decided : 1.0;
    }
    /// The share of views whose best class is right, however probable.
    [[nodiscard]] double top1() const {
        return share([](const outcome& o) { return o.has_parts && o.is_right; });
    }
    [[nodiscard]] double calibration_error() const {
        std::vector<double> p;
        std::vector<bool> is_right;
        for (const outcome& o : all) {
            p.push_back(o.probability);
            is_right.push_back(o.is_right);
        }
        return rec::expected_calibration_error(p, is_right);
    }
    /// The precision of the most certain views, if this share is undecided.
    [[nodiscard]] double precision_at(double undecided) const {
        std::vector<std::pair<double, bool>> order;
        for (const outcome& o : all)
            order.emplace_back(o.has_parts ? -o.probability : 0.0, o.has_parts && o.is_right);
        std::ranges::stable_sort(order, {}, [](const auto& o) { return o.first; });
        const auto n = static_cast<std::size_t>(
            std::lround((1.0 - undecided) * static_cast<double>(order.size())));
        const auto right =
            std::count_if(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n),
                          [](const auto& o) { return o.second; });
        return static_cast<double>(right) / static_cast<double>(n);
    }
    [[nodiscard]] double evidence_error() const {
        double largest = 0.0;
        for (const outcome& o : all) largest = std::max(largest, o.evidence_error);
        return largest;
    }
    void add(const outcomes& more) { all.insert(all.end(), more.all.begin(), more.all.end()); }
};

[[nodiscard]] inline outcome outcome_of(const rec::decision& d, const rec::view& v,
                                        std::size_t truth) {
    outcome o{.probability = d.probability[d.best],
              // Classes that are equally probable are no answer.
              .is_right = d.best == truth && d.log_ratio > 0.0,
              .has_parts = !v.parts.empty(),
              .best = d.best,
              .truth = truth};
    if (d.evidence.empty()) return o;
    double sum = 0.0;
    for (const auto& e : d.evidence) sum += e.log_ratio;
    const double ratio = std::log(d.probability[d.best] / d.probability[d.second]);
    if (std::isfinite(ratio)) o.evidence_error = std::abs(sum - ratio);
    return o;
}

/// Of decide(view), which returns a decision.
[[nodiscard]] inline outcomes outcomes_of(const view_set& tests, auto&& decide) {
    outcomes found{std::vector<outcome>(tests.views.size())};
    gnomon::threads{}(tests.views.size(), [&](std::size_t i) {
        found.all[i] = outcome_of(decide(tests.views[i]), tests.views[i], tests.classes[i]);
    });
    return found;
}

/// Of a likelihood of this temperature.
template <class Likelihood>
[[nodiscard]] outcomes outcomes_of(const Likelihood& likelihood, const view_set& tests,
                                   double temperature) {
    return outcomes_of(tests, [&](const rec::view& v) {
        return rec::explain(likelihood, v, {.temperature = temperature});
    });
}

/// Adds the views of models to what a recognizer has learned; fit() is to follow.
template <class Recognizer>
void learn_views(Recognizer& model, const view_set& training,
                 const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < training.views.size(); i += training.versions)
        model.learn({training.views.data() + i, training.versions}, names[training.classes[i]]);
}

/// Teaches a recognizer the views of all models.
template <class Recognizer>
void learn(Recognizer& model, const view_set& training, const std::vector<std::string>& names) {
    learn_views(model, training, names);
    model.fit(gnomon::threads{});
}

[[nodiscard]] inline std::vector<std::string> names_of(
    const std::vector<sim::furniture_model>& models) {
    std::vector<std::string> names;
    for (const auto& m : models) names.push_back(m.name);
    return names;
}

/// The same measure of the outcomes of several seeds.
struct measure_by_seed {
    std::string name;
    bool larger_is_better;
    std::function<double(const outcomes&)> of;
};

[[nodiscard]] inline std::vector<measure_by_seed> usual_measures() {
    return {{"precision", true, [](const outcomes& o) { return o.precision(); }},
            {"missed", false, [](const outcomes& o) { return o.missed(); }},
            {"right", true, [](const outcomes& o) { return o.right(); }},
            {"top 1", true, [](const outcomes& o) { return o.top1(); }}};
}
[[nodiscard]] inline measure_by_seed calibration_measure() {
    return {"ECE", false, [](const outcomes& o) { return o.calibration_error(); }};
}
[[nodiscard]] inline measure_by_seed equal_missed_measure() {
    return {"precision at 30.4 % missed", true,
            [](const outcomes& o) { return o.precision_at(thesis_missed); }};
}

/// A row: its key, and the median and the worst seed of each measure.
[[nodiscard]] inline json row_of(json key, const std::vector<outcomes>& seeds,
                                 const std::vector<measure_by_seed>& measures) {
    for (const auto& m : measures) {
        std::vector<double> values;
        for (const outcomes& o : seeds) values.push_back(m.of(o));
        key[m.name] = rounded(median_of(values), 3);
        key[m.name + ", worst"] =
            rounded(m.larger_is_better ? std::ranges::min(values) : std::ranges::max(values), 3);
    }
    std::printf("%s\n", key.dump().c_str());
    std::fflush(stdout);
    return key;
}

/// The outcomes of all seeds, by the names of rows, in the order in which these came first.
class outcomes_by_row {
  public:
    void add(const json& key, outcomes found) {
        for (auto& [k, seeds] : rows_) {
            if (k == key) {
                seeds.push_back(std::move(found));
                return;
            }
        }
        rows_.emplace_back(key, std::vector<outcomes>{std::move(found)});
    }
    [[nodiscard]] json table(const std::vector<measure_by_seed>& measures) const {
        json rows = json::array();
        for (const auto& [key, seeds] : rows_) rows.push_back(row_of(key, seeds, measures));
        return rows;
    }
    /// Rows of all seeds together.
    [[nodiscard]] json pooled(const std::vector<measure_by_seed>& measures) const {
        json rows = json::array();
        for (const auto& [key, seeds] : rows_) {
            outcomes all;
            for (const outcomes& o : seeds) all.add(o);
            json row = key;
            for (const auto& m : measures) row[m.name] = rounded(m.of(all), 4);
            rows.push_back(row);
        }
        return rows;
    }
    [[nodiscard]] const std::vector<std::pair<json, std::vector<outcomes>>>& rows() const {
        return rows_;
    }

  private:
    std::vector<std::pair<json, std::vector<outcomes>>> rows_;
};

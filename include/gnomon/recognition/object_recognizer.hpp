// SPDX-License-Identifier: BSL-1.0
/// @file
/// Recognition of objects, in the mode that is recommended: extremely randomized trees on the
/// description of a view, with calibrated probabilities. It learns on: more views can follow, and
/// the result is that of all views learned at once, to the last bit.
///
///     gnomon::recognition::object_recognizer model;
///     for (const auto& v : views_of_chairs) model.learn({v}, "chair");
///     ...
///     model.fit(gnomon::threads{});
///     const auto found = model.explain(view);
///     if (!found.is_background()) use(model.names()[found.best], found.evidence);
///
/// The reasons of a decision are terms of parts and of pairs of parts. Let f(S) be the
/// log-likelihoods that the trees give to a view of which only the parts S are seen. The term of a
/// part i is f({i}) - f({}), and that of a pair is what both are worth beyond each alone, after all
/// larger parts: the interaction index of Shapley and Taylor (Sundararajan, Dhamdhere and Agarwal
/// 2020) of second order, for the order of the parts by their size. The sum of all terms is the
/// log-likelihood of the whole view.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/recognition/calibration.hpp>
#include <gnomon/recognition/greedy_means.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/random_trees.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/view_descriptor.hpp>

namespace gnomon::recognition {

/// The name of the class of other things than objects, if such views are learned.
inline constexpr std::string_view background_name = "background";

/// Options of an object_recognizer.
struct object_recognizer_options {
    random_trees_options trees{};
    /// Distance of the feature vectors of a part from the mean of its word, in units of the scales
    /// of the features; words only name the parts in the evidence.
    double max_word_distance = 1.0;
    double min_probability = 0.90;  ///< P_d of the decisions
};

/// Learns classes of objects from views, and recognizes them. Models `view_likelihood`.
template <class Features = std::remove_cv_t<decltype(default_features)>,
          class Relations = std::remove_cv_t<decltype(default_relations)>>
class object_recognizer {
  public:
    using options_type = object_recognizer_options;
    static constexpr std::size_t features_per_part = feature_count<Features>;
    using descriptor_type = view_descriptor<Features, Relations>;

    /// All that is known: what was learned, and what follows from it.
    struct content {
        options_type options{};
        std::vector<std::string> names;  ///< of the classes
        /// Of the parts of all views.
        std::vector<cluster_statistics<features_per_part>> words;
        labeled_samples samples;             ///< descriptions of all views
        std::vector<std::uint32_t> sources;  ///< of each sample: the number of its call of learn()
        double temperature = 1.0;            ///< found by fit()
    };

    /// @param relations  `no_relations` for parts alone
    /// @param uses_profile  whether the height profile of a view counts, which needs the ground
    explicit object_recognizer(options_type options = {}, Features features = make_features(),
                               Relations relations = make_relations(), bool uses_profile = true)
        : descriptor_{std::move(features), std::move(relations), uses_profile} {
        learned_.options = options;
    }

    /// Learns versions of one view of an object: the view itself, and others of the same scan of
    /// which a part is hidden. Words grow; fit() is to follow.
    /// @throws std::invalid_argument  if the name is empty, or a feature needs the ground and a
    /// view
    ///                                has none; nothing is learned then
    void learn(std::span<const view> versions, std::string_view name) {
        gnomon::detail::require(!name.empty(), "object_recognizer: a class needs a name");
        std::vector<std::vector<double>> described;
        std::vector<typename descriptor_type::measured> measured;
        for (const view& v : versions) {
            measured.push_back(descriptor_.measure(v));
            described.push_back(rounded(descriptor_.describe(v, measured.back(), all_of(v), true)));
        }
        streaming_greedy_means<features_per_part> words(word_options(), learned_.words);
        for (const auto& m : measured)
            for (const auto& sample : m.parts) static_cast<void>(words.add(sample));
        const std::uint32_t number = class_number(name);
        const std::uint32_t source = learned_.sources.empty() ? 0 : learned_.sources.back() + 1;
        for (const auto& d : described) {
            learned_.samples.add(d, number);
            learned_.sources.push_back(source);
        }
        learned_.words = words.clusters();
        trees_ = {};
    }
    /// Learns one view.
    void learn(const view& v, std::string_view name) { learn({&v, 1}, name); }

    /// Grows the trees on all views so far, and calibrates their probabilities: the temperature is
    /// that of the largest likelihood of views that were left out, with all of their versions.
    /// @throws std::invalid_argument  if nothing was learned, or but one class
    /// Complexity: that of the trees, five times.
    template <execution X = sequential>
    void fit(const X& run = {}) {
        gnomon::detail::require(learned_.names.size() > 1,
                                "object_recognizer: two classes must be learned first");
        const auto& team = gnomon::detail::staying(run);
        calibrate(team);
        trees_ = random_trees(learned_.samples, classes(), learned_.options.trees, team);
    }

    [[nodiscard]] std::size_t classes() const { return learned_.names.size(); }
    [[nodiscard]] const std::vector<std::string>& names() const { return learned_.names; }
    /// What was learned, for a file.
    [[nodiscard]] const content& learned() const { return learned_; }
    [[nodiscard]] const descriptor_type& descriptor() const { return descriptor_; }
    /// Temperature, P_d, and the class of other things.
    [[nodiscard]] decide_options decision_options() const {
        const auto at = std::find(names().begin(), names().end(), background_name);
        return {.min_probability = learned_.options.min_probability,
                .temperature = learned_.temperature,
                .background_class = at == names().end()
                                        ? term::none
                                        : static_cast<std::size_t>(at - names().begin())};
    }

    /// Takes over what was learned, as learned() gave it, and grows the trees, without calibration.
    /// @throws std::invalid_argument  if it is not consistent; nothing is changed then
    template <execution X = sequential>
    void restore(content learned, const X& run = {}) {
        require_consistent(learned);
        random_trees grown(learned.samples, learned.names.size(), learned.options.trees, run);
        learned_ = std::move(learned);
        trees_ = std::move(grown);
    }

    /// The terms of a view.
    /// @throws std::invalid_argument  before fit(), or if a feature needs the ground and the view
    ///                                has none
    /// Complexity: O(parts^2) times the trees, for the 12 largest parts; all others are one term.
    [[nodiscard]] std::vector<term> operator()(const view& v) const {
        require_fitted();
        const auto m = descriptor_.measure(v);
        const std::size_t n = std::min(v.parts.size(), most_players);
        const auto value = [&](std::size_t prefix, std::initializer_list<std::size_t> players) {
            std::vector<std::size_t> chosen;
            bool has_rest = false;
            for (std::size_t i = 0; i < prefix; ++i) chosen.push_back(i);
            for (const std::size_t i : players) {
                if (i < n) chosen.push_back(i);
                has_rest = has_rest || i == n;
            }
            if (has_rest)
                for (std::size_t i = n; i < v.parts.size(); ++i) chosen.push_back(i);
            return log_likelihood_of(descriptor_.describe(v, m, chosen, has_rest));
        };
        // The players are the parts, and in the end all that remains of the view.
        std::vector<term> terms{{.log_likelihood = log_prior()}};
        std::vector<std::vector<double>> alone(n + 1);  // f({0, ..., i - 1, j}) for the current i
        std::vector<double> before = terms[0].log_likelihood;
        for (std::size_t j = 0; j <= n; ++j) {
            alone[j] = value(0, {j});
            terms.push_back({.kind = j < n ? term_kind::part : term_kind::rest,
                             .first = j < n ? j : term::none,
                             .word = j < n ? nearest_word(m.parts[j]) : term::none,
                             .log_likelihood = difference(alone[j], before)});
        }
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = i + 1; j <= n; ++j) {
                auto both = value(i, {i, j});
                auto interaction =
                    difference(difference(both, alone[i]), difference(alone[j], before));
                terms.push_back({.kind = term_kind::pair,
                                 .first = i,
                                 .second = j < n ? j : term::none,
                                 .log_likelihood = std::move(interaction)});
                alone[j] = std::move(both);
            }
            before = std::exchange(alone[i], {});
        }
        return terms;
    }

    /// The sum of the terms, without them. Errors as above. O(parts^2 + trees * depth).
    [[nodiscard]] std::vector<double> log_likelihood(const view& v) const {
        require_fitted();
        return log_likelihood_of(descriptor_(v));
    }

    /// The decision on a view, without its evidence.
    [[nodiscard]] decision decide(const view& v) const {
        return recognition::decide(*this, v, decision_options());
    }
    /// The decision on a view, with its evidence.
    [[nodiscard]] decision explain(const view& v) const {
        return recognition::explain(*this, v, decision_options());
    }

  private:
    static constexpr std::size_t most_players = 12;  ///< performance only: terms are quadratic

    static constexpr Features make_features() {
        if constexpr (std::same_as<Features, std::remove_cv_t<decltype(default_features)>>)
            return default_features;
        else
            return Features{};
    }
    static constexpr Relations make_relations() {
        if constexpr (std::same_as<Relations, std::remove_cv_t<decltype(default_relations)>>)
            return default_relations;
        else
            return Relations{};
    }

    [[nodiscard]] greedy_means_options<features_per_part> word_options() const {
        return {.max_distance = learned_.options.max_word_distance,
                .distance = {.weights = feature_weights(descriptor_.features)}};
    }

    [[nodiscard]] static std::vector<std::size_t> all_of(const view& v) {
        std::vector<std::size_t> all(v.parts.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
        return all;
    }

    /// In single precision, which halves a model file.
    [[nodiscard]] static std::vector<double> rounded(std::vector<double> d) {
        for (double& x : d) x = static_cast<double>(static_cast<float>(x));
        return d;
    }

    [[nodiscard]] static std::vector<double> difference(std::vector<double> a,
                                                        const std::vector<double>& b) {
        for (std::size_t c = 0; c < a.size(); ++c) a[c] -= b[c];
        return a;
    }

    void require_fitted() const {
        gnomon::detail::require(trees_.classes() > 0, "object_recognizer: fit() it first");
    }

    static void require_consistent(const content& c) {
        using gnomon::detail::require;
        const std::size_t n = c.samples.rows();
        require(c.names.size() > 1 && n > 0 && c.sources.size() == n &&
                    c.samples.values.size() == n * c.samples.columns,
                "object_recognizer: samples, classes and sources do not fit together");
        for (const double x : c.samples.values)
            require(std::isfinite(x), "object_recognizer: a sample is not finite");
        require(c.temperature > 0.0 && std::isfinite(c.temperature),
                "object_recognizer: the temperature must be finite and positive");
    }

    [[nodiscard]] std::uint32_t class_number(std::string_view name) {
        auto& names = learned_.names;
        const auto at = std::find(names.begin(), names.end(), name);
        const auto number = static_cast<std::uint32_t>(at - names.begin());
        if (at == names.end()) names.emplace_back(name);
        return number;
    }

    /// That of equally frequent classes.
    [[nodiscard]] std::vector<double> log_prior() const {
        const auto n = static_cast<double>(classes());
        return std::vector<double>(classes(), -std::log(n));
    }

    /// The logarithms of the probabilities of a description. A class that no tree found has half of
    /// the share of one tree.
    [[nodiscard]] static std::vector<double> logarithms(const random_trees& trees,
                                                        std::span<const double> sample,
                                                        std::size_t number_of_trees) {
        std::vector<double> p(trees.classes(), 0.0);
        trees.add_probability(sample, p);
        const double least = 0.5 / static_cast<double>(number_of_trees);
        for (double& x : p) x = std::log(x + least);
        return p;
    }
    [[nodiscard]] std::vector<double> log_likelihood_of(std::vector<double> sample) const {
        return logarithms(trees_, rounded(std::move(sample)), learned_.options.trees.trees);
    }

    [[nodiscard]] std::size_t nearest_word(
        const std::array<double, features_per_part>& sample) const {
        const weighted_distance<features_per_part> distance = word_options().distance;
        std::size_t nearest = term::none;
        double least = 0.0;
        for (std::size_t w = 0; w < learned_.words.size(); ++w) {
            const double d = distance(learned_.words[w].mean, sample);
            if (nearest == term::none || d < least) {
                nearest = w;
                least = d;
            }
        }
        return nearest;
    }

    void calibrate(const auto& run) {
        constexpr std::uint32_t folds = 4;
        std::vector<std::vector<double>> left_out(learned_.samples.rows());
        for (std::uint32_t fold = 0; fold < folds; ++fold) {
            labeled_samples others;
            for (std::size_t i = 0; i < left_out.size(); ++i) {
                if (learned_.sources[i] % folds != fold)
                    others.add(learned_.samples.row(i), learned_.samples.classes[i]);
            }
            if (others.rows() == 0) continue;
            const random_trees trees(others, classes(), learned_.options.trees, run);
            for (std::size_t i = 0; i < left_out.size(); ++i) {
                if (learned_.sources[i] % folds == fold)
                    left_out[i] =
                        logarithms(trees, learned_.samples.row(i), learned_.options.trees.trees);
            }
        }
        learned_.temperature = fit_temperature(left_out, learned_.samples.classes);
    }

    descriptor_type descriptor_;
    content learned_;
    random_trees trees_;
};

}  // namespace gnomon::recognition

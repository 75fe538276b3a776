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
#include <gnomon/recognition/detail/cross_validation.hpp>
#include <gnomon/recognition/detail/interaction_terms.hpp>
#include <gnomon/recognition/greedy_means.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/random_trees.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/view_descriptor.hpp>

namespace gnomon::recognition {

/// Learns classes of objects from views, and recognizes them. Models `view_likelihood`.
template <class Features = std::remove_cv_t<decltype(default_features)>,
          class Relations = std::remove_cv_t<decltype(default_relations)>>
class object_recognizer {
  public:
    using options_type = object_recognizer_options;  ///< those of the constructor
    static constexpr std::size_t features_per_part = feature_count<Features>;
    using descriptor_type = view_descriptor<Features, Relations>;  ///< what describes a view
    using content = learned_views<features_per_part>;              ///< what is learned

    /// @param features  with their scales, which are 1 if another type is not given here
    /// @param relations  `no_relations` for parts alone
    /// @param uses_profile  whether the height profile of a view counts, which needs the ground
    explicit object_recognizer(options_type options = {}, Features features = make_features(),
                               Relations relations = make_relations(), bool uses_profile = true)
        : descriptor_{std::move(features), std::move(relations), uses_profile} {
        learned_.options = options;
    }

    /// Learns versions of one view of an object: the view itself, and others of the same scan of
    /// which a part is hidden. Words grow; fit() is to follow.
    /// @throws std::invalid_argument  without a name, a view, or a ground that is needed; nothing
    ///                                is learned then
    void learn(std::span<const view> versions, std::string_view name) {
        gnomon::detail::require(!name.empty() && !versions.empty(),
                                "object_recognizer: a class needs a name and a view");
        std::vector<std::vector<double>> described;
        std::vector<typename descriptor_type::measured> measured;
        for (const view& v : versions) {
            measured.push_back(descriptor_.measure(v));
            described.push_back(rounded(descriptor_.describe(v, measured.back(), all_of(v), true)));
        }
        streaming_greedy_means<features_per_part> words(word_options(), learned_.words);
        for (const auto& m : measured)
            for (const auto& sample : m.parts) static_cast<void>(words.add(sample));
        const std::uint32_t number = learned_.class_number(name);
        const std::uint32_t source = learned_.sources.empty() ? 0 : learned_.sources.back() + 1;
        for (const auto& d : described) {
            learned_.samples.add(d, number);
            learned_.sources.push_back(source);
        }
        learned_.words = words.clusters();
        trees_ = {};
    }
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
        const double temperature =
            fit_temperature(detail::left_out_log_probabilities(learned_.samples, learned_.sources,
                                                               classes(), tree_options(), team),
                            learned_.samples.classes);
        trees_ = random_trees(learned_.samples, classes(), tree_options(), team);
        learned_.temperature = temperature;  // of these trees: not if growing them is cancelled
    }

    [[nodiscard]] std::size_t classes() const { return learned_.names.size(); }
    [[nodiscard]] const std::vector<std::string>& names() const { return learned_.names; }
    [[nodiscard]] const content& learned() const { return learned_; }  ///< what a file holds
    [[nodiscard]] const descriptor_type& descriptor() const { return descriptor_; }  ///< of views
    [[nodiscard]] const random_trees& trees() const { return trees_; }  ///< none before fit()
    /// Of the trees that fit() grows.
    [[nodiscard]] random_trees_options tree_options() const {
        return learned_.tree_options(descriptor_type::pair_columns);
    }
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
        learned.require_consistent();
        gnomon::detail::require(
            learned.samples.columns == descriptor_.describe(view{}, {}, {}, false).size(),
            "object_recognizer: the samples are of other features");
        const auto options = learned.tree_options(descriptor_type::pair_columns);
        random_trees grown(learned.samples, learned.names.size(), options, run);
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
        // f of the first parts and some more; the last player is all that remains of the view.
        const auto f = [&](std::size_t first, std::initializer_list<std::size_t> players) {
            std::vector<std::size_t> chosen;
            bool has_rest = false;
            for (std::size_t i = 0; i < first; ++i) chosen.push_back(i);
            for (const std::size_t i : players) {
                if (i < n) chosen.push_back(i);
                has_rest = has_rest || i == n;
            }
            for (std::size_t i = n; has_rest && i < v.parts.size(); ++i) chosen.push_back(i);
            return log_likelihood_of(descriptor_.describe(v, m, chosen, has_rest));
        };
        const std::vector<double> equal_classes(classes(),
                                                -std::log(static_cast<double>(classes())));
        std::vector<term> terms = detail::interaction_terms(n + 1, equal_classes, f);
        for (term& t : terms) {
            if (t.kind == term_kind::part && t.first < n)
                t.word = learned_.nearest_word(m.parts[t.first], word_options().distance);
            if (t.kind == term_kind::part && t.first == n) t.kind = term_kind::rest;
            if (t.first == n) t.first = term::none;
            if (t.second == n) t.second = term::none;
        }
        return terms;
    }

    /// The sum of the terms, without them. Errors as above. O(parts^2 + trees * depth).
    [[nodiscard]] std::vector<double> log_likelihood(const view& v) const {
        require_fitted();
        return trees_.log_probability(described(v));
    }

    /// The description of a view as the trees get it.
    /// @throws std::invalid_argument  if a feature needs the ground and the view has none
    [[nodiscard]] std::vector<double> described(const view& v) const {
        return rounded(descriptor_(v));
    }

    /// The decision on a view, without its evidence, and with it.
    [[nodiscard]] decision decide(const view& v) const {
        return recognition::decide(*this, v, decision_options());
    }
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
        constexpr double largest = 1e30;  // numerical: finite in single precision
        for (double& x : d) {
            gnomon::detail::require(std::abs(x) <= largest,
                                    "object_recognizer: a feature or a relation is too large");
            x = static_cast<double>(static_cast<float>(x));
        }
        return d;
    }

    void require_fitted() const {
        gnomon::detail::require(trees_.classes() > 0, "object_recognizer: fit() it first");
    }

    [[nodiscard]] std::vector<double> log_likelihood_of(std::vector<double> sample) const {
        return trees_.log_probability(rounded(std::move(sample)));
    }

    descriptor_type descriptor_;
    content learned_;
    random_trees trees_;
};

}  // namespace gnomon::recognition

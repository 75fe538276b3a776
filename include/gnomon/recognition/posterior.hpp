// SPDX-License-Identifier: BSL-1.0
/// @file
/// From likelihoods to a decision and its reasons. A likelihood gives, for a view, terms: a part, a
/// pair of parts, or the number of parts, each with its log-likelihood under every class. The
/// posterior is the softmax of their sum; the decision is the class of largest probability, if that
/// is at least P_d; and the evidence is what each term contributes to the logarithm of the ratio of
/// the best class to the second, so that its sum is the decision. Klasing 2010, Secs. 5.4
/// and 5.5.2.
///
///     const auto found = gnomon::recognition::decide(likelihood, view, {.min_probability = 0.90});
///     if (!found.is_background()) use(names[found.best], found.probability[found.best]);
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition {

/// What a term of a likelihood is about.
enum class term_kind : std::uint8_t {
    part,          ///< a part is an example of a word
    pair,          ///< two parts are related
    missing_pair,  ///< two parts are not related as those of the class are
    part_count,    ///< the number of parts
    rest,          ///< points that belong to no part
    prior          ///< the frequency of the classes
};

/// The log-likelihood of one thing that was seen, under every class.
struct term {
    /// No part, no word.
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    term_kind kind = term_kind::prior;        ///< what it is about
    std::size_t first = none, second = none;  ///< numbers of parts of the view
    std::size_t word = none;                  ///< of the part or of the pair, by its number
    std::vector<double> log_likelihood = {};  ///< of each class
};

/// l(view) gives the terms of a view, each with l.classes() log-likelihoods.
template <class L>
concept view_likelihood = requires(const L& l, const view& v) {
    { l.classes() } -> std::convertible_to<std::size_t>;
    { l(v) } -> std::convertible_to<std::vector<term>>;
};

/// How a class is decided on. Klasing 2010, Sec. 5.5.2.
struct decide_options {
    double min_probability = 0.90;  ///< P_d; views of a lower probability are background
    double temperature = 1.0;       ///< by which all terms are divided, from calibration
    /// The class of other things, if it was learned; else `term::none`.
    std::size_t background_class = term::none;
};

/// A reason of a decision.
struct evidence {
    term_kind kind = term_kind::prior;                    ///< what it is about
    std::size_t first = term::none, second = term::none;  ///< parts of the view
    std::size_t word = term::none;                        ///< of the part or of the pair
    double log_ratio = 0.0;  ///< positive if it is for the best class, and against the second
};

/// What a view shows.
struct decision {
    std::vector<double> probability;      ///< of each class; their sum is 1
    std::size_t best = term::none;        ///< the class of largest probability
    std::size_t second = term::none;      ///< that of the next; `term::none` of a single class
    bool is_certain = false;              ///< whether the best one reaches P_d
    bool is_of_background_class = false;  ///< whether the best one is that of other things
    double log_ratio = 0.0;               ///< log of the ratio of best to second
    std::vector<recognition::evidence> evidence;  ///< its sum is log_ratio, up to rounding

    /// Whether no object was recognized: nothing was certain, there were no parts or terms, or the
    /// view
    /// shows something else.
    [[nodiscard]] bool is_background() const { return !is_certain || is_of_background_class; }
};

/// The probabilities of classes of these log-likelihoods. O(n).
[[nodiscard]] inline std::vector<double> softmax(std::span<const double> log_likelihood,
                                                 double temperature = 1.0) {
    std::vector<double> p(log_likelihood.begin(), log_likelihood.end());
    if (p.empty()) return p;
    const double largest = *std::max_element(p.begin(), p.end());
    for (double& x : p) x = std::exp((x - largest) / temperature);
    const double sum = std::accumulate(p.begin(), p.end(), 0.0);
    for (double& x : p) x /= sum;
    return p;
}

/// The sum of the log-likelihoods of all terms.
[[nodiscard]] inline std::vector<double> sum_of(std::span<const term> terms, std::size_t classes) {
    std::vector<double> sum(classes, 0.0);
    for (const term& t : terms)
        for (std::size_t c = 0; c < classes; ++c) sum[c] += t.log_likelihood[c];
    return sum;
}

/// The decision on terms.
/// @param has_parts  whether the view has parts; without, it is background
/// @throws std::invalid_argument  if there is no class, a term has another number of them or
///                                is NaN, every class is excluded, P_d is not in [0, 1], the
///                                temperature is not positive and finite, or evidence overflows
/// Complexity: O(terms * classes). Source: Klasing 2010, Eqs. (5.9) to (5.17), Sec. 5.5.2.
[[nodiscard]] inline decision decide(std::span<const term> terms, std::size_t classes,
                                     bool has_parts, const decide_options& options = {}) {
    using gnomon::detail::require;
    require(classes > 0, "decide: there is no class");
    require(options.min_probability >= 0.0 && options.min_probability <= 1.0,
            "decide: min_probability must be in [0, 1]");
    require(options.temperature > 0.0 && std::isfinite(options.temperature),
            "decide: the temperature must be finite and positive");
    for (const term& t : terms)
        require(t.log_likelihood.size() == classes, "decide: a term has another number of classes");
    const std::vector<double> sum = sum_of(terms, classes);
    decision d;
    d.best = static_cast<std::size_t>(std::max_element(sum.begin(), sum.end()) - sum.begin());
    for (const double x : sum)
        require(x <= sum[d.best] && std::isfinite(sum[d.best]),
                "decide: log-likelihoods are NaN, or exclude every class");
    d.probability = softmax(sum, options.temperature);
    d.is_certain = has_parts && !terms.empty() && d.probability[d.best] >= options.min_probability;
    d.is_of_background_class = d.best == options.background_class;
    if (classes == 1) return d;
    d.second = d.best == 0 ? 1 : 0;
    for (std::size_t c = 0; c < classes; ++c)
        if (c != d.best && sum[c] > sum[d.second]) d.second = c;
    d.evidence.reserve(terms.size());
    for (const term& t : terms) {
        const double ratio =
            (t.log_likelihood[d.best] - t.log_likelihood[d.second]) / options.temperature;
        d.evidence.push_back({t.kind, t.first, t.second, t.word, ratio});
        d.log_ratio += ratio;
    }
    require(!std::isnan(d.log_ratio),
            "decide: evidence overflows, as the temperature is too small");
    return d;
}

/// The decision on a view, with its evidence.
/// Errors and complexity: those of the likelihood, and of the decision on terms.
template <view_likelihood L>
[[nodiscard]] decision explain(const L& likelihood, const view& v,
                               const decide_options& options = {}) {
    return decide(likelihood(v), likelihood.classes(), !v.parts.empty(), options);
}

/// The decision on a view. Without evidence if the likelihood knows the sum of the terms without
/// them, l.log_likelihood(view), which is faster.
/// Errors and complexity: as for explain().
template <view_likelihood L>
[[nodiscard]] decision decide(const L& likelihood, const view& v,
                              const decide_options& options = {}) {
    if constexpr (requires { likelihood.log_likelihood(v); }) {
        const term sum{.log_likelihood = likelihood.log_likelihood(v)};
        decision d = decide({&sum, 1}, likelihood.classes(), !v.parts.empty(), options);
        d.evidence.clear();
        return d;
    } else {
        return explain(likelihood, v, options);
    }
}

}  // namespace gnomon::recognition

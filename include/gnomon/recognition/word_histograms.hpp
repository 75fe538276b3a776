// SPDX-License-Identifier: BSL-1.0
/// @file
/// Recognition as the thesis has it: views are bags of part words and relation words, and a class
/// is a histogram of part words, and the share of pairs of words that are related. Klasing 2010,
/// Secs. 5.2 to 5.4. `object_recognizer` recognizes more objects with fewer errors; this is for
/// comparison.
///
///     using namespace gnomon::recognition;
///     const auto features = scaled_by_largest(thesis_features, views);
///     const auto thesis = word_histograms(views, classes, 12, features, thesis_relations,
///                                         {.max_distance = 0.03});
///     const auto found = explain(thesis, view, {.min_probability = 0.90});
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <boost/hana/transform.hpp>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/detail/word_detector.hpp>
#include <gnomon/recognition/greedy_means.hpp>
#include <gnomon/recognition/part_count.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/relation_words.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/vocabulary.hpp>

namespace gnomon::recognition {

/// The features with scales such that the largest height and the largest volume of the parts of
/// these views are 1. Klasing 2010, Eq. (5.1). New views may exceed 1.
/// @throws std::invalid_argument  if a view has no ground
template <class Features>
[[nodiscard]] Features scaled_by_largest(const Features& features, std::span<const view> views) {
    return boost::hana::transform(features, [&]<class F>(F f) {
        if constexpr (std::same_as<F, mean_height> || std::same_as<F, box_volume>) {
            double largest = 0.0;
            for (const view& v : views)
                for (const part& p : v.parts) largest = std::max(largest, f(p, v));
            if (largest > 0.0) f.scale = largest;
        }
        return f;
    });
}

/// Options of the thesis's method. The defaults are those of its text; `repair`,
/// `one_word_per_part` and `counts_absence` repair it.
struct word_histogram_options {
    double max_distance = 0.03;        ///< rho_max of greedy means clustering
    std::size_t min_members = 4;       ///< n_min of a word, and of the values of a relation word
    double inlier_probability = 0.99;  ///< of detections of words and of relations, Sec. 5.6.2
    covariance_repair repair = covariance_repair::diagonal;  ///< of words with few examples
    bool counts_parts = true;        ///< whether the number of detections is evidence, Eq. (5.17)
    bool one_word_per_part = false;  ///< the nearest word only; the text has all within delta_p
    bool counts_absence = false;     ///< whether relations that are missing are evidence
    double smoothing = 0.5;          ///< of Lidstone, divided by the number of words
};

/// Histograms of words, of each class. Models `view_likelihood`.
template <class Features, class Relations>
class word_histograms {
  public:
    static constexpr std::size_t D = feature_count<Features>;    ///< numbers that describe a part
    static constexpr std::size_t R = relation_count<Relations>;  ///< numbers that describe a pair

    /// Counts the words of training views.
    /// @param views      of all classes
    /// @param of_view    the class of each view, below `classes`
    /// @throws std::invalid_argument  if views and classes differ in number, a class is too large,
    ///                                a feature is not finite or needs a ground that is not known,
    ///                                or an option is out of range
    /// Complexity: O(n words D^2) for n parts, and that of the clustering.
    word_histograms(std::span<const view> views, std::span<const std::uint32_t> of_view,
                    std::size_t classes, Features features, Relations relations,
                    const word_histogram_options& options = {})
        : word_histograms(views, of_view, classes, features, relations,
                          greedy_means(samples_of(features, views),
                                       greedy_means_options<D>{
                                           .max_distance = options.max_distance,
                                           .min_members = options.min_members,
                                           .distance = {.weights = feature_weights(features)}}),
                          options) {}

    /// The same, with the words of another clustering of the parts, view by view.
    word_histograms(std::span<const view> views, std::span<const std::uint32_t> of_view,
                    std::size_t classes, Features features, Relations relations,
                    const clustering<D>& clusters, const word_histogram_options& options)
        : options_(options),
          detect_{.features = std::move(features),
                  .relations = std::move(relations),
                  .one_word_per_part = options.one_word_per_part} {
        using gnomon::detail::require;
        require(views.size() == of_view.size(),
                "word_histograms: views and classes differ in number");
        require(options.smoothing > 0.0 && std::isfinite(options.smoothing),
                "word_histograms: smoothing must be positive");
        std::size_t parts = 0;
        for (const view& v : views) parts += v.parts.size();
        require(clusters.labels.size() == parts, "word_histograms: a clustering of other parts");
        for (const std::uint32_t c : of_view)
            require(c < classes, "word_histograms: a class is too large");
        detect_.words = make_vocabulary<D>(clusters.clusters,
                                           {.min_members = 1,
                                            .repair = options.repair,
                                            .max_distance = options.max_distance,
                                            .inlier_probability = options.inlier_probability});
        detect_.max_deviations =
            std::sqrt(detail::chi_squared_quantile(options.inlier_probability, 1));
        learn_relations(views, clusters);
        learn_histograms(views, of_view, classes);
    }

    [[nodiscard]] std::size_t classes() const { return counts_.size(); }  ///< number of classes
    [[nodiscard]] const vocabulary<D>& words() const { return detect_.words; }  ///< of parts
    /// The words of pairs of parts.
    [[nodiscard]] const std::vector<recognition::relation_word>& relation_words() const {
        return detect_.relation_words;
    }
    /// [relation word][class]: the share of pairs of parts of the two words that have the relation.
    /// Where the words were never seen together it is 1, or 0.5 if absence counts.
    [[nodiscard]] const std::vector<std::vector<double>>& relation_shares() const {
        return related_;
    }

    /// The terms of a view; none if no word is detected.
    /// @throws std::invalid_argument  as the constructor, for a feature
    [[nodiscard]] std::vector<term> operator()(const view& v) const {
        const detail::detected_words found = detect_(v);
        std::vector<term> terms;
        for (const auto& [i, word] : found.parts)
            terms.push_back({term_kind::part, i, term::none, word, log_share_[word]});
        if (terms.empty()) return terms;
        for (const auto& pair : found.pairs) {
            if (!pair.is_related && !options_.counts_absence) continue;
            std::vector<double> log_likelihood;
            for (const double share : related_[pair.word])
                log_likelihood.push_back(std::log(pair.is_related ? share : absent(share)));
            terms.push_back({pair.is_related ? term_kind::pair : term_kind::missing_pair,
                             pair.first, pair.second, pair.word, std::move(log_likelihood)});
        }
        if (options_.counts_parts) {
            std::vector<double> log_likelihood;
            for (const part_count& count : counts_)
                log_likelihood.push_back(
                    count.log_probability(static_cast<double>(found.parts.size())));
            terms.push_back(
                {.kind = term_kind::part_count, .log_likelihood = std::move(log_likelihood)});
        }
        return terms;
    }

  private:
    [[nodiscard]] static std::vector<std::array<double, D>> samples_of(
        const Features& features, std::span<const view> views) {
        std::vector<std::array<double, D>> samples;
        for (const view& v : views)
            for (const part& p : v.parts) samples.push_back(feature_vector(features, p, v));
        return samples;
    }

    /// The probability that a relation is missing; not 0 where all had it.
    [[nodiscard]] static double absent(double share) { return 1.0 - std::min(share, most_related); }

    /// Relation words of the clusters that the parts of the training views are in.
    void learn_relations(std::span<const view> views, const clustering<D>& clusters) {
        relation_statistics<R> statistics;
        std::size_t first = 0;
        for (const view& v : views) {
            for (std::size_t j = 0; j < v.parts.size(); ++j) {
                for (std::size_t i = 0; i < j; ++i) {
                    const auto a = clusters.labels[first + i], b = clusters.labels[first + j];
                    if (a < 0 || b < 0) continue;
                    statistics.add(static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                                   relation_vector(detect_.relations, v.parts[i], v.parts[j]));
                }
            }
            first += v.parts.size();
        }
        detect_.relation_words = statistics.words(detect_.relations, options_.min_members);
        for (std::size_t q = 0; q < detect_.relation_words.size(); ++q)
            detect_
                .words_of_pair[{detect_.relation_words[q].first, detect_.relation_words[q].second}]
                .push_back(q);
    }

    void learn_histograms(std::span<const view> views, std::span<const std::uint32_t> of_view,
                          std::size_t classes) {
        const std::size_t n = detect_.words.words.size(), m = detect_.relation_words.size();
        std::vector<std::vector<double>> histogram(classes, std::vector<double>(n, 0.0));
        std::vector<std::vector<double>> together(m, std::vector<double>(classes, 0.0));
        auto related = together;
        std::vector<std::vector<double>> numbers(classes);
        for (std::size_t i = 0; i < views.size(); ++i) {
            const detail::detected_words found = detect_(views[i]);
            const std::uint32_t c = of_view[i];
            for (const auto& [part, word] : found.parts) histogram[c][word] += 1.0;
            for (const auto& pair : found.pairs) {
                together[pair.word][c] += 1.0;
                if (pair.is_related) related[pair.word][c] += 1.0;
            }
            numbers[c].push_back(static_cast<double>(found.parts.size()));
        }
        log_share_.assign(n, std::vector<double>(classes, 0.0));
        const double extra = options_.smoothing / static_cast<double>(std::max<std::size_t>(1, n));
        for (std::size_t c = 0; c < classes; ++c) {
            double total = 0.0;
            for (const double h : histogram[c]) total += h + extra;
            for (std::size_t w = 0; w < n; ++w)
                log_share_[w][c] = std::log((histogram[c][w] + extra) / total);
            counts_.push_back(part_count::of(numbers[c]));
        }
        // Where the words were never seen together, a relation is no evidence.
        const double unknown = options_.counts_absence ? 0.5 : 1.0;
        related_ = std::move(related);
        for (std::size_t q = 0; q < m; ++q) {
            for (std::size_t c = 0; c < classes; ++c) {
                related_[q][c] = together[q][c] > 0.0 ? std::clamp(related_[q][c] / together[q][c],
                                                                   least_related, most_related)
                                                      : unknown;
            }
        }
    }

    /// Bounds of the share of related pairs, so that one pair does not exclude a class; chosen.
    static constexpr double least_related = 0.05, most_related = 0.975;

    word_histogram_options options_;
    detail::word_detector<Features, Relations> detect_;
    std::vector<std::vector<double>> log_share_;  ///< of each word: log of Eq. (5.7), by class
    std::vector<std::vector<double>> related_;    ///< of each relation word, by class
    std::vector<part_count> counts_;              ///< of each class
};

}  // namespace gnomon::recognition

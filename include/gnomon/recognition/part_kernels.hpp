// SPDX-License-Identifier: BSL-1.0
/// @file
/// Soft words: the density of the features of a part under a class is that of Gaussian kernels on
/// all parts of its training views, and so for pairs of parts (Rosenblatt 1956; Parzen 1962). No
/// part falls between words, and none votes twice.
///
///     gnomon::recognition::part_kernels soft(views, classes, 12, default_features,
///                                            default_relations);
///     const auto found = explain(soft, view, {.temperature = soft.temperature()});
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <boost/hana/unpack.hpp>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/calibration.hpp>
#include <gnomon/recognition/part_count.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition {

/// Options of part kernels; chosen by the prototype of this method (simulated furniture, seed 1).
struct part_kernel_options {
    double bandwidth = 1.0;     ///< of the kernels, in units of the scales of the features
    double least_share = 1e-4;  ///< density of a part unlike all others
    double pair_weight = 0.5;   ///< of all pairs together; 0 for parts alone
    bool counts_parts = true;   ///< whether the number of parts is evidence, Eq. (5.17)
};

/// Kernel densities of parts and of pairs. Models `view_likelihood`.
template <class Features, class Relations>
class part_kernels {
  public:
    static constexpr std::size_t D = feature_count<Features>;    ///< numbers that describe a part
    static constexpr std::size_t R = relation_count<Relations>;  ///< numbers that describe a pair

    /// Without views: learn() and calibrate() are to follow.
    /// @throws std::invalid_argument  if bandwidth or least share are not positive, or the weight
    ///                                of pairs is negative
    part_kernels(std::size_t classes, Features features, Relations relations,
                 const part_kernel_options& options = {})
        : options_(options),
          features_(std::move(features)),
          relations_(std::move(relations)),
          parts_(classes),
          pairs_(classes),
          numbers_(classes),
          counts_(classes) {
        const auto is_positive = [](double x) { return x > 0.0 && std::isfinite(x); };
        gnomon::detail::require(is_positive(options.bandwidth) && is_positive(options.least_share),
                                "part_kernels: bandwidth and least share must be positive");
        gnomon::detail::require(options.pair_weight >= 0.0 && std::isfinite(options.pair_weight),
                                "part_kernels: the weight of pairs must not be negative");
    }

    /// Learns all views, and calibrates.
    /// @param of_view  the class of each view, below `classes`
    /// @throws std::invalid_argument  if views and classes differ in number, or as
    /// learn() Complexity: O(p^2) for p pairs of parts of all views.
    part_kernels(std::span<const view> views, std::span<const std::uint32_t> of_view,
                 std::size_t classes, Features features, Relations relations,
                 const part_kernel_options& options = {})
        : part_kernels(classes, std::move(features), std::move(relations), options) {
        gnomon::detail::require(views.size() == of_view.size(),
                                "part_kernels: views and classes differ in number");
        for (std::size_t i = 0; i < views.size(); ++i) learn(views[i], of_view[i]);
        calibrate();
    }

    /// Learns one view more.
    /// @throws std::invalid_argument  if the class is too large, or a feature is not
    /// finite or needs
    ///                                a ground that is unknown; nothing is learned
    ///                                then
    void learn(const view& v, std::uint32_t its_class) {
        gnomon::detail::require(its_class < classes(), "part_kernels: a class is too large");
        learned_.push_back(measure(v));
        of_view_.push_back(its_class);
        const std::size_t i = learned_.size() - 1;
        for (const auto& x : learned_[i].parts) parts_[its_class].push_back({x, i});
        for (const auto& x : learned_[i].pairs) pairs_[its_class].push_back({x, i});
        numbers_[its_class].push_back(static_cast<double>(learned_[i].parts.size()));
        counts_[its_class] = part_count::of(numbers_[its_class]);
    }

    /// Finds the temperature of the views so far, each without its own kernels.
    void calibrate() {
        std::vector<std::vector<double>> left_out;
        for (std::size_t i = 0; i < learned_.size(); ++i) {
            const auto terms = terms_of(learned_[i], i);
            left_out.push_back(terms.empty() ? std::vector<double>{} : sum_of(terms, classes()));
        }
        temperature_ = fit_temperature(left_out, of_view_);
    }

    [[nodiscard]] std::size_t classes() const { return parts_.size(); }  ///< number of classes
    /// That of calibrated probabilities.
    [[nodiscard]] double temperature() const { return temperature_; }

    /// The terms of a view; none without parts. O(kernels * parts^2).
    [[nodiscard]] std::vector<term> operator()(const view& v) const {
        return terms_of(measure(v), none);
    }

  private:
    static constexpr std::size_t none = term::none;

    template <std::size_t N>
    struct kernel {
        std::array<double, N> center;
        std::size_t view;  ///< that it is of
    };
    using pair_sample = std::array<double, 2 * D + R>;
    struct measured {
        std::vector<std::array<double, D>> parts;
        std::vector<pair_sample> pairs;  ///< (0, 1), (0, 2), (1, 2), (0, 3), ...
    };

    [[nodiscard]] measured measure(const view& v) const {
        measured m;
        for (const part& p : v.parts) m.parts.push_back(feature_vector(features_, p, v));
        if (options_.pair_weight == 0.0) return m;
        for (std::size_t j = 0; j < v.parts.size(); ++j)
            for (std::size_t i = 0; i < j; ++i) m.pairs.push_back(pair_of(v, m, i, j));
        return m;
    }

    /// The features of both parts, the lower one first, and their relations.
    [[nodiscard]] pair_sample pair_of(const view& v, const measured& m, std::size_t i,
                                      std::size_t j) const {
        constexpr double part_weight = 0.7;     // chosen by the prototype
        constexpr double bins_per_scale = 2.0;  // of a histogram of the relation
        if (v.parts[i].lowest + v.parts[i].highest > v.parts[j].lowest + v.parts[j].highest)
            std::swap(i, j);
        pair_sample x;
        for (std::size_t f = 0; f < D; ++f) {
            x[f] = part_weight * m.parts[i][f];
            x[D + f] = part_weight * m.parts[j][f];
        }
        const auto values = relation_vector(relations_, v.parts[i], v.parts[j]);
        const auto bins = boost::hana::unpack(
            relations_, [](const auto&... r) { return std::array<double, R>{r.bin...}; });
        for (std::size_t r = 0; r < R; ++r) x[2 * D + r] = values[r] / (bins_per_scale * bins[r]);
        return x;
    }

    /// The logarithm of the mean kernel at x, without those of one view.
    template <std::size_t N>
    [[nodiscard]] double log_density(const std::vector<kernel<N>>& kernels,
                                     const std::array<double, N>& x, std::size_t left_out) const {
        constexpr double farthest = 40.0;  // numerical: exp(-40) is less than any share that counts
        const double factor = 0.5 / (options_.bandwidth * options_.bandwidth);
        double sum = 0.0, n = 0.0;
        for (const auto& k : kernels) {
            if (k.view == left_out) continue;
            n += 1.0;
            double squared = 0.0;
            for (std::size_t f = 0; f < N; ++f)
                squared += (x[f] - k.center[f]) * (x[f] - k.center[f]);
            if (factor * squared < farthest) sum += std::exp(-factor * squared);
        }
        return std::log(options_.least_share + sum / std::max(1.0, n));
    }

    [[nodiscard]] std::vector<term> terms_of(const measured& m, std::size_t left_out) const {
        std::vector<term> terms;
        const auto add = [&](term_kind kind, std::size_t i, std::size_t j, auto&& log_likelihood) {
            term t{kind, i, j, term::none, {}};
            for (std::size_t c = 0; c < classes(); ++c)
                t.log_likelihood.push_back(log_likelihood(c));
            terms.push_back(std::move(t));
        };
        const auto n = static_cast<double>(m.parts.size());
        for (std::size_t i = 0; i < m.parts.size(); ++i) {
            add(term_kind::part, i, none,
                [&](std::size_t c) { return log_density(parts_[c], m.parts[i], left_out); });
        }
        std::size_t pair = 0;
        for (std::size_t j = 0; j < m.parts.size() && !m.pairs.empty(); ++j) {
            for (std::size_t i = 0; i < j; ++i, ++pair) {
                // Pairs are not independent: each part is in n - 1 of them.
                const double weight = options_.pair_weight * 2.0 / n;
                add(term_kind::pair, i, j, [&](std::size_t c) {
                    return weight * log_density(pairs_[c], m.pairs[pair], left_out);
                });
            }
        }
        if (options_.counts_parts && !m.parts.empty()) {
            add(term_kind::part_count, none, none,
                [&](std::size_t c) { return counts_[c].log_probability(n); });
        }
        return terms;
    }

    part_kernel_options options_;
    Features features_;
    Relations relations_;
    std::vector<std::vector<kernel<D>>> parts_;          ///< of each class
    std::vector<std::vector<kernel<2 * D + R>>> pairs_;  ///< of each class
    std::vector<measured> learned_;                      ///< views
    std::vector<std::uint32_t> of_view_;                 ///< class of each
    std::vector<std::vector<double>> numbers_;           ///< of parts, of the views of each class
    std::vector<part_count> counts_;                     ///< of each class
    double temperature_ = 1.0;
};

}  // namespace gnomon::recognition

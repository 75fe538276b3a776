// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether a view shows something that was never learned, and which unknown views show the same:
///
///     const gnomon::recognition::view_novelty novelty(model);
///     if (novelty(view) > 0.95) unknown.push_back(view);
///     ...
///     const auto group = novelty.groups_of(unknown);
///     for (std::size_t i = 0; i < unknown.size(); ++i)
///         if (group[i] == 0) model.learn(unknown[i], "a name that the user gives");
///     model.fit();
///
/// A view is novel if the trees do not agree on a class, or if it is far from all learned views.
/// Neither suffices: trees are certain far from all views, and between two similar classes they
/// disagree. Views are compared by their descriptions, in which a number weighs as much as the
/// trees use it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/average_linkage.hpp>
#include <gnomon/recognition/detail/cross_validation.hpp>
#include <gnomon/recognition/labeled_samples.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition {

/// Measures how novel views are to a recognizer. (A class, as this is calibrated once.)
template <class Recognizer = object_recognizer<>>
class view_novelty {
  public:
    /// @param model  a copy is kept; views of the class `background_name` are known as well
    /// @throws std::invalid_argument  if the recognizer is not fitted, or on views of one scan
    /// Complexity: that of the trees, four times, and O(n^2) for n learned views.
    template <execution X = sequential>
    explicit view_novelty(Recognizer model, const X& run = {}) : model_(std::move(model)) {
        gnomon::detail::require(model_.trees().classes() > 0,
                                "view_novelty: the recognizer must be fitted first");
        const auto& learned = model_.learned();
        gnomon::detail::require(learned.sources.front() != learned.sources.back(),
                                "view_novelty: the recognizer has views of one scan only");
        const auto& team = gnomon::detail::staying(run);
        weigh_columns();
        const auto left_out = detail::left_out_log_probabilities(
            learned.samples, learned.sources, model_.classes(), model_.tree_options(), team);
        // The first version of each view: in others a part is hidden.
        std::vector<std::size_t> whole;
        for (std::size_t i = 0; i < left_out.size(); ++i)
            if (i == 0 || learned.sources[i] != learned.sources[i - 1]) whole.push_back(i);
        known_.assign(whole.size(), 0.0);
        team(whole.size(), [&](std::size_t k) {
            const std::size_t i = whole[k];
            known_[k] = score(left_out[i], learned.samples.row(i), learned.sources[i]);
        });
        std::sort(known_.begin(), known_.end());
        typical_ = median_distance();
    }

    [[nodiscard]] const Recognizer& model() const { return model_; }  ///< the copy

    /// The share of learned views, without those of which a part was hidden, that are less novel
    /// than this one, each compared with the views of all other scans: in [0, 1], and about
    /// uniform for fresh views of learned objects.
    /// @throws std::invalid_argument  if a feature needs the ground and the view has none
    /// Complexity: O(n) for n learned views, and that of a decision.
    [[nodiscard]] double operator()(const view& v) const {
        const std::vector<double> d = model_.described(v);
        const double s = score(model_.trees().log_probability(d), d, no_source);
        const auto [low, high] = std::equal_range(known_.begin(), known_.end(), s);
        return 0.5 * static_cast<double>((low - known_.begin()) + (high - known_.begin())) /
               static_cast<double>(known_.size());
    }

    /// The distance of two views: the sum over all numbers of their descriptions of the difference
    /// in standard deviations, at most 3 each, times its weight. Weights add up to 1.
    [[nodiscard]] double distance(const view& a, const view& b) const {
        return distance_of(model_.described(a), model_.described(b));
    }

    /// The median distance() of learned views of one class. O(1).
    [[nodiscard]] double typical_distance() const { return typical_; }

    /// Groups views by average linkage, as long as groups are no farther apart than learned views
    /// of one class usually are: rather several groups of one class than one of two.
    /// @return the number of the group of each view, in the order of their first views
    /// Errors: as above. Complexity: O(n^2), and as much memory.
    [[nodiscard]] std::vector<std::size_t> groups_of(std::span<const view> views) const {
        return groups_of(views, typical_distance());
    }

    /// The same with another limit: larger ones make fewer and larger groups.
    /// @param limit  the largest distance of groups, the mean of those of their views
    /// @throws std::invalid_argument  as above, or if the limit is negative or NaN
    [[nodiscard]] std::vector<std::size_t> groups_of(std::span<const view> views,
                                                     double limit) const {
        gnomon::detail::require(limit >= 0.0,
                                "view_novelty: the limit must not be negative or NaN");
        std::vector<std::vector<double>> described;
        for (const view& v : views) described.push_back(model_.described(v));
        return average_linkage(
            views.size(),
            [&](std::size_t i, std::size_t j) { return distance_of(described[i], described[j]); },
            limit);
    }

  private:
    static constexpr std::uint32_t no_source = 0xffffffff;  // that no learned view has

    void weigh_columns() {
        const labeled_samples& samples = model_.learned().samples;
        weights_ = model_.trees().use_of_columns(samples.columns);
        const auto n = static_cast<double>(samples.rows());
        for (std::size_t k = 0; k < samples.columns; ++k) {
            double sum = 0.0, squares = 0.0;
            for (std::size_t i = 0; i < samples.rows(); ++i) sum += samples.row(i)[k];
            for (std::size_t i = 0; i < samples.rows(); ++i)
                squares += std::pow(samples.row(i)[k] - sum / n, 2);
            const double deviation = std::sqrt(squares / n);
            // What is the same in all learned views is not used by the trees.
            per_deviation_.push_back(deviation > 0.0 ? 1.0 / deviation : 0.0);
        }
    }

    [[nodiscard]] double distance_of(std::span<const double> a, std::span<const double> b) const {
        constexpr double most = 3.0;  // chosen as in score(): no single number decides
        double sum = 0.0;
        for (std::size_t k = 0; k < weights_.size(); ++k)
            sum += weights_[k] * std::min(most, std::abs(a[k] - b[k]) * per_deviation_[k]);
        return sum;
    }

    /// Grows with novelty. Its numbers are chosen on furniture_models(), views of seeds 1 and 2,
    /// two models withheld.
    /// @param source  whose samples are left out
    [[nodiscard]] double score(std::span<const double> log_likelihood,
                               std::span<const double> sample, std::uint32_t source) const {
        const auto& learned = model_.learned();
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < learned.samples.rows(); ++i)
            if (learned.sources[i] != source)
                nearest = std::min(nearest, distance_of(sample, learned.samples.row(i)));
        const std::vector<double> p = softmax(log_likelihood);
        const double doubt = p.empty() ? 0.0 : 1.0 - *std::max_element(p.begin(), p.end());
        constexpr double least_doubt = 0.02, least_distance = 1e-3, exponent = 2.0;
        return std::log(doubt + least_doubt) + exponent * std::log(nearest + least_distance);
    }

    /// The median distance of learned views of one class and of different scans, of some pairs.
    /// (Chosen as the numbers of score(): larger quantiles join classes.)
    [[nodiscard]] double median_distance() const {
        constexpr std::size_t most = 20'000;  // performance only
        const auto& learned = model_.learned();
        random_stream random(0);
        const auto any = [&] {
            return static_cast<std::size_t>(random.uniform() *
                                            static_cast<double>(learned.samples.rows()));
        };
        std::vector<double> distances{0.0};
        for (std::size_t k = 0; k < most * model_.classes() && distances.size() <= most; ++k) {
            const std::size_t i = any(), j = any();
            if (learned.samples.classes[i] == learned.samples.classes[j] &&
                learned.sources[i] != learned.sources[j])
                distances.push_back(distance_of(learned.samples.row(i), learned.samples.row(j)));
        }
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::nth_element(distances.begin(), middle, distances.end());
        return *middle;
    }

    Recognizer model_;
    std::vector<double> weights_, per_deviation_;  // of each number of a description
    std::vector<double> known_;                    // scores of learned views, ascending
    double typical_ = 0.0;
};

}  // namespace gnomon::recognition

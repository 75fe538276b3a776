// SPDX-License-Identifier: BSL-1.0
/// @file
/// What an object_recognizer has learned, as plain values for a file.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/labeled_samples.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/random_trees_options.hpp>
#include <gnomon/recognition/weighted_distance.hpp>

namespace gnomon::recognition {

/// The name of the class of other things than objects, if views of such are learned.
inline constexpr std::string_view background_name = "background";

/// Options of an object_recognizer.
struct object_recognizer_options {
    random_trees_options trees{};  ///< those of the trees
    /// Distance of the feature vectors of a part from the mean of its word, in units of the scales
    /// of the features; words only name the parts in the evidence.
    double max_word_distance = 1.0;
    double min_probability = 0.90;  ///< P_d of the decisions
};

/// Descriptions of views with their classes, the words of their parts, and the calibration.
template <std::size_t D>
struct learned_views {
    object_recognizer_options options{};       ///< with which they were learned
    std::vector<std::string> names;            ///< of the classes
    std::vector<cluster_statistics<D>> words;  ///< of the parts of all views
    labeled_samples samples;                   ///< descriptions of all views
    std::vector<std::uint32_t> sources;  ///< of each sample, ascending: the scan that it is of
    double temperature = 1.0;            ///< of calibrated probabilities

    /// The options of the trees, with the number of features that are tried at each node: of all
    /// but those of pairs, twice the square root of their number, and of those of pairs as large a
    /// share. So relations have draws of their own, and take the place of nothing else.
    /// @param of_pairs  columns of the samples that describe pairs of parts
    [[nodiscard]] random_trees_options tree_options(std::size_t of_pairs) const {
        random_trees_options result = options.trees;
        if (result.features_per_split > 0 || samples.columns <= of_pairs) return result;
        const auto all = static_cast<double>(samples.columns),
                   others = static_cast<double>(samples.columns - of_pairs);
        result.features_per_split =
            static_cast<std::size_t>(std::round(2.0 * all / std::sqrt(others)));
        return result;
    }

    /// @throws std::invalid_argument  if numbers do not fit together, or are not finite
    void require_consistent() const {
        using gnomon::detail::require;
        const std::size_t n = samples.rows();
        require(names.size() > 1 && n > 0 && sources.size() == n,
                "object_recognizer: samples, classes and sources do not fit together");
        samples.require_valid(names.size());
        require(std::is_sorted(sources.begin(), sources.end()) &&
                    sources.back() < std::numeric_limits<std::uint32_t>::max(),
                "object_recognizer: sources must be ascending, and leave a number for the next");
        require(options.max_word_distance >= 0.0 && std::isfinite(options.max_word_distance),
                "object_recognizer: max_word_distance must be finite and not negative");
        require(options.min_probability >= 0.0 && options.min_probability <= 1.0,
                "object_recognizer: min_probability must be in [0, 1]");
        for (std::size_t c = 0; c < names.size(); ++c)
            require(!names[c].empty() &&
                        std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(c),
                                  names[c]) == names.begin() + static_cast<std::ptrdiff_t>(c),
                    "object_recognizer: a class has no name, or that of another one");
        constexpr double least = 1e-100;  // numerical: evidence divided by it does not overflow
        require(temperature >= least && std::isfinite(temperature),
                "object_recognizer: the temperature must be finite, and at least 1e-100");
        for (const auto& w : words)
            require(w.count > 0 && detail::is_finite_cluster(w),
                    "object_recognizer: a word is not finite");
    }

    /// The number of the word whose mean is nearest; that of no term if there are none. O(words).
    [[nodiscard]] std::size_t nearest_word(const std::array<double, D>& sample,
                                           const weighted_distance<D>& distance) const {
        std::size_t nearest = term::none;
        double least = 0.0;
        for (std::size_t w = 0; w < words.size(); ++w) {
            const double d = distance(words[w].mean, sample);
            if (nearest == term::none || d < least) {
                nearest = w;
                least = d;
            }
        }
        return nearest;
    }

    /// The number of a class, which is new if none has this name.
    [[nodiscard]] std::uint32_t class_number(std::string_view name) {
        const auto at = std::find(names.begin(), names.end(), name);
        const auto number = static_cast<std::uint32_t>(at - names.begin());
        if (at == names.end()) names.emplace_back(name);
        return number;
    }
};

}  // namespace gnomon::recognition

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Probabilities by trees that were not grown on the samples in question.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/recognition/labeled_samples.hpp>
#include <gnomon/recognition/random_trees.hpp>

namespace gnomon::recognition::detail {

/// The log-probabilities of each sample by trees that were not grown on it, in four folds: all
/// samples of one source are left out together. Empty where all samples belong to the same fold.
/// Complexity: that of the trees, four times.
[[nodiscard]] std::vector<std::vector<double>> left_out_log_probabilities(
    const labeled_samples& samples, std::span<const std::uint32_t> sources, std::size_t classes,
    const random_trees_options& options, const auto& run) {
    constexpr std::uint32_t folds = 4;
    std::vector<std::vector<double>> left_out(samples.rows());
    for (std::uint32_t fold = 0; fold < folds; ++fold) {
        labeled_samples others;
        for (std::size_t i = 0; i < left_out.size(); ++i)
            if (sources[i] % folds != fold) others.add(samples.row(i), samples.classes[i]);
        if (others.rows() == 0) continue;
        const random_trees trees(others, classes, options, run);
        for (std::size_t i = 0; i < left_out.size(); ++i)
            if (sources[i] % folds == fold) left_out[i] = trees.log_probability(samples.row(i));
    }
    return left_out;
}

}  // namespace gnomon::recognition::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Extremely randomized trees (Geurts, Ernst and Wehenkel 2006): a classifier of feature vectors.
/// At each node of a tree the threshold of each of a few features is random, and the best of these
/// splits is taken. The probability of a class is its mean share in the leaves that a vector
/// reaches.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/detail/random_tree.hpp>
#include <gnomon/recognition/labeled_samples.hpp>
#include <gnomon/recognition/random_trees_options.hpp>

namespace gnomon::recognition {

/// Trees that were grown on samples.
class random_trees {
  public:
    random_trees() = default;

    /// Grows trees.
    /// @param samples  at least one
    /// @param classes  number of classes, above that of every sample
    /// @param run      the result does not depend on it
    /// @throws std::invalid_argument  if there are no samples or trees, numbers do not fit
    ///                                together, a value is not finite, or a class is too large
    /// Complexity: O(trees * n log(n) * sqrt(columns)) for n samples.
    template <execution X = sequential>
    random_trees(const labeled_samples& samples, std::size_t classes,
                 const random_trees_options& options = {}, const X& run = {})
        : classes_(classes) {
        using gnomon::detail::require;
        require(samples.rows() > 0 && samples.columns > 0, "random_trees: there are no samples");
        samples.require_valid(classes);
        require(options.trees > 0 && options.trees <= trees_.max_size(),
                "random_trees: there must be trees, and no more than fit into memory");
        trees_.resize(options.trees);
        run(options.trees, [&](std::size_t t) {
            detail::tree_grower(samples, options, random_stream(options.seed, t), trees_[t])
                .grow(classes);
        });
    }

    /// The number of classes; 0 without trees, as after these were moved elsewhere.
    [[nodiscard]] std::size_t classes() const { return trees_.empty() ? 0 : classes_; }

    /// Adds to `p` the mean share of each class in the leaves of a sample.
    /// Precondition: the sample is as long as those that the trees were grown on, and p has
    /// classes() values. Complexity: O(trees * depth).
    void add_probability(std::span<const double> sample, std::span<double> p) const {
        const double share = 1.0 / static_cast<double>(trees_.size());
        for (const detail::random_tree& t : trees_) {
            std::uint32_t at = 0;
            while (!t.nodes[at].is_leaf())
                at = sample[t.nodes[at].feature] < t.nodes[at].threshold ? at + 1
                                                                         : t.nodes[at].other;
            const auto& leaf = t.nodes[at];
            for (std::uint32_t i = leaf.other; i < leaf.other + leaf.size; ++i)
                p[t.shares[i].first] += share * t.shares[i].second;
        }
    }

    /// The logarithms of the probabilities of a sample. A class that no tree found has half of the
    /// share of one tree. Complexity: O(trees * depth).
    [[nodiscard]] std::vector<double> log_probability(std::span<const double> sample) const {
        std::vector<double> p(classes(), 0.5 / static_cast<double>(trees_.size()));
        add_probability(sample, p);
        for (double& x : p) x = std::log(x);
        return p;
    }

    /// How much the trees use each column: a node at depth d counts 2^-d. The sum is 1, or 0 if all
    /// trees are leaves. O(nodes).
    /// @param columns  of the samples that the trees were grown on
    [[nodiscard]] std::vector<double> use_of_columns(std::size_t columns) const {
        std::vector<double> use(columns, 0.0);
        double sum = 0.0;
        for (const detail::random_tree& t : trees_) {
            std::vector<double> share(t.nodes.size(), 1.0);
            for (std::size_t at = 0; at < t.nodes.size(); ++at) {
                const auto& n = t.nodes[at];
                if (n.is_leaf()) continue;
                share[at + 1] = share[n.other] = 0.5 * share[at];
                use[n.feature] += share[at];
                sum += share[at];
            }
        }
        if (sum > 0.0)
            for (double& u : use) u /= sum;
        return use;
    }

  private:
    std::size_t classes_ = 0;
    std::vector<detail::random_tree> trees_;
};

}  // namespace gnomon::recognition

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
#include <gnomon/recognition/labeled_samples.hpp>

namespace gnomon::recognition {

/// Options of extremely randomized trees.
struct random_trees_options {
    std::size_t trees = 200;  ///< more are better, and take longer
    std::uint64_t seed = 1;   ///< the same one gives the same trees
    /// Features that are tried at each node; 0 stands for twice the square root of
    /// their number: more than usual, as descriptions of views have features that are alike (chosen
    /// on furniture_models(), seeds 1 and 2).
    std::size_t features_per_split = 0;
    std::size_t min_split = 2;  ///< nodes of fewer samples are leaves
};

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
        : classes_(classes), trees_(options.trees) {
        using gnomon::detail::require;
        require(samples.rows() > 0 && samples.columns > 0, "random_trees: there are no samples");
        samples.require_valid(classes);
        require(options.trees > 0, "random_trees: there must be trees");
        run(options.trees, [&](std::size_t t) {
            grower(samples, options, random_stream(options.seed, t), trees_[t]).grow(classes);
        });
    }

    /// The number of classes; 0 without trees, as after these were moved elsewhere.
    [[nodiscard]] std::size_t classes() const { return trees_.empty() ? 0 : classes_; }

    /// Adds to `p` the mean share of each class in the leaves of a sample.
    /// Precondition: the sample is as long as those that the trees were grown on, and p has
    /// classes() values. Complexity: O(trees * depth).
    void add_probability(std::span<const double> sample, std::span<double> p) const {
        const double share = 1.0 / static_cast<double>(trees_.size());
        for (const tree& t : trees_) {
            std::uint32_t at = 0;
            while (!t.nodes[at].is_leaf())
                at = sample[t.nodes[at].feature] < t.nodes[at].threshold ? at + 1
                                                                         : t.nodes[at].other;
            const node& leaf = t.nodes[at];
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
        for (const tree& t : trees_) {
            std::vector<double> share(t.nodes.size(), 1.0);
            for (std::size_t at = 0; at < t.nodes.size(); ++at) {
                const node& n = t.nodes[at];
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
    static constexpr std::uint32_t leaf_mark = 0xffffffff;

    /// The lower child of a node follows it; the other one has a number.
    struct node {
        std::uint32_t feature = leaf_mark;
        std::uint32_t other = 0;  ///< upper child, or first share of a leaf
        std::uint32_t size = 0;   ///< number of shares of a leaf
        double threshold = 0.0;
        [[nodiscard]] bool is_leaf() const { return feature == leaf_mark; }
    };

    struct tree {
        std::vector<node> nodes;
        std::vector<std::pair<std::uint32_t, double>> shares;  ///< class and its share in a leaf
    };

    /// Grows one tree.
    class grower {
      public:
        grower(const labeled_samples& samples, const random_trees_options& options,
               random_stream random, tree& result)
            : samples_(samples), options_(options), random_(random), tree_(result) {}

        void grow(std::size_t classes) {
            counts_.resize(classes);
            lower_.resize(classes);
            rows_.resize(samples_.rows());
            std::iota(rows_.begin(), rows_.end(), std::size_t{0});
            features_.resize(samples_.columns);
            std::iota(features_.begin(), features_.end(), std::uint32_t{0});
            // Upper children wait here; a tree of n leaves is no deeper than n.
            std::vector<pending> stack{{0, rows_.size(), no_parent}};
            while (!stack.empty()) {
                const pending p = stack.back();
                stack.pop_back();
                const auto at = static_cast<std::uint32_t>(tree_.nodes.size());
                if (p.parent != no_parent) tree_.nodes[p.parent].other = at;
                tree_.nodes.emplace_back();
                const std::size_t middle = split(p.begin, p.end, tree_.nodes[at]);
                if (middle == p.end) {
                    make_leaf(tree_.nodes[at]);
                } else {
                    stack.push_back({middle, p.end, at});
                    stack.push_back({p.begin, middle, no_parent});
                }
            }
        }

      private:
        static constexpr std::uint32_t no_parent = leaf_mark;
        struct pending {
            std::size_t begin, end;
            std::uint32_t parent;  ///< of an upper child
        };

        /// The shares of the classes that were counted by split().
        void make_leaf(node& leaf) {
            leaf.other = static_cast<std::uint32_t>(tree_.shares.size());
            const double n = std::accumulate(counts_.begin(), counts_.end(), 0.0);
            for (std::size_t c = 0; c < counts_.size(); ++c) {
                if (counts_[c] > 0.0)
                    tree_.shares.emplace_back(static_cast<std::uint32_t>(c), counts_[c] / n);
            }
            leaf.size = static_cast<std::uint32_t>(tree_.shares.size()) - leaf.other;
        }

        [[nodiscard]] double value(std::size_t row, std::uint32_t feature) const {
            return samples_.values[row * samples_.columns + feature];
        }

        /// Splits the rows of a node by the best of some features that vary, each with a
        /// random threshold.
        /// @return where the upper rows begin; `end` if the node is a leaf
        std::size_t split(std::size_t begin, std::size_t end, node& at) {
            std::fill(counts_.begin(), counts_.end(), 0.0);
            for (std::size_t i = begin; i < end; ++i) counts_[samples_.classes[rows_[i]]] += 1.0;
            const auto n = static_cast<double>(end - begin);
            const bool is_pure = std::any_of(counts_.begin(), counts_.end(),
                                             [n](double count) { return count == n; });
            if (is_pure || end - begin < options_.min_split) return end;

            const auto root = std::sqrt(static_cast<double>(samples_.columns));
            const std::size_t wanted = options_.features_per_split > 0
                                           ? options_.features_per_split
                                           : static_cast<std::size_t>(std::round(2.0 * root));
            double best = -1.0;
            std::size_t tried = 0;
            for (std::size_t k = 0; k < features_.size() && tried < wanted; ++k) {
                const auto left = static_cast<double>(features_.size() - k);
                const auto j = k + static_cast<std::size_t>(random_.uniform() * left);
                std::swap(features_[k], features_[j]);
                const std::uint32_t f = features_[k];
                double low = value(rows_[begin], f), high = low;
                for (std::size_t i = begin; i < end; ++i) {
                    low = std::min(low, value(rows_[i], f));
                    high = std::max(high, value(rows_[i], f));
                }
                if (!(low < high)) continue;
                ++tried;
                const double threshold = high - (high - low) * random_.uniform();  // in (low, high]
                if (!(threshold > low)) continue;
                const double purity = purity_below(begin, end, f, threshold);
                if (purity > best) {
                    best = purity;
                    at.feature = f;
                    at.threshold = threshold;
                }
            }
            if (best < 0.0) return end;
            const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(begin);
            const auto last = rows_.begin() + static_cast<std::ptrdiff_t>(end);
            const auto middle = std::stable_partition(first, last, [&](std::size_t row) {
                return value(row, at.feature) < at.threshold;
            });
            return static_cast<std::size_t>(middle - rows_.begin());
        }

        /// The sum of squared counts over the counts of both sides: n times one minus the Gini
        /// impurity.
        double purity_below(std::size_t begin, std::size_t end, std::uint32_t f, double threshold) {
            std::fill(lower_.begin(), lower_.end(), 0.0);
            double below = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                if (!(value(rows_[i], f) < threshold)) continue;
                lower_[samples_.classes[rows_[i]]] += 1.0;
                below += 1.0;
            }
            const double above = static_cast<double>(end - begin) - below;
            double purity = 0.0;
            for (std::size_t c = 0; c < counts_.size(); ++c) {
                const double upper = counts_[c] - lower_[c];
                purity += lower_[c] * lower_[c] / below + upper * upper / above;
            }
            return purity;
        }

        const labeled_samples& samples_;
        const random_trees_options& options_;
        random_stream random_;
        tree& tree_;
        std::vector<std::size_t> rows_;
        std::vector<std::uint32_t> features_;
        std::vector<double> counts_, lower_;
    };

    std::size_t classes_ = 0;
    std::vector<tree> trees_;
};

}  // namespace gnomon::recognition

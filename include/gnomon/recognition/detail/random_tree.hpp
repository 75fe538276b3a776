// SPDX-License-Identifier: BSL-1.0
/// @file
/// One extremely randomized tree, and how it grows; see random_trees.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/labeled_samples.hpp>
#include <gnomon/recognition/random_trees_options.hpp>

namespace gnomon::recognition::detail {

inline constexpr std::uint32_t leaf_mark = 0xffffffff;

/// The lower child of a node follows it; the other one has a number.
struct tree_node {
    std::uint32_t feature = leaf_mark;
    std::uint32_t other = 0;  ///< upper child, or first share of a leaf
    std::uint32_t size = 0;   ///< number of shares of a leaf
    double threshold = 0.0;
    [[nodiscard]] bool is_leaf() const { return feature == leaf_mark; }
};

struct random_tree {
    std::vector<tree_node> nodes;
    std::vector<std::pair<std::uint32_t, double>> shares;  ///< class and its share in a leaf
};

/// Grows one tree.
class tree_grower {
  public:
    tree_grower(const labeled_samples& samples, const random_trees_options& options,
                random_stream random, random_tree& result)
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
    void make_leaf(tree_node& leaf) {
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
    std::size_t split(std::size_t begin, std::size_t end, tree_node& at) {
        std::fill(counts_.begin(), counts_.end(), 0.0);
        for (std::size_t i = begin; i < end; ++i) counts_[samples_.classes[rows_[i]]] += 1.0;
        const auto n = static_cast<double>(end - begin);
        const bool is_pure =
            std::any_of(counts_.begin(), counts_.end(), [n](double count) { return count == n; });
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
        const auto middle = std::stable_partition(
            first, last, [&](std::size_t row) { return value(row, at.feature) < at.threshold; });
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
    random_tree& tree_;
    std::vector<std::size_t> rows_;
    std::vector<std::uint32_t> features_;
    std::vector<double> counts_, lower_;
};

}  // namespace gnomon::recognition::detail

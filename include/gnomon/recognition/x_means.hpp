// SPDX-License-Identifier: BSL-1.0
/// @file
/// x-means clustering: k-means whose number of clusters is chosen by the Bayesian information
/// criterion (Pelleg and Moore 2000). It is the comparator of greedy means, which Klasing 2010,
/// Sec. 5.8, prefers: words are not spherical, and a threshold generalizes better than a number.
///
///     const auto found = gnomon::recognition::x_means(samples, {.seed = 7});
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/detail/k_means.hpp>
#include <gnomon/recognition/detail/samples.hpp>

namespace gnomon::recognition {

/// Options of x-means.
struct x_means_options {
    std::size_t min_clusters = 2;    ///< to start with, at least 1; chosen, docs/thesis-notes.md
    std::size_t max_clusters = 200;  ///< not below min_clusters; chosen
    std::uint64_t seed = 1;          ///< of the first centers and of the directions of splits
};

namespace detail {

/// A cluster with the two that it may be split into, and the criterion gained by that.
template <std::size_t D>
struct cluster_split {
    std::size_t cluster;
    double gain;
    std::vector<std::array<double, D>> centers;
};

/// Splits a cluster by k-means from two centers at opposite sides of its mean, one standard
/// deviation away along a random direction.
template <std::size_t D>
[[nodiscard]] cluster_split<D> split_of(sample_span<D> samples, const k_means_result<D>& model,
                                        std::size_t cluster, random_stream& random) {
    const cluster_statistics<D>& parent = model.clusters[cluster];
    std::array<double, D> direction;
    double length = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < D; ++i) {
        direction[i] = random.gaussian();
        length += direction[i] * direction[i];
        squares += parent.scatter[i][i];
    }
    const double step = std::sqrt(squares / (static_cast<double>(parent.count) * length));
    std::vector<std::array<double, D>> two(2, parent.mean);
    for (std::size_t i = 0; i < D; ++i) {
        two[0][i] += step * direction[i];
        two[1][i] -= step * direction[i];
    }
    const k_means_result<D> children = k_means<D>(samples, model.members[cluster], std::move(two));
    const double before = information_criterion<D>({parent});
    const double after = information_criterion(children.clusters);
    // Of a parent without variance nothing can be gained.
    const double gain = children.clusters.size() == 2 && after > before ? after - before : 0.0;
    return {cluster, gain, children.centers()};
}

/// The centers of a model after the splits that gain most, each the best of several random
/// directions; `most` centers at most.
template <std::size_t D>
[[nodiscard]] std::vector<std::array<double, D>> split_centers(sample_span<D> samples,
                                                               const k_means_result<D>& model,
                                                               std::size_t most,
                                                               random_stream& random) {
    // Chosen: with one, as in the paper, k-means often ends in a split that the criterion rejects.
    constexpr int directions = 4;
    std::vector<cluster_split<D>> splits;
    for (std::size_t c = 0; c < model.clusters.size(); ++c) {
        cluster_split<D> best{c, 0.0, {}};
        for (int i = 0; i < directions; ++i) {
            cluster_split<D> split = split_of(samples, model, c, random);
            if (split.gain > best.gain) best = std::move(split);
        }
        if (best.gain > 0.0) splits.push_back(std::move(best));
    }
    std::ranges::stable_sort(splits, [](const auto& a, const auto& b) { return a.gain > b.gain; });
    std::vector<std::array<double, D>> centers = model.centers();
    for (const auto& split : splits) {
        if (centers.size() >= most) break;
        centers[split.cluster] = split.centers[0];
        centers.push_back(split.centers[1]);
    }
    return centers;
}

/// Clusters by number of their first samples.
template <std::size_t D>
[[nodiscard]] clustering<D> labeled(k_means_result<D> model, std::size_t samples) {
    std::vector<std::size_t> order(model.members.size());
    for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
    std::ranges::sort(order, {}, [&](std::size_t c) { return model.members[c].front(); });
    clustering<D> found;
    found.labels.assign(samples, clustering<D>::pruned);
    for (const std::size_t c : order) {
        for (const std::size_t i : model.members[c])
            found.labels[i] = static_cast<std::ptrdiff_t>(found.clusters.size());
        found.clusters.push_back(model.clusters[c]);
    }
    return found;
}

}  // namespace detail

/// Clusters samples by x-means. From k-means with `min_clusters`, each cluster is split in two
/// where that raises the criterion within it, then k-means is repeated with all centers, until no
/// cluster is split or there are `max_clusters`. The result is that of largest criterion over all
/// samples.
///
/// @param samples  a contiguous range of n samples, `std::array<double, D>`, in scaled features
/// @param options  range of the number of clusters, seed
/// @return clusters in the order of their first samples; no sample is pruned. Fewer than
///         `min_clusters` if there are fewer distinct samples
/// @throws std::invalid_argument  if a value of a sample is not finite or above 1e100, or
///         min_clusters is 0 or above max_clusters
/// Complexity: O(n D c) for each of at most 100 steps of k-means in each round. Source: Pelleg and
/// Moore 2000.
template <detail::sample_range R>
[[nodiscard]] clustering<detail::dimension<R>> x_means(const R& samples,
                                                       const x_means_options& options = {}) {
    constexpr std::size_t D = detail::dimension<R>;
    gnomon::detail::require(options.min_clusters > 0, "x_means: min_clusters must be at least 1");
    gnomon::detail::require(options.max_clusters >= options.min_clusters,
                            "x_means: max_clusters is below min_clusters");
    detail::require_usable(samples, "x_means: a sample is not finite or too large");
    const detail::sample_span<D> p(samples);
    if (p.empty()) return {};
    std::vector<std::size_t> all(p.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    random_stream random(options.seed);
    auto model =
        detail::k_means<D>(p, all, detail::spread_centers<D>(p, options.min_clusters, random));
    auto best = model;
    double largest = detail::information_criterion(model.clusters);
    // Rounds are limited as well: k-means may drop centers that a split has added.
    for (std::size_t round = 0;
         round < options.max_clusters && model.clusters.size() < options.max_clusters; ++round) {
        auto centers = detail::split_centers(p, model, options.max_clusters, random);
        if (centers.size() == model.clusters.size()) break;
        model = detail::k_means<D>(p, all, std::move(centers));
        const double criterion = detail::information_criterion(model.clusters);
        if (criterion > largest) {
            largest = criterion;
            best = model;
        }
    }
    return detail::labeled(std::move(best), p.size());
}

}  // namespace gnomon::recognition

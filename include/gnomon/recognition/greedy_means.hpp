// SPDX-License-Identifier: BSL-1.0
/// @file
/// Greedy means clustering: samples within a distance of the mean of a cluster are merged with it.
/// Two algorithms with the same options. `greedy_means` is Alg. 5.1, literally: one cluster after
/// the other is grown over all samples that are left. `streaming_greedy_means` takes the samples
/// one by one, each into the cluster of the nearest mean; it is what the thesis's requirement of
/// incremental learning (Sec. 5.2.3) leads to, and is not Alg. 5.1. The results of both depend on
/// the order of the samples.
///
///     const auto found = gnomon::recognition::greedy_means(samples, {.max_distance = 0.03});
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/detail/samples.hpp>
#include <gnomon/recognition/weighted_distance.hpp>

namespace gnomon::recognition {

/// Options of greedy means clustering. Klasing 2010, Secs. 5.2.3 and 5.6.
template <std::size_t D>
struct greedy_means_options {
    double max_distance = 0.10;       ///< rho_max, from the mean at the time of merging
    std::size_t min_members = 4;      ///< n_min: clusters of fewer samples are pruned
    weighted_distance<D> distance{};  ///< rho, Eq. (5.2)
};

namespace detail {

template <std::size_t D>
void require_options(const greedy_means_options<D>& options) {
    gnomon::detail::require(options.max_distance >= 0.0 && std::isfinite(options.max_distance),
                            "greedy_means: max_distance must be finite and not negative");
    options.distance.require_weights();
}

/// Without the clusters of fewer than `min_members` samples.
template <std::size_t D>
[[nodiscard]] clustering<D> without_small(clustering<D> all, std::size_t min_members) {
    std::vector<std::ptrdiff_t> renamed(all.clusters.size(), clustering<D>::pruned);
    std::size_t kept = 0;
    for (std::size_t c = 0; c < all.clusters.size(); ++c) {
        if (all.clusters[c].count < min_members) continue;
        renamed[c] = static_cast<std::ptrdiff_t>(kept);
        all.clusters[kept++] = all.clusters[c];
    }
    all.clusters.resize(kept);
    for (std::ptrdiff_t& label : all.labels) label = renamed[static_cast<std::size_t>(label)];
    return all;
}

}  // namespace detail

/// Clusters samples by Alg. 5.1. The first sample without a cluster starts one; all samples after
/// it that have none are visited in their order, and merged if they are within `max_distance` of
/// the mean as it is then. Scatter is updated with the mean, not computed at the end.
///
/// @param samples  a contiguous range of n samples, `std::array<double, D>`
/// @param options  threshold, least number of members, weights
/// @return clusters of at least `min_members` samples, in the order of their first samples; other
///         samples are labeled `pruned`
/// @throws std::invalid_argument  if a value of a sample is not finite or above 1e100, max_distance
///         is negative or not finite, a weight is negative, or all are 0
/// Complexity: O(n (D c + D^2)) for c clusters before pruning. Source: Klasing 2010, Alg. 5.1.
template <detail::sample_range R>
[[nodiscard]] clustering<detail::dimension<R>> greedy_means(
    const R& samples, const greedy_means_options<detail::dimension<R>>& options = {}) {
    constexpr std::size_t D = detail::dimension<R>;
    detail::require_options(options);
    detail::require_usable(samples, "greedy_means: a sample is not finite or too large");
    const std::span<const std::array<double, D>> p(samples);
    clustering<D> found;
    found.labels.assign(p.size(), clustering<D>::pruned);
    std::vector<std::size_t> left(p.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
    while (!left.empty()) {
        const auto label = static_cast<std::ptrdiff_t>(found.clusters.size());
        cluster_statistics<D> cluster;
        // The first sample is merged too: its cluster is empty.
        std::erase_if(left, [&](std::size_t j) {
            const bool is_near =
                cluster.count == 0 || options.distance(cluster.mean, p[j]) <= options.max_distance;
            if (is_near) {
                cluster.add(p[j]);
                found.labels[j] = label;
            }
            return is_near;
        });
        found.clusters.push_back(cluster);
    }
    return detail::without_small(std::move(found), options.min_members);
}

/// Clusters samples one by one: each is merged with the cluster of the nearest mean (of equal ones,
/// the oldest) if that is within `max_distance`, or else starts a cluster. Clusters keep their
/// numbers and are not pruned: `min_members` is left to those that use them, as clusters grow. With
/// the clusters of an earlier run it continues as if it had not been interrupted, to the last bit.
///
///     gnomon::recognition::streaming_greedy_means<5> words({.max_distance = 0.03});
///     for (const auto& sample : samples) labels.push_back(words.add(sample));
template <std::size_t D>
class streaming_greedy_means {
  public:
    /// @param options   threshold and weights
    /// @param clusters  those of an earlier run with the same options, or none
    /// @throws std::invalid_argument  as `greedy_means`, or if a cluster is empty or not finite
    explicit streaming_greedy_means(const greedy_means_options<D>& options = {},
                                    std::vector<cluster_statistics<D>> clusters = {})
        : options_(options), clusters_(std::move(clusters)) {
        detail::require_options(options_);
        for (const auto& c : clusters_)
            gnomon::detail::require(c.count > 0 && detail::is_finite_cluster(c),
                                    "streaming_greedy_means: a cluster is empty or not finite");
    }

    /// Merges a sample with a cluster, or starts one.
    /// @return the number of its cluster
    /// @throws std::invalid_argument  if a value is not finite or above 1e100; nothing is changed
    /// Complexity: O(D c + D^2) for c clusters.
    std::size_t add(const std::array<double, D>& sample) {
        gnomon::detail::require(detail::is_usable(sample),
                                "streaming_greedy_means: a sample is not finite or too large");
        std::size_t nearest = clusters_.size();
        double least = options_.max_distance;
        for (std::size_t c = 0; c < clusters_.size(); ++c) {
            const double d = options_.distance(clusters_[c].mean, sample);
            if (d < least || (d == least && nearest == clusters_.size())) {
                least = d;
                nearest = c;
            }
        }
        if (nearest == clusters_.size()) clusters_.emplace_back();
        clusters_[nearest].add(sample);
        return nearest;
    }

    /// All clusters, in the order of their first samples.
    [[nodiscard]] const std::vector<cluster_statistics<D>>& clusters() const { return clusters_; }

  private:
    greedy_means_options<D> options_;
    std::vector<cluster_statistics<D>> clusters_;
};

}  // namespace gnomon::recognition

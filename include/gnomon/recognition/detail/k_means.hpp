// SPDX-License-Identifier: BSL-1.0
/// @file
/// k-means clustering (Lloyd 1982) of some of the samples, and the Bayesian information criterion
/// of its result.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/cluster.hpp>

namespace gnomon::recognition::detail {

template <std::size_t D>
using sample_span = std::span<const std::array<double, D>>;

template <std::size_t D>
[[nodiscard]] double squared_distance(const std::array<double, D>& a,
                                      const std::array<double, D>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/// The number of the center nearest to x; of equal ones, the first.
template <std::size_t D>
[[nodiscard]] std::size_t nearest_center(const std::vector<std::array<double, D>>& centers,
                                         const std::array<double, D>& x) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < centers.size(); ++c) {
        const double d = squared_distance(centers[c], x);
        if (d < least) {
            least = d;
            nearest = c;
        }
    }
    return nearest;
}

/// Samples of one model: the members of each cluster, none of which is empty, and its statistics.
template <std::size_t D>
struct k_means_result {
    std::vector<std::vector<std::size_t>> members;
    std::vector<cluster_statistics<D>> clusters;

    [[nodiscard]] std::vector<std::array<double, D>> centers() const {
        std::vector<std::array<double, D>> means;
        for (const auto& c : clusters) means.push_back(c.mean);
        return means;
    }
};

/// Assigns samples to the nearest of some centers, which then move to the means of their clusters,
/// until no sample changes its cluster. Centers without samples are dropped.
/// @param chosen   the samples that take part, not empty
/// @param centers  to start with, not empty
template <std::size_t D>
[[nodiscard]] k_means_result<D> k_means(sample_span<D> samples, std::span<const std::size_t> chosen,
                                        std::vector<std::array<double, D>> centers) {
    constexpr int most = 100;  // performance only: later steps move few samples
    k_means_result<D> result;
    for (int step = 0; step < most; ++step) {
        k_means_result<D> next;
        next.members.resize(centers.size());
        next.clusters.resize(centers.size());
        for (const std::size_t i : chosen) {
            const std::size_t c = nearest_center(centers, samples[i]);
            next.members[c].push_back(i);
            next.clusters[c].add(samples[i]);
        }
        std::erase_if(next.members, [](const auto& m) { return m.empty(); });
        std::erase_if(next.clusters, [](const auto& c) { return c.count == 0; });
        const bool is_stable = next.members == result.members;
        result = std::move(next);
        if (is_stable) break;
        centers = result.centers();
    }
    return result;
}

/// Centers to start with: the first at random, each other a sample with a probability proportional
/// to its squared distance from the centers before it (k-means++, Arthur and Vassilvitskii 2007).
/// @return at most k, fewer if there are fewer distinct samples
template <std::size_t D>
[[nodiscard]] std::vector<std::array<double, D>> spread_centers(sample_span<D> samples,
                                                                std::size_t k,
                                                                random_stream& random) {
    const auto n = static_cast<double>(samples.size());
    std::vector<std::array<double, D>> centers{
        samples[static_cast<std::size_t>(random.uniform() * n)]};
    std::vector<double> squared(samples.size(), std::numeric_limits<double>::infinity());
    while (centers.size() < k) {
        double total = 0.0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            squared[i] = std::min(squared[i], squared_distance(centers.back(), samples[i]));
            total += squared[i];
        }
        if (!(total > 0.0)) break;
        double left = random.uniform() * total;
        std::size_t last = 0;
        for (std::size_t i = 0; i < samples.size() && left >= 0.0; ++i) {
            if (squared[i] == 0.0) continue;
            left -= squared[i];
            last = i;
        }
        centers.push_back(samples[last]);
    }
    return centers;
}

/// The Bayesian information criterion, log likelihood - p / 2 log R, of spherical normal
/// distributions with one variance (Pelleg and Moore 2000, Sec. 3.2). For clusters of R_n samples,
/// R in all, K clusters in D dimensions, the variance of a coordinate is
/// s^2 = (squared distances from the means) / (D (R - K)),
/// log likelihood = sum R_n log(R_n / R) - R D / 2 log(2 pi s^2) - D (R - K) / 2, and
/// p = (K - 1) + D K + 1. (The paper's s^2 lacks the factor D, which its log likelihood needs.)
/// @return infinity if all samples are at their means; -infinity if there are no more samples than
///         clusters, which have no variance
template <std::size_t D>
[[nodiscard]] double information_criterion(const std::vector<cluster_statistics<D>>& clusters) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr auto d = static_cast<double>(D);
    const auto k = static_cast<double>(clusters.size());
    double n = 0.0, squares = 0.0, mixture = 0.0;
    for (const auto& c : clusters) {
        n += static_cast<double>(c.count);
        for (std::size_t i = 0; i < D; ++i) squares += c.scatter[i][i];
    }
    if (n <= k) return -infinity;
    if (squares <= 0.0) return infinity;
    for (const auto& c : clusters) {
        const auto m = static_cast<double>(c.count);
        mixture += m * std::log(m / n);
    }
    const double variance = squares / (d * (n - k));
    return mixture - 0.5 * n * d * std::log(2.0 * std::numbers::pi * variance) - 0.5 * d * (n - k) -
           0.5 * (k - 1.0 + d * k + 1.0) * std::log(n);
}

}  // namespace gnomon::recognition::detail

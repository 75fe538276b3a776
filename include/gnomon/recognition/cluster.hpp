// SPDX-License-Identifier: BSL-1.0
/// @file
/// The result of a clustering: count, mean and scatter of each cluster, and the cluster of each
/// sample.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/square_array.hpp>
#include <gnomon/recognition/detail/samples.hpp>

namespace gnomon::recognition {

/// The sufficient statistics of a cluster of samples, updated sample by sample or cluster by
/// cluster (Welford 1962; Chan, Golub and LeVeque 1983). What was added first determines the last
/// bits: the same samples in the same order give the same bytes.
template <std::size_t D>
struct cluster_statistics {
    std::size_t count = 0;                      ///< samples
    std::array<double, D> mean{};               ///< of the samples
    gnomon::detail::square_array<D> scatter{};  ///< sum of (x - mean) (x - mean)^T, symmetric

    /// Adds the samples of another cluster. The weights of the means are those of the counts before
    /// the union, and the scatter grows by the term of the parallel axes,
    /// n m / (n + m) (a - b) (a - b)^T. O(D^2).
    void merge(const cluster_statistics& other) {
        if (other.count == 0) return;
        const auto n = static_cast<double>(count), m = static_cast<double>(other.count);
        count += other.count;
        std::array<double, D> d;
        for (std::size_t i = 0; i < D; ++i) d[i] = other.mean[i] - mean[i];
        const double part = m / (n + m), axes = n * part;
        for (std::size_t i = 0; i < D; ++i) {
            // The mean of the first sample is the sample, without the rounding of a difference.
            mean[i] = n == 0.0 ? other.mean[i] : mean[i] + part * d[i];
            for (std::size_t j = 0; j < D; ++j)
                scatter[i][j] += other.scatter[i][j] + axes * (d[i] * d[j]);
        }
    }

    /// Adds one sample. O(D^2).
    void add(const std::array<double, D>& x) { merge(cluster_statistics{1, x, {}}); }

    /// scatter / count, the covariance of Alg. 5.1, line 11; zero of an empty cluster.
    [[nodiscard]] gnomon::detail::square_array<D> covariance() const {
        gnomon::detail::square_array<D> c{};
        for (std::size_t i = 0; i < D; ++i) {
            for (std::size_t j = 0; j < D; ++j)
                c[i][j] = count == 0 ? 0.0 : scatter[i][j] / static_cast<double>(count);
        }
        return c;
    }

    friend bool operator==(const cluster_statistics&, const cluster_statistics&) = default;
};

/// A partition of samples into clusters, some of which may have been pruned.
template <std::size_t D>
struct clustering {
    static constexpr std::ptrdiff_t pruned = -1;  ///< label of samples of pruned clusters

    std::vector<cluster_statistics<D>> clusters;  ///< in the order of their first samples
    std::vector<std::ptrdiff_t> labels;           ///< of each sample: its cluster, or `pruned`

    /// The samples with a label, ascending. O(number of samples).
    [[nodiscard]] std::vector<std::size_t> members(std::ptrdiff_t label) const {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < labels.size(); ++i)
            if (labels[i] == label) found.push_back(i);
        return found;
    }
};

namespace detail {

/// Whether mean and scatter are small enough that sums of products of them do not overflow, and the
/// count that it is exact in double precision and can grow.
template <std::size_t D>
[[nodiscard]] bool is_finite_cluster(const cluster_statistics<D>& c) {
    constexpr double largest = 1e250;  // numerical: against overflow
    constexpr std::size_t most = std::size_t{1} << (sizeof(std::size_t) > 4 ? 52 : 30);  // the same
    if (c.count > most) return false;
    for (const auto& row : c.scatter)
        for (const double entry : row)
            if (!(std::abs(entry) <= largest)) return false;
    return is_usable(c.mean);
}

}  // namespace detail

}  // namespace gnomon::recognition

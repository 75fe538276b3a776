// SPDX-License-Identifier: BSL-1.0
/// @file
/// The vocabulary of part words: clusters of feature vectors, with covariances that can be
/// inverted, and their detection in new samples by the Mahalanobis distance. Klasing 2010,
/// Sec. 5.3.1.
///
///     const auto words = gnomon::recognition::make_vocabulary<5>(found.clusters);
///     for (const auto& d : words.detections(sample)) use(d.word, d.distance);
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/square_array.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/detail/chi_squared.hpp>
#include <gnomon/recognition/detail/cholesky.hpp>
#include <gnomon/recognition/detail/samples.hpp>

namespace gnomon::recognition {

/// How the covariance of a word becomes positive definite. A word of n members in D > n - 1
/// features has a singular one.
enum class covariance_repair {
    /// Shrinkage to the pooled covariance of all words: the mean of the posterior with an inverse
    /// Wishart prior, as in regularized discriminant analysis (Friedman 1989).
    pooled,
    /// Added variance eps^2 of each feature, eps = max(0.01, rho_max / 3): the thesis's covariance,
    /// Alg. 5.1, line 11, made regular.
    diagonal
};

/// Options of a vocabulary. Features are taken as scaled to about [0, 1], Eq. (5.1).
struct vocabulary_options {
    std::size_t min_members = 4;  ///< n_min: smaller clusters become no words; at least 1
    covariance_repair repair = covariance_repair::pooled;  ///< of words with few examples
    /// Weight of the pooled covariance, in members of a cluster; positive. Chosen: about the number
    /// of features.
    double pooled_members = 5.0;
    double min_deviation = 1e-3;  ///< standard deviation added to the pooled one; chosen
    double max_distance = 0.10;   ///< rho_max of the clustering, for covariance_repair::diagonal
    double inlier_probability = 0.99;  ///< of Gaussian samples of a word, in (0, 1); Sec. 5.6.2
};

/// A word: the statistics of a cluster, and the metric of its Mahalanobis distance.
template <std::size_t D>
struct word {
    std::size_t cluster = 0;           ///< its number among the clusters it was made from
    cluster_statistics<D> statistics;  ///< count, mean and scatter
    gnomon::detail::square_array<D>
        inverse_covariance{};  ///< of the repaired covariance, positive definite
};

/// A word that a sample may be an example of.
struct detection {
    std::size_t word = 0;   ///< its number in the vocabulary
    double distance = 0.0;  ///< Mahalanobis distance of the sample from its mean, Eq. (5.3)
};

/// The words, and the distance within which they are detected. Plain values: a vocabulary is stored
/// and read again member by member.
template <std::size_t D>
struct vocabulary {
    std::vector<word<D>> words;  ///< by their number
    double max_distance = 0.0;   ///< delta_p, a Mahalanobis distance

    /// All words within `max_distance` of a sample, by their numbers: one, several or none.
    /// @throws std::invalid_argument  if a value of the sample is not finite or above 1e100
    /// Complexity: O(D^2) for each word. Source: Klasing 2010, Eq. (5.3).
    [[nodiscard]] std::vector<detection> detections(const std::array<double, D>& sample) const {
        std::vector<detection> found;
        for_each_distance(sample, [&](const detection& d) {
            if (d.distance <= max_distance) found.push_back(d);
        });
        return found;
    }

    /// The word of smallest Mahalanobis distance, however large (of equal ones, the first); none
    /// without words.
    /// @throws std::invalid_argument  as `detections`
    [[nodiscard]] std::optional<detection> nearest(const std::array<double, D>& sample) const {
        std::optional<detection> best;
        for_each_distance(sample, [&](const detection& d) {
            if (!best || d.distance < best->distance) best = d;
        });
        return best;
    }

  private:
    void for_each_distance(const std::array<double, D>& x, const auto& use) const {
        gnomon::detail::require(detail::is_usable(x),
                                "vocabulary: a sample is not finite or too large");
        for (std::size_t w = 0; w < words.size(); ++w) {
            const auto& mean = words[w].statistics.mean;
            double squared = 0.0;
            for (std::size_t i = 0; i < D; ++i) {
                for (std::size_t j = 0; j < D; ++j)
                    squared +=
                        (x[i] - mean[i]) * words[w].inverse_covariance[i][j] * (x[j] - mean[j]);
            }
            use(detection{w, std::sqrt(std::max(squared, 0.0))});
        }
    }
};

namespace detail {

inline void require_options(const vocabulary_options& o) {
    using gnomon::detail::require;
    require(o.min_members > 0, "make_vocabulary: min_members must be at least 1");
    require(o.pooled_members > 0.0 && std::isfinite(o.pooled_members),
            "make_vocabulary: pooled_members must be finite and positive");
    require(o.min_deviation > 0.0 && std::isfinite(o.min_deviation),
            "make_vocabulary: min_deviation must be finite and positive");
    require(o.max_distance >= 0.0 && std::isfinite(o.max_distance),
            "make_vocabulary: max_distance must be finite and not negative");
    require(o.inlier_probability > 0.0 && o.inlier_probability < 1.0,
            "make_vocabulary: inlier_probability must be in (0, 1)");
}

/// The scatter of all words within them, by their degrees of freedom: the covariance that they
/// share, and the added variance of each feature.
template <std::size_t D>
[[nodiscard]] square_array<D> pooled_covariance(const std::vector<word<D>>& words,
                                                double min_deviation) {
    square_array<D> pooled{};
    double freedom = 0.0;
    for (const auto& w : words) freedom += static_cast<double>(w.statistics.count - 1);
    for (std::size_t i = 0; i < D; ++i) {
        for (std::size_t j = 0; j < D; ++j) {
            for (const auto& w : words) pooled[i][j] += w.statistics.scatter[i][j];
            if (freedom > 0.0) pooled[i][j] /= freedom;
        }
        pooled[i][i] += min_deviation * min_deviation;
    }
    return pooled;
}

/// The inverse of a covariance. Where the variance of a feature exceeds the added one by more than
/// the digits of a double, and the matrix is singular up to rounding, the diagonal is enlarged.
/// @throws std::invalid_argument  if it is not singular but indefinite, which no scatter is
template <std::size_t D>
[[nodiscard]] square_array<D> regular_inverse(square_array<D> covariance) {
    constexpr double ridge = 1e-9;  // numerical: above the rounding of a scatter
    constexpr int most = 1000;      // numerical: a millionth of the diagonal; rounding takes one
    cholesky<D> factor(covariance);
    for (int step = 0; !factor.is_positive_definite(); ++step) {
        gnomon::detail::require(step < most, "make_vocabulary: a scatter is indefinite");
        for (std::size_t i = 0; i < D; ++i) covariance[i][i] *= 1.0 + ridge;
        factor = cholesky<D>(covariance);
    }
    return factor.inverse();
}

}  // namespace detail

/// Makes words of clusters, those of greedy means (batch or streaming) or of x-means.
///
/// With covariance_repair::pooled, the covariance of a word is
/// (scatter + v P) / (count - 1 + v), where v is `pooled_members` and P the scatter within all
/// words by its degrees of freedom. With covariance_repair::diagonal it is scatter / count + eps^2
/// I. The threshold is the square root of the chi^2 quantile of D degrees of freedom at
/// `inlier_probability`.
///
/// @param clusters  with finite mean and scatter
/// @param options   least number of members, covariance, probability of the threshold
/// @return a word for each cluster of at least `min_members` samples, in their order
/// @throws std::invalid_argument  if an option is out of its range, a cluster is not finite, or its
///                                scatter is clearly not positive semidefinite
/// Complexity: O(D^3) for each cluster. Source: Klasing 2010, Sec. 5.3.1.
template <std::size_t D>
[[nodiscard]] vocabulary<D> make_vocabulary(const std::vector<cluster_statistics<D>>& clusters,
                                            const vocabulary_options& options = {}) {
    detail::require_options(options);
    constexpr double least_eps = 0.01;  // chosen: docs/thesis-notes.md, in scaled features
    constexpr double eps_per_rho = 1.0 / 3.0;
    vocabulary<D> made;
    made.max_distance = std::sqrt(detail::chi_squared_quantile(options.inlier_probability, D));
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        gnomon::detail::require(detail::is_finite_cluster(clusters[c]),
                                "make_vocabulary: a cluster is not finite");
        if (clusters[c].count >= options.min_members) made.words.push_back({c, clusters[c], {}});
    }
    const auto pooled = detail::pooled_covariance(made.words, options.min_deviation);
    const double eps = std::max(least_eps, options.max_distance * eps_per_rho);
    for (auto& w : made.words) {
        const auto n = static_cast<double>(w.statistics.count), v = options.pooled_members;
        auto covariance = w.statistics.covariance();
        for (std::size_t i = 0; i < D; ++i) {
            if (options.repair == covariance_repair::diagonal) {
                covariance[i][i] += eps * eps;
                continue;
            }
            for (std::size_t j = 0; j < D; ++j)
                covariance[i][j] = (w.statistics.scatter[i][j] + v * pooled[i][j]) / (n - 1.0 + v);
        }
        w.inverse_covariance = detail::regular_inverse(covariance);
    }
    return made;
}

}  // namespace gnomon::recognition

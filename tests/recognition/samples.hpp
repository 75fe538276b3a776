// SPDX-License-Identifier: BSL-1.0
/// @file
/// Random samples, and the agreement of two clusterings.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <gnomon/core/random.hpp>
#include <gnomon/recognition/cluster.hpp>

namespace samples {

template <std::size_t D>
using rows = std::vector<std::array<double, D>>;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Independent values of the standard normal distribution.
template <std::size_t D>
rows<D> gaussian(std::size_t n, gnomon::random_stream& random) {
    rows<D> found(n);
    for (auto& x : found)
        for (double& value : x) value = random.gaussian();
    return found;
}

/// Correlated normal samples: a random lower triangular matrix times standard ones, plus a mean.
template <std::size_t D>
rows<D> correlated(std::size_t n, double scale, const std::array<double, D>& mean,
                   gnomon::random_stream& random) {
    std::array<std::array<double, D>, D> l{};
    for (std::size_t i = 0; i < D; ++i) {
        for (std::size_t j = 0; j < i; ++j) l[i][j] = 0.5 * random.gaussian();
        l[i][i] = 1.0;
    }
    rows<D> found = gaussian<D>(n, random);
    for (auto& x : found) {
        const auto z = x;
        for (std::size_t i = 0; i < D; ++i) {
            x[i] = mean[i];
            for (std::size_t j = 0; j <= i; ++j) x[i] += scale * l[i][j] * z[j];
        }
    }
    return found;
}

/// Samples around random centers of the unit cube, and the center of each.
template <std::size_t D>
std::pair<rows<D>, std::vector<std::ptrdiff_t>> planted(std::size_t centers, std::size_t each,
                                                        double sigma, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    rows<D> means(centers), found;
    for (auto& m : means)
        for (double& value : m) value = random.uniform();
    std::vector<std::ptrdiff_t> truth;
    for (std::size_t i = 0; i < centers * each; ++i) {
        const auto c = static_cast<std::size_t>(random.uniform() * static_cast<double>(centers));
        auto x = means[c];
        for (double& value : x) value += sigma * random.gaussian();
        found.push_back(x);
        truth.push_back(static_cast<std::ptrdiff_t>(c));
    }
    return {found, truth};
}

/// A random permutation of 0, ..., n - 1.
inline std::vector<std::size_t> permutation(std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    for (std::size_t i = n; i > 1; --i)
        std::swap(order[i - 1],
                  order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
    return order;
}

/// The adjusted Rand index of two partitions (Hubert and Arabie 1985): 1 if they are the same.
inline double adjusted_rand_index(const std::vector<std::ptrdiff_t>& a,
                                  const std::vector<std::ptrdiff_t>& b) {
    std::map<std::pair<std::ptrdiff_t, std::ptrdiff_t>, double> both;
    std::map<std::ptrdiff_t, double> of_a, of_b;
    for (std::size_t i = 0; i < a.size(); ++i) {
        both[{a[i], b[i]}] += 1.0;
        of_a[a[i]] += 1.0;
        of_b[b[i]] += 1.0;
    }
    const auto pairs = [](const auto& counts) {
        double sum = 0.0;
        for (const auto& [key, n] : counts) sum += n * (n - 1.0) / 2.0;
        return sum;
    };
    const auto n = static_cast<double>(a.size());
    const double expected = pairs(of_a) * pairs(of_b) / (n * (n - 1.0) / 2.0);
    const double most = 0.5 * (pairs(of_a) + pairs(of_b));
    return (pairs(both) - expected) / (most - expected);
}

}  // namespace samples

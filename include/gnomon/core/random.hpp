// SPDX-License-Identifier: BSL-1.0
/// @file
/// A random number generator with the same numbers on every platform and on any number of threads.
/// SplitMix64 (Steele, Lea and Flood 2014) makes each number a pure function of a seed and a
/// counter. The distributions of the standard library differ between implementations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon {

/// A stream of random numbers, chosen by a seed and a stream number. Where each ray or point has
/// its own stream, the results do not depend on the order in which threads visit them.
class random_stream {
  public:
    /// @param seed    chooses the family of streams
    /// @param stream  number of the stream in the family
    explicit random_stream(std::uint64_t seed, std::uint64_t stream = 0)
        : state_(mix(seed) ^ mix(~stream)) {}

    /// A number uniform in [0, 2^64).
    std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }

    /// A number uniform in 0, 1, ... n - 1, up to a bias of n / 2^64. Precondition: n > 0.
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }

    /// A number uniform in [0, 1), a multiple of 2^-53.
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    /// A number uniform in [low, high], up to rounding.
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// A number of the standard normal distribution (Box and Muller 1958). Uses two uniform ones.
    double gaussian() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

  private:
    // The increment and the factors are those of SplitMix64.
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Random numbers that are the same on every platform and any number of threads: each is a pure
/// function of a seed and a counter (SplitMix64: Steele, Lea and Flood 2014), where the standard
/// library leaves its distributions to each implementation.
#pragma once

#include <cstdint>
#include <numbers>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon {

/// The stream of random numbers number `stream` of `seed`: give each ray or point a stream of its
/// own, and the order in which they are visited no longer matters.
class random_stream {
  public:
    explicit random_stream(std::uint64_t seed, std::uint64_t stream = 0)
        : state_(mix(seed) ^ mix(~stream)) {}

    /// Uniform in [0, 2^64).
    std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }

    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    /// Uniform in [low, high], up to rounding.
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// Standard normal (Box and Muller 1958).
    double gaussian() {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return radius * std::cos(2.0 * std::numbers::pi * uniform());
    }

  private:
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

}  // namespace gnomon

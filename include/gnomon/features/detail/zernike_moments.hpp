// SPDX-License-Identifier: BSL-1.0
/// @file
/// 3D Zernike moments of masses in the unit ball, by M. Novotni and R. Klein, 3D Zernike
/// descriptors for content based shape retrieval, 2003, and the norms of their vectors.
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/detail/solid_harmonics.hpp>

namespace gnomon::detail {

/// n over k.
[[nodiscard]] inline double binomial(std::size_t n, std::size_t k) {
    double product = 1.0;
    for (std::size_t i = 1; i <= k; ++i)
        product *= static_cast<double>(n - k + i) / static_cast<double>(i);
    return product;
}

/// The coefficient q_kl^nu of r^(2 nu) in the radial polynomial R_nl(r) / r^l, n = l + 2 k, with
/// which 3 / (4 pi) times the integral of |R_nl Y_lm|^2 over the unit ball is 1 / (4 pi).
[[nodiscard]] inline double zernike_coefficient(std::size_t k, std::size_t l, std::size_t nu) {
    const double sign = (k + nu) % 2 == 0 ? 1.0 : -1.0;
    const double scale = std::sqrt(static_cast<double>(2 * l + 4 * k + 3) / 3.0);
    return sign * std::ldexp(scale, -2 * static_cast<int>(k)) * binomial(2 * k, k) *
           binomial(k, nu) * binomial(2 * (k + l + nu) + 1, 2 * k) / binomial(k + l + nu, k);
}

/// The sums of r^(2 nu) r^l Y_lm over masses, from which all moments up to an order follow.
class zernike_moments {
  public:
    explicit zernike_moments(std::size_t order)
        : order_(order), powers_(order / 2 + 1), harmonics_(order + 1) {
        sums_.resize(harmonics_.size() * powers_);
    }

    /// Adds a mass at a position in the unit ball. O(order^3).
    void add(const Eigen::Vector3d& v, double mass) {
        const double r2 = dot(v, v);
        harmonics_.at(v, [&](std::size_t l, std::size_t m, double re, double im) {
            sum* s = sums_.data() + place_of(l, m);
            double power = mass;
            for (std::size_t nu = 0; 2 * nu + l <= order_; ++nu, ++s, power *= r2) {
                s->re += power * re;
                s->im += power * im;
            }
        });
    }

    /// Adds those of other masses, to the same order. O(order^3).
    void add(const zernike_moments& other) {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            sums_[i].re += other.sums_[i].re;
            sums_[i].im += other.sums_[i].im;
        }
    }

    /// F_nl for n = 0, ..., order and l = n mod 2, ..., n. O(order^4).
    [[nodiscard]] std::vector<double> norms() const {
        std::vector<double> all;
        for (std::size_t n = 0; n <= order_; ++n)
            for (std::size_t l = n % 2; l <= n; l += 2) all.push_back(norm((n - l) / 2, l));
        return all;
    }

  private:
    struct sum {
        double re = 0.0, im = 0.0;
    };

    [[nodiscard]] std::size_t place_of(std::size_t l, std::size_t m) const {
        return (l * (l + 1) / 2 + m) * powers_;
    }

    [[nodiscard]] double norm(std::size_t k, std::size_t l) const {
        // Y_lm is orthonormal on the sphere, the basis of the paper to 4 pi times as much.
        const double scale = 3.0 / (4.0 * std::numbers::pi) * 2.0 / std::numbers::inv_sqrtpi;
        double squares = 0.0;
        for (std::size_t m = 0; m <= l; ++m) {
            sum moment;
            for (std::size_t nu = 0; nu <= k; ++nu) {
                const double q = scale * zernike_coefficient(k, l, nu);
                moment.re += q * sums_[place_of(l, m) + nu].re;
                moment.im += q * sums_[place_of(l, m) + nu].im;
            }
            const double square = moment.re * moment.re + moment.im * moment.im;
            squares += m == 0 ? square : 2.0 * square;  // order -m has the same amplitude
        }
        return std::sqrt(squares);
    }

    std::size_t order_, powers_;
    solid_harmonics harmonics_;
    scratch<sum> sums_;
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Exact signs of small determinants of doubles. A sum of doubles that do not overlap (an
/// expansion) represents sums and products without any rounding; its sign is that of its largest
/// term. Only near-ties need it: elsewhere a bound on the rounding error settles the sign.
///
/// Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates,
/// 1997. Exact unless products over- or underflow.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::detail {

/// An exact sum of up to N doubles, smallest first, without zeros.
template <std::size_t N>
struct expansion {
    std::array<double, N> terms;
    std::size_t size = 0;

    void append(double term) {
        if (term != 0.0) terms[size++] = term;
    }
    [[nodiscard]] int sign() const { return size == 0 ? 0 : (terms[size - 1] > 0.0 ? 1 : -1); }
    /// The sum in double, of the same sign and with a relative error of a few rounding units.
    [[nodiscard]] double value() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < size; ++i) sum += terms[i];
        return sum;
    }
};

/// The rounding error of sum = a + b. Knuth's two-sum.
[[nodiscard]] inline double sum_error(double a, double b, double sum) {
    const double b_part = sum - a;
    const double a_part = sum - b_part;
    return (a - a_part) + (b - b_part);
}

/// x + y, by merging their terms in the order of magnitude.
template <std::size_t N, std::size_t M>
[[nodiscard]] expansion<N + M> operator+(const expansion<N>& x, const expansion<M>& y) {
    expansion<N + M> result;
    double carry = 0.0;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < x.size || j < y.size) {
        const bool from_x =
            j == y.size || (i < x.size && std::abs(x.terms[i]) < std::abs(y.terms[j]));
        const double term = from_x ? x.terms[i++] : y.terms[j++];
        const double sum = carry + term;
        result.append(sum_error(carry, term, sum));
        carry = sum;
    }
    result.append(carry);
    return result;
}

/// a b, rounded. As a plain product the compiler could contract it with a sum that follows.
[[nodiscard]] inline double rounded_product(double a, double b) { return std::fma(a, b, 0.0); }

/// x times the double b.
template <std::size_t N>
[[nodiscard]] expansion<2 * N> operator*(const expansion<N>& x, double b) {
    expansion<2 * N> result;
    double carry = 0.0;
    for (std::size_t i = 0; i < x.size; ++i) {
        const double product = rounded_product(x.terms[i], b);
        const double low = std::fma(x.terms[i], b, -product);
        const double sum = carry + low;
        result.append(sum_error(carry, low, sum));
        carry = product + sum;
        result.append(sum_error(product, sum, carry));
    }
    result.append(carry);
    return result;
}

/// The product of two doubles.
[[nodiscard]] inline expansion<2> exact_product(double a, double b) {
    expansion<2> result;
    const double product = rounded_product(a, b);
    result.append(std::fma(a, b, -product));
    result.append(product);
    return result;
}

/// a - b.
[[nodiscard]] inline expansion<2> exact_difference(double a, double b) {
    expansion<2> result;
    const double difference = a - b;
    result.append(sum_error(a, -b, difference));
    result.append(difference);
    return result;
}

/// x times term i of y, which is zero if y has fewer terms.
template <std::size_t N, std::size_t M>
[[nodiscard]] expansion<2 * N> times_term(const expansion<N>& x, const expansion<M>& y,
                                          std::size_t i) {
    return i < y.size ? x * y.terms[i] : expansion<2 * N>{};
}

/// x times y, where y has up to two, or up to four terms.
template <std::size_t N>
[[nodiscard]] auto operator*(const expansion<N>& x, const expansion<2>& y) {
    return times_term(x, y, 0) + times_term(x, y, 1);
}
template <std::size_t N>
[[nodiscard]] auto operator*(const expansion<N>& x, const expansion<4>& y) {
    return (times_term(x, y, 0) + times_term(x, y, 1)) +
           (times_term(x, y, 2) + times_term(x, y, 3));
}

/// The sign of a b - c d.
[[nodiscard]] inline int sign_of_difference(double a, double b, double c, double d) {
    const double difference = a * b - c * d;
    constexpr double eps = std::numeric_limits<double>::epsilon();
    if (std::abs(difference) > 2.0 * eps * (std::abs(a * b) + std::abs(c * d)))
        return difference > 0.0 ? 1 : -1;
    return (exact_product(a, b) + exact_product(-c, d)).sign();
}

}  // namespace gnomon::detail

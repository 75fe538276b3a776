// SPDX-License-Identifier: BSL-1.0
/// @file
/// A surface of a few terms of the coordinates, such as a parabola, fit to heights by weighted
/// least squares: its terms are made orthogonal one after the other (modified Gram-Schmidt), which
/// needs no system of equations, and survives terms that the places do not determine.
#pragma once

#include <array>
#include <cstddef>

namespace gnomon::detail {

/// The sum of the weighted products of two sequences of numbers.
[[nodiscard]] double weighted_product(const auto& weights, const auto& a, const auto& b) {
    double sum = 0.0;
    for (std::size_t p = 0; p < weights.size(); ++p) sum += weights[p] * a[p] * b[p];
    return sum;
}

/// Leaves of a sequence what is orthogonal to another one.
void make_orthogonal(const auto& weights, const auto& other, auto& from) {
    const double squared = weighted_product(weights, other, other);
    if (!(squared > 0.0)) return;
    const double share = weighted_product(weights, other, from) / squared;
    for (std::size_t p = 0; p < weights.size(); ++p) from[p] -= share * other[p];
}

/// Leaves of the heights of some places what the sum of terms that fits them best does not explain.
/// Places of no weight do not count for the fit; their heights become those over it.
/// @param terms    for each term its values at the places, which become orthogonal
/// @param heights  of the places
template <class Values, std::size_t count>
void remove_terms(const auto& weights, std::array<Values, count>& terms, auto& heights) {
    for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t before = 0; before < t; ++before)
            make_orthogonal(weights, terms[before], terms[t]);
        make_orthogonal(weights, terms[t], heights);
    }
}

}  // namespace gnomon::detail

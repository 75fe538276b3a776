// SPDX-License-Identifier: BSL-1.0
/// @file
/// Divides a function of a set of players into terms of single players and of pairs, of which the
/// sum is the value of the whole set: the interaction index of Shapley and Taylor (Sundararajan,
/// Dhamdhere and Agarwal 2020) of second order, for one order of the players.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include <gnomon/recognition/posterior.hpp>

namespace gnomon::recognition::detail {

/// a - b, class by class.
[[nodiscard]] inline std::vector<double> difference(std::vector<double> a,
                                                    const std::vector<double>& b) {
    for (std::size_t c = 0; c < a.size(); ++c) a[c] -= b[c];
    return a;
}

/// The terms of n players: the prior, which is f of the empty set; of each player i, what f({i})
/// adds to that; of each pair i < j, what both together add to each alone, after the players before
/// i.
/// @param prior  f({})
/// @param f      f(m, {i, ...}) is the value of the players 0 to m - 1, i, ...
/// Calls f n + n (n - 1) / 2 times.
[[nodiscard]] std::vector<term> interaction_terms(std::size_t n, std::vector<double> prior,
                                                  auto&& f) {
    std::vector<term> terms{{.log_likelihood = std::move(prior)}};
    std::vector<double> before = terms[0].log_likelihood;  // f({0, ..., i - 1}) for the current i
    std::vector<std::vector<double>> with(n);              // f({0, ..., i - 1, j})
    for (std::size_t j = 0; j < n; ++j) {
        with[j] = f(0, std::initializer_list<std::size_t>{j});
        terms.push_back({term_kind::part, j, term::none, term::none, difference(with[j], before)});
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
        for (std::size_t j = i + 1; j < n; ++j) {
            auto both = f(i, std::initializer_list<std::size_t>{i, j});
            terms.push_back({term_kind::pair, i, j, term::none,
                             difference(difference(both, with[i]), difference(with[j], before))});
            with[j] = std::move(both);
        }
        before = std::exchange(with[i], {});
    }
    return terms;
}

}  // namespace gnomon::recognition::detail

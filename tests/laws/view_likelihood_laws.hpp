// SPDX-License-Identifier: BSL-1.0
/// @file
/// Laws of likelihoods of views. `view_likelihood_laws(likelihood, view)` runs them all on one
/// view.
#pragma once

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/view.hpp>

namespace laws {

// [terms_are_of_parts_of_the_view]
/// Each term has a log-likelihood for every class, which is no NaN and not infinity, and is about
/// parts of the view.
template <gnomon::recognition::view_likelihood L>
void terms_are_of_parts_of_the_view(const L& likelihood, const gnomon::recognition::view& v) {
    using gnomon::recognition::term;
    for (const term& t : likelihood(v)) {
        ASSERT_EQ(t.log_likelihood.size(), likelihood.classes());
        for (const double x : t.log_likelihood) EXPECT_LT(x, INFINITY);
        EXPECT_TRUE(t.first == term::none || t.first < v.parts.size());
        EXPECT_TRUE(t.second == term::none || t.second < v.parts.size());
    }
}
// [terms_are_of_parts_of_the_view]

// [evidence_is_the_decision]
/// The evidence sums to the logarithm of the ratio of the best class to the second, the
/// probabilities to 1; a view without parts is background.
template <gnomon::recognition::view_likelihood L>
void evidence_is_the_decision(const L& likelihood, const gnomon::recognition::view& v) {
    const auto found = gnomon::recognition::explain(likelihood, v);
    double sum = 0.0, probability = 0.0;
    for (const auto& e : found.evidence) sum += e.log_ratio;
    for (const double p : found.probability) probability += p;
    EXPECT_NEAR(sum, found.log_ratio, 1e-9);
    EXPECT_NEAR(probability, 1.0, 1e-12);
    if (v.parts.empty()) {
        EXPECT_TRUE(found.is_background());
    }
}
// [evidence_is_the_decision]

/// The same terms each time, and a decision without evidence that is the same, up to rounding.
template <gnomon::recognition::view_likelihood L>
void decisions_are_reproducible(const L& likelihood, const gnomon::recognition::view& v) {
    const L copy = likelihood;
    const auto first = gnomon::recognition::explain(likelihood, v),
               again = gnomon::recognition::explain(copy, v),
               fast = gnomon::recognition::decide(likelihood, v);
    EXPECT_EQ(first.probability, again.probability);
    ASSERT_EQ(first.probability.size(), fast.probability.size());
    for (std::size_t c = 0; c < fast.probability.size(); ++c)
        EXPECT_NEAR(first.probability[c], fast.probability[c], 1e-9);
}

template <gnomon::recognition::view_likelihood L>
void view_likelihood_laws(const L& likelihood, const gnomon::recognition::view& v) {
    terms_are_of_parts_of_the_view(likelihood, v);
    evidence_is_the_decision(likelihood, v);
    decisions_are_reproducible(likelihood, v);
}

}  // namespace laws

// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/view_likelihood_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/posterior.hpp>

namespace rec = gnomon::recognition;

namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

/// Terms of parts.
std::vector<rec::term> posterior_terms(const std::vector<std::vector<double>>& log_likelihoods) {
    std::vector<rec::term> terms;
    for (std::size_t i = 0; i < log_likelihoods.size(); ++i)
        terms.push_back({.kind = rec::term_kind::part,
                         .first = i,
                         .word = 10 + i,
                         .log_likelihood = log_likelihoods[i]});
    return terms;
}

std::vector<rec::term> random_terms(std::size_t n, std::size_t classes,
                                    gnomon::random_stream& random) {
    std::vector<std::vector<double>> l(n, std::vector<double>(classes));
    for (auto& row : l)
        for (double& x : row) x = 3.0 * random.gaussian();
    return posterior_terms(l);
}

rec::view posterior_view(std::size_t parts) {
    rec::view v;
    v.parts.resize(parts);
    return v;
}

// [own_likelihood]
/// A likelihood of a user: each part is evidence for class 0.
struct likelihood_of_numbers {
    static std::size_t classes() { return 3; }
    std::vector<rec::term> operator()(const rec::view& v) const {
        std::vector<rec::term> terms;
        for (std::size_t i = 0; i < v.parts.size(); ++i)
            terms.push_back(
                {.kind = rec::term_kind::part, .first = i, .log_likelihood = {0.0, -1.0, -2.0}});
        return terms;
    }
};
static_assert(rec::view_likelihood<likelihood_of_numbers>);
// [own_likelihood]

/// The same, which knows its sum.
struct likelihood_with_sum : likelihood_of_numbers {
    std::vector<double> log_likelihood(const rec::view& v) const {
        const auto n = static_cast<double>(v.parts.size());
        return {0.0, -n, -2.0 * n};
    }
};
static_assert(rec::view_likelihood<likelihood_with_sum>);

struct likelihood_without_classes {
    std::vector<rec::term> operator()(const rec::view&) const { return {}; }
};
struct likelihood_of_parts {
    static std::size_t classes() { return 2; }
    std::vector<rec::term> operator()(const rec::part&) const { return {}; }
};
static_assert(!rec::view_likelihood<likelihood_without_classes>);
static_assert(!rec::view_likelihood<likelihood_of_parts>);
static_assert(!rec::view_likelihood<int>);

/// Oracle: Eqs. (5.9) to (5.16) in integers. Factors k / 7 of three classes, and the product of ten
/// of them; numerators below 7^10.
TEST(posterior, equals_exact_rational_arithmetic) {
    gnomon::random_stream random(5);
    for (int trial = 0; trial < 200; ++trial) {
        std::array<std::uint64_t, 3> product{1, 1, 1};
        std::vector<std::vector<double>> l;
        for (int t = 0; t < 10; ++t) {
            std::vector<double> row;
            for (auto& p : product) {
                const std::uint64_t k = 1 + random.below(7);
                p *= k;
                row.push_back(std::log(static_cast<double>(k) / 7.0));
            }
            l.push_back(row);
        }
        const auto sum = static_cast<double>(product[0] + product[1] + product[2]);
        const auto found = rec::decide(posterior_terms(l), 3, true);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(found.probability[c], static_cast<double>(product[c]) / sum, 1e-13);
    }
}

TEST(posterior, sums_to_one_and_neither_overflows_nor_underflows) {
    gnomon::random_stream random(6);
    for (const double scale : {1.0, 1e3, 1e6}) {
        for (const double shift : {0.0, -1e5, 1e5}) {
            auto terms = random_terms(20, 5, random);
            for (auto& t : terms)
                for (double& x : t.log_likelihood) x = scale * x + shift;
            const auto found = rec::decide(terms, 5, true);
            double sum = 0.0;
            for (const double p : found.probability) {
                EXPECT_GE(p, 0.0);
                sum += p;
            }
            EXPECT_NEAR(sum, 1.0, 1e-12);
        }
    }
}

TEST(posterior, evidence_sums_to_the_ratio_of_best_to_second) {
    gnomon::random_stream random(7);
    for (int trial = 0; trial < 100; ++trial) {
        const auto terms = random_terms(15, 4, random);
        const auto found = rec::decide(terms, 4, true, {.temperature = 3.0});
        double sum = 0.0;
        ASSERT_EQ(found.evidence.size(), terms.size());
        for (std::size_t i = 0; i < terms.size(); ++i) {
            EXPECT_EQ(found.evidence[i].first, terms[i].first);
            EXPECT_EQ(found.evidence[i].word, terms[i].word);
            sum += found.evidence[i].log_ratio;
        }
        EXPECT_NEAR(sum, found.log_ratio, 1e-9);
        EXPECT_NEAR(found.log_ratio,
                    std::log(found.probability[found.best] / found.probability[found.second]),
                    1e-9);
        EXPECT_GE(found.log_ratio, 0.0);
        for (std::size_t c = 0; c < 4; ++c) {
            EXPECT_LE(found.probability[c], found.probability[found.best]);
            if (c != found.best) {
                EXPECT_LE(found.probability[c], found.probability[found.second]);
            }
        }
    }
}

/// Where all other probabilities underflow, the second class is still that of the next likelihood.
TEST(posterior, knows_the_second_class_of_a_sure_decision) {
    const auto found = rec::decide(posterior_terms({{0.0, -2000.0, -800.0}}), 3, true);
    EXPECT_EQ(found.best, 0u);
    EXPECT_EQ(found.second, 2u);
    EXPECT_NEAR(found.log_ratio, 800.0, 1e-9);
}

/// Sec. 5.5.2: raising P_d only removes decisions, and each view keeps its class.
TEST(posterior, decides_on_fewer_views_for_a_larger_p_d) {
    gnomon::random_stream random(8);
    for (int trial = 0; trial < 200; ++trial) {
        const auto terms = random_terms(3, 3, random);
        bool was_certain = true;
        std::size_t best = rec::term::none;
        for (double p = 0.0; p <= 1.0; p += 0.05) {
            const auto found = rec::decide(terms, 3, true, {.min_probability = p});
            EXPECT_TRUE(was_certain || !found.is_certain);
            EXPECT_EQ(found.is_certain, found.probability[found.best] >= p);
            EXPECT_EQ(found.is_background(), !found.is_certain);
            if (best != rec::term::none) {
                EXPECT_EQ(found.best, best);
            }
            best = found.best;
            was_certain = found.is_certain;
        }
    }
}

TEST(posterior, temperature_flattens_and_keeps_the_order) {
    const auto terms = posterior_terms({{1.0, 3.0, 0.0}, {2.0, 1.0, 0.5}});
    const auto sharp = rec::decide(terms, 3, true, {.temperature = 0.5});
    const auto flat = rec::decide(terms, 3, true, {.temperature = 5.0});
    EXPECT_EQ(sharp.best, flat.best);
    EXPECT_GT(sharp.probability[sharp.best], flat.probability[flat.best]);
    EXPECT_NEAR(sharp.log_ratio, 10.0 * flat.log_ratio, 1e-12);
}

TEST(posterior, views_without_parts_and_other_things_are_background) {
    const auto terms = posterior_terms({{0.0, -9.0}});
    EXPECT_FALSE(rec::decide(terms, 2, true).is_background());
    EXPECT_TRUE(rec::decide(terms, 2, false, {.min_probability = 0.0}).is_background());
    const auto other = rec::decide(terms, 2, true, {.background_class = 0});
    EXPECT_TRUE(other.is_certain);
    EXPECT_TRUE(other.is_of_background_class);
    EXPECT_TRUE(other.is_background());
    EXPECT_FALSE(rec::decide(terms, 2, true, {.background_class = 1}).is_background());
}

TEST(posterior, has_one_class_or_no_terms) {
    const auto single = rec::decide(posterior_terms({{-3.0}}), 1, true);
    EXPECT_EQ(single.probability, std::vector<double>{1.0});
    EXPECT_EQ(single.best, 0u);
    EXPECT_EQ(single.second, rec::term::none);
    const auto none = rec::decide(std::vector<rec::term>{}, 4, true);
    for (const double p : none.probability) EXPECT_DOUBLE_EQ(p, 0.25);
    EXPECT_TRUE(none.is_background());
    EXPECT_EQ(none.log_ratio, 0.0);
}

/// A class that a term excludes has the probability 0.
TEST(posterior, excludes_classes) {
    const auto found = rec::decide(posterior_terms({{0.0, minus_infinity, -1.0}}), 3, true);
    EXPECT_EQ(found.probability[1], 0.0);
    EXPECT_NEAR(found.probability[0], 1.0 / (1.0 + std::exp(-1.0)), 1e-15);
    EXPECT_EQ(found.second, 2u);
}

/// A likelihood that is not a number, or a view that every class excludes, must not pass as a
/// decision with probabilities that are not numbers.
TEST(posterior, refuses_terms_that_are_not_numbers) {
    const double nan = std::nan("");
    EXPECT_THROW((void)rec::decide(posterior_terms({{0.0, nan}}), 2, true), std::invalid_argument);
    EXPECT_THROW(
        (void)rec::decide(posterior_terms({{minus_infinity, 0.0}, {0.0, minus_infinity}}), 2, true),
        std::invalid_argument);
}

TEST(posterior, refuses_options_out_of_range) {
    const auto terms = posterior_terms({{0.0, 1.0}});
    const double nan = std::nan("");
    for (const double p : {-0.1, 1.1, nan})
        EXPECT_THROW((void)rec::decide(terms, 2, true, {.min_probability = p}),
                     std::invalid_argument);
    for (const double t : {0.0, -1.0, nan, -minus_infinity})
        EXPECT_THROW((void)rec::decide(terms, 2, true, {.temperature = t}), std::invalid_argument);
    // The evidence for and against both overflow, and their sum is not a number.
    const auto torn = posterior_terms({{0.0, 9.0}, {8.0, 0.0}});
    EXPECT_THROW((void)rec::decide(torn, 2, true, {.temperature = 1e-310}), std::invalid_argument);
    EXPECT_THROW((void)rec::decide(terms, 3, true), std::invalid_argument);
    EXPECT_THROW((void)rec::decide(std::vector<rec::term>{}, 0, true), std::invalid_argument);
}

TEST(posterior, decides_on_views_with_and_without_evidence) {
    const auto view = posterior_view(5);
    const auto slow = rec::explain(likelihood_of_numbers{}, view);
    EXPECT_EQ(slow.evidence.size(), 5u);
    EXPECT_EQ(rec::decide(likelihood_of_numbers{}, view).evidence.size(), 5u);
    const auto fast = rec::decide(likelihood_with_sum{}, view);
    EXPECT_TRUE(fast.evidence.empty());
    EXPECT_EQ(fast.best, slow.best);
    EXPECT_NEAR(fast.log_ratio, slow.log_ratio, 1e-12);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(fast.probability[c], slow.probability[c], 1e-12);
    EXPECT_FALSE(slow.is_background());
    for (const std::size_t parts : {0u, 1u, 5u}) {
        laws::view_likelihood_laws(likelihood_of_numbers{}, posterior_view(parts));
        laws::view_likelihood_laws(likelihood_with_sum{}, posterior_view(parts));
    }
}

}  // namespace

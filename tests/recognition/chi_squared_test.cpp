// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>

#include <gtest/gtest.h>

#include "samples.hpp"
#include <gnomon/recognition/detail/chi_squared.hpp>

namespace {

using gnomon::recognition::detail::chi_squared_quantile;
using gnomon::recognition::detail::chi_squared_tail;

struct chi_squared_value {
    double argument;
    std::size_t degrees;
    double value;
};

/// Values of qchisq of R 4.2.2.
TEST(chi_squared, quantiles_are_those_of_r) {
    constexpr chi_squared_value expected[] = {
        {0.99, 5, 15.086272469388987},     {0.99, 1, 6.6348966010212127},
        {0.95, 2, 5.9914645471079799},     {0.5, 3, 2.3659738843753377},
        {0.01, 10, 2.5582121601872059},    {0.999999, 35, 89.946740923684658},
        {1e-6, 1, 1.5707963267957164e-12}, {0.3, 400, 384.69840606995416},
        {0.99, 1540, 1672.040588405634}};
    for (const auto& [p, degrees, value] : expected)
        EXPECT_NEAR(chi_squared_quantile(p, degrees) / value, 1.0, 1e-11) << p << ' ' << degrees;
}

/// Values of pchisq(lower.tail = FALSE) of R 4.2.2.
TEST(chi_squared, tails_are_those_of_r) {
    constexpr chi_squared_value expected[] = {
        {15.086272469388989, 5, 0.01},        {100, 5, 5.28514836094324e-20},
        {0.001, 1, 0.97477287936996038},      {700, 35, 1.1542797511507915e-124},
        {3, 2, 0.22313016014842982},          {400, 400, 0.49059658199276368},
        {2000, 1540, 1.5449233372916366e-14}, {1e-8, 3, 0.99999999999973399}};
    for (const auto& [x, degrees, value] : expected)
        EXPECT_NEAR(chi_squared_tail(x, degrees) / value, 1.0, 1e-11) << x << ' ' << degrees;
    EXPECT_EQ(chi_squared_tail(0.0, 3), 1.0);
    EXPECT_EQ(chi_squared_tail(samples::infinity, 3), 0.0);
}

TEST(chi_squared, tail_inverts_the_quantile) {
    for (const std::size_t degrees : {1u, 2u, 3u, 5u, 12u, 101u}) {
        for (const double p : {1e-300, 1e-9, 0.05, 0.3, 0.5, 0.7, 0.95, 0.9999})
            EXPECT_NEAR(1.0 - chi_squared_tail(chi_squared_quantile(p, degrees), degrees), p,
                        1e-13);
    }
}

TEST(chi_squared, refuses_bad_input) {
    for (const double p : {0.0, 1.0, -1.0, samples::nan})
        EXPECT_THROW((void)chi_squared_quantile(p, 3), std::invalid_argument);
    EXPECT_THROW((void)chi_squared_quantile(0.5, 0), std::invalid_argument);
}

}  // namespace

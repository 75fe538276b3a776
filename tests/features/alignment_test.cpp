// SPDX-License-Identifier: BSL-1.0
#include <string>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/features/alignment.hpp>

namespace {

using gnomon::alignment;

TEST(alignment, covariance_about_another_place_is_that_of_the_place) {
    alignment a;
    a.center = {1, 2, 3};
    a.covariance(2, 2) = 4e-4;  // a turn about the vertical
    const auto c = a.covariance_about({1, 7, 3});
    EXPECT_NEAR(c(3, 3), 25 * 4e-4, 1e-15);
    EXPECT_NEAR(c(4, 4), 0.0, 1e-15);
    EXPECT_NEAR(c(2, 3), -5 * 4e-4, 1e-15);
}

/// The other side of the other side is this one.
TEST(alignment, inverse_is_an_involution) {
    alignment a;
    a.pose = {clouds::random_rotation(1), {1, 2, 3}};
    a.center = {4, 5, 6};
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) a.covariance(i, j) = i == j ? 10.0 + i : 0.1 * (i + j);
    const alignment b = a.inverse().inverse();
    EXPECT_LT((b.pose.rotation - a.pose.rotation).norm(), 1e-13);
    EXPECT_LT((b.pose.position - a.pose.position).norm(), 1e-13);
    EXPECT_LT((b.center - a.center).norm(), 1e-13);
    EXPECT_LT((b.covariance - a.covariance).norm(), 1e-12);
    EXPECT_LT((a.inverse().center - a.pose.point_in(a.center)).norm(), 1e-13);
}

TEST(alignment, names_its_outcomes) {
    using enum alignment::outcome;
    EXPECT_EQ(std::string(to_string(converged)), "converged");
    EXPECT_EQ(std::string(to_string(not_converged)), "not_converged");
    EXPECT_EQ(std::string(to_string(too_few_points)), "too_few_points");
    EXPECT_EQ(std::string(to_string(degenerate)), "degenerate");
}

}  // namespace

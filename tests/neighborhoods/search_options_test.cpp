// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/neighborhoods/search_options.hpp>

namespace {

TEST(search_options, are_exact_and_euclidean_by_default) {
    const gnomon::search_options options;
    EXPECT_EQ(options.metric, gnomon::metric::euclidean());
    EXPECT_EQ(options.epsilon, 0.0);
    EXPECT_EQ(options.ties, gnomon::tie_rule::by_index);
}

}  // namespace

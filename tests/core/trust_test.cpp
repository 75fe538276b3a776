// SPDX-License-Identifier: BSL-1.0
#include <string>

#include <gtest/gtest.h>

#include <gnomon/core/trust.hpp>

TEST(trust, good_and_weak_are_usable) {
    using gnomon::trust;
    for (const trust t : {trust::good, trust::weak}) EXPECT_TRUE(gnomon::usable(t));
    for (const trust t : {trust::too_few_neighbors, trust::degenerate, trust::not_finite}) {
        EXPECT_FALSE(gnomon::usable(t));
    }
    EXPECT_EQ(std::string(gnomon::to_string(trust::too_few_neighbors)), "too_few_neighbors");
}

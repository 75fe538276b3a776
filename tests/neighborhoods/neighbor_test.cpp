// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/neighborhoods/neighbor.hpp>

namespace {

TEST(neighbor, is_ordered_by_distance_then_index) {
    using gnomon::neighbor;
    EXPECT_TRUE((neighbor{1.0, 9} < neighbor{2.0, 1}));
    EXPECT_TRUE((neighbor{1.0, 1} < neighbor{1.0, 2}));
    EXPECT_FALSE((neighbor{1.0, 2} < neighbor{1.0, 2}));
    EXPECT_FALSE((neighbor{2.0, 1} < neighbor{1.0, 9}));
}

}  // namespace

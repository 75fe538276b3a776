// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/perception/found_object.hpp>

namespace {

/// What was not looked at is not there: no pose to use, no evidence, no probability.
TEST(found_object, claims_nothing_by_default) {
    const gnomon::recognition::found_object o;
    EXPECT_FALSE(o.aligned.is_usable());
    EXPECT_EQ(o.evidence.support(), 0.0);
    EXPECT_EQ(o.evidence.explanation(), 0.0);
    EXPECT_EQ(o.probability, 0.0);
}

}  // namespace

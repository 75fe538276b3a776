// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <gnomon/core/error.hpp>

TEST(error, reports_file_position_and_reason) {
    const gnomon::error e("scan.pcd", "line 12", "not a number");
    EXPECT_EQ(e.file(), "scan.pcd");
    EXPECT_EQ(e.position(), "line 12");
    EXPECT_STREQ(e.what(), "scan.pcd, line 12: not a number");
    EXPECT_STREQ(gnomon::error("a", "", "b").what(), "a: b");
}

TEST(error, require_throws_only_when_broken) {
    EXPECT_NO_THROW(gnomon::detail::require(true, "fine"));
    EXPECT_THROW(gnomon::detail::require(false, "broken"), std::invalid_argument);
}

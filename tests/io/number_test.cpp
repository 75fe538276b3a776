// SPDX-License-Identifier: BSL-1.0
#include <cstdint>
#include <system_error>

#include <gtest/gtest.h>

#include <gnomon/io/detail/number.hpp>

namespace {

using gnomon::io::detail::parse_number, gnomon::io::detail::is_number;

TEST(number, is_a_whole_word_with_an_optional_plus) {
    double value = 0.0;
    EXPECT_EQ(parse_number("+1.25e1", value), std::errc{});
    EXPECT_EQ(value, 12.5);
    for (const char* word : {"", "+", "+-1", "++1", "1x", "1e", "1,5", "0x10", " 1", "1 "})
        EXPECT_EQ(parse_number(word, value), std::errc::invalid_argument) << word;
    EXPECT_EQ(parse_number("1e999", value), std::errc::result_out_of_range);
    EXPECT_EQ(value, 12.5);  // as it was
}

TEST(number, can_be_a_count) {
    std::uint64_t count = 0;
    EXPECT_EQ(parse_number("18446744073709551615", count), std::errc{});
    EXPECT_EQ(count, 18446744073709551615U);
    EXPECT_EQ(parse_number("18446744073709551616", count), std::errc::result_out_of_range);
    EXPECT_EQ(parse_number("-1", count), std::errc::invalid_argument);
    EXPECT_EQ(parse_number("1.5", count), std::errc::invalid_argument);
}

TEST(number, is_distinguished_from_a_name) {
    for (const char* word : {"1", "-2.5", "+3", "nan", "1e999"}) EXPECT_TRUE(is_number(word));
    for (const char* word : {"", "x", "1x", "nano"}) EXPECT_FALSE(is_number(word));
}

}  // namespace

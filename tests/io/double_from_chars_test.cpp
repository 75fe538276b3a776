// SPDX-License-Identifier: BSL-1.0
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/io/detail/double_from_chars.hpp>

namespace {

using gnomon::io::detail::double_from_chars;

/// What is read of a text: the number of characters, the error, and the value if there is no error.
struct reading {
    std::ptrdiff_t length;
    std::errc problem;
    double value;

    explicit reading(std::string_view text, auto&& parse) : value(untouched) {
        const auto [end, ec] = parse(text.data(), text.data() + text.size(), value);
        length = end - text.data();
        problem = ec;
    }

    static constexpr double untouched = 42.5;
};

reading read(std::string_view text) { return reading(text, double_from_chars); }

void expect_value(std::string_view text, std::ptrdiff_t length, double value) {
    const reading r = read(text);
    EXPECT_EQ(r.length, length) << text;
    EXPECT_EQ(r.problem, std::errc{}) << text;
    EXPECT_EQ(r.value, value) << text;
    EXPECT_EQ(std::signbit(r.value), std::signbit(value)) << text;
}

void expect_problem(std::string_view text, std::ptrdiff_t length, std::errc problem) {
    const reading r = read(text);
    EXPECT_EQ(r.length, length) << text;
    EXPECT_EQ(r.problem, problem) << text;
    EXPECT_EQ(r.value, reading::untouched) << text;
}

TEST(double_from_chars, reads_the_longest_decimal_number) {
    expect_value("1.5e+3", 6, 1500.0);
    expect_value("-.5", 3, -0.5);
    expect_value("1.", 2, 1.0);
    expect_value("00001", 5, 1.0);
    expect_value("-0", 2, -0.0);
    expect_value("1e", 1, 1.0);
    expect_value("1e+", 1, 1.0);
    expect_value("1,5", 1, 1.0);
    expect_value("1.5.5", 3, 1.5);
    expect_value("0x10", 1, 0.0);
    expect_value("0e99999999999999999999999", 25, 0.0);
    expect_value("1e-310", 6, 1e-310);
    expect_value("3e-324", 6, std::numeric_limits<double>::denorm_min());
    expect_value("1.7976931348623158e308", 22, std::numeric_limits<double>::max());
    std::string ones(500, '1');
    ones += "e-499";
    expect_value(ones, 505, 10.0 / 9.0);
}

TEST(double_from_chars, reads_infinity_and_nan_in_any_case) {
    const double inf = std::numeric_limits<double>::infinity();
    expect_value("inf", 3, inf);
    expect_value("-INF", 4, -inf);
    expect_value("Infinity", 8, inf);
    expect_value("infinite", 3, inf);
    const struct {
        const char* text;
        std::ptrdiff_t length;
    } nans[] = {{"nan", 3}, {"-NaN", 4}, {"nan(a_1)", 8}, {"nan()", 5}, {"nan(", 3}, {"nan(-)", 3}};
    for (const auto& [text, length] : nans) {
        const reading r = read(text);
        EXPECT_TRUE(std::isnan(r.value)) << text;
        EXPECT_EQ(r.length, length) << text;
        EXPECT_EQ(std::signbit(r.value), text[0] == '-') << text;
    }
}

TEST(double_from_chars, rejects_invalid_numbers_and_overflow) {
    for (const char* text : {"", ".", "-", "+1", " 1", "--1", "e5", "in", "na", "-.e1", "x"})
        expect_problem(text, 0, std::errc::invalid_argument);
    expect_problem("1e999", 5, std::errc::result_out_of_range);
    expect_problem("-1e999x", 6, std::errc::result_out_of_range);
    expect_problem("1e-400", 6, std::errc::result_out_of_range);
    expect_problem("2e-324", 6, std::errc::result_out_of_range);
    expect_problem("1.7976931348623159e308", 22, std::errc::result_out_of_range);
    expect_problem("1e99999999999999999999999", 25, std::errc::result_out_of_range);
}

TEST(double_from_chars, does_not_depend_on_the_locale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    // Some systems accept the name of a locale that they do not have.
    bool comma = false;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8"})
        comma = comma || (std::setlocale(LC_ALL, name) != nullptr &&
                          std::string_view(std::localeconv()->decimal_point) == ",");
    expect_value("1.5", 3, 1.5);
    expect_value("1,5", 1, 1.0);
    if (comma) {
        EXPECT_EQ(std::strtod("1.5", nullptr), 1.0);
    }
    std::setlocale(LC_ALL, before.c_str());
}

#ifdef __cpp_lib_to_chars
/// Random texts of the characters that numbers are made of.
TEST(double_from_chars, agrees_with_the_standard_library) {
    constexpr std::string_view pieces[] = {"0", "1", "9", "25", "4",     ".",  "e", "E",
                                           "-", "+", "3", "08", "7e-",   "e",  "_", "nan",
                                           "(", ")", "i", "nF", "inity", "30", "6", " "};
    gnomon::random_stream random(17);
    const auto standard = [](const char* first, const char* last, double& value) {
        return std::from_chars(first, last, value);
    };
    int numbers = 0;
    for (int trial = 0; trial < 200'000; ++trial) {
        std::string text;
        for (std::uint64_t n = 1 + random.below(8); n > 0; --n)
            text += pieces[random.below(std::size(pieces))];
        const reading ours = read(text);
        const reading theirs(text, standard);
        ASSERT_EQ(ours.length, theirs.length) << text;
        ASSERT_EQ(ours.problem, theirs.problem) << text;
        ASSERT_TRUE(ours.value == theirs.value || std::isnan(ours.value)) << text;
        ASSERT_EQ(std::isnan(ours.value), std::isnan(theirs.value)) << text;
        ASSERT_EQ(std::signbit(ours.value), std::signbit(theirs.value)) << text;
        if (ours.problem == std::errc{}) ++numbers;
    }
    EXPECT_GT(numbers, 50'000);
}
#endif

}  // namespace

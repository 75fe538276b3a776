// SPDX-License-Identifier: BSL-1.0
/// @file
/// std::from_chars of a double for standard libraries that have none, such as libc++ before 20: the
/// same grammar, values and errors, by strtod in the "C" locale. Compiled everywhere, so that the
/// tests can compare the two.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include <locale.h>  // locale_t, which <clocale> need not have

#if defined(__APPLE__) || defined(__FreeBSD__)
#include <xlocale.h>
#endif

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::io::detail {

/// strtod of the whole of `text` in the "C" locale, whatever the program's locale is.
[[nodiscard]] inline double strtod_in_c_locale(const std::string& text) {
#ifdef _WIN32
    static const _locale_t c_locale = _create_locale(LC_ALL, "C");
    return _strtod_l(text.c_str(), nullptr, c_locale);
#else
    static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", locale_t{});
    return strtod_l(text.c_str(), nullptr, c_locale);
#endif
}

/// Whether `text` begins with the lower-case `word` in any case.
[[nodiscard]] inline bool begins_with_any_case(std::string_view text, std::string_view word) {
    const auto same = [](char lower, char c) {
        return c == lower || (c >= 'A' && c <= 'Z' && c + ('a' - 'A') == lower);
    };
    return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), same);
}

[[nodiscard]] inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number of digits at the beginning of `text`.
[[nodiscard]] inline std::size_t leading_digits(std::string_view text) {
    return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) -
                                    text.begin());
}

/// The length of the longest decimal number without sign at the beginning of `text`; 0 if there is
/// none. An exponent without digits does not belong to the number.
[[nodiscard]] inline std::size_t decimal_length(std::string_view text) {
    std::size_t digits = leading_digits(text);
    std::size_t length = digits;
    if (length < text.size() && text[length] == '.') {
        const std::size_t fraction = leading_digits(text.substr(length + 1));
        digits += fraction;
        length += 1 + fraction;
    }
    if (digits == 0) return 0;
    if (length < text.size() && (text[length] == 'e' || text[length] == 'E')) {
        const std::string_view rest = text.substr(length + 1);
        const std::size_t sign = rest.starts_with('-') || rest.starts_with('+') ? 1 : 0;
        const std::size_t exponent = leading_digits(rest.substr(sign));
        if (exponent > 0) length += 1 + sign + exponent;
    }
    return length;
}

/// The length of "inf", "infinity", "nan" or "nan(letters_digits)" at the beginning of `text`, in
/// any case; 0 if there is none.
[[nodiscard]] inline std::size_t special_length(std::string_view text) {
    if (begins_with_any_case(text, "infinity")) return 8;
    if (begins_with_any_case(text, "inf")) return 3;
    if (!begins_with_any_case(text, "nan")) return 0;
    if (!text.substr(3).starts_with('(')) return 3;
    const auto in_word = [](char c) {
        return is_digit(c) || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    const auto* const close = std::find_if_not(text.data() + 4, text.data() + text.size(), in_word);
    const bool closed = close != text.data() + text.size() && *close == ')';
    return closed ? static_cast<std::size_t>(close - text.data()) + 1 : 3;
}

/// Parses the longest number at the beginning of [first, last), as std::from_chars with
/// std::chars_format::general does: no '+', no leading blanks, no hexadecimal digits.
///
/// @return the end of the number, and std::errc{}; or `first` and invalid_argument if no number is
///         found; or the end and result_out_of_range if a double overflows, or if a nonzero number
///         is rounded to zero. `value` is set in the first case only.
/// Complexity: O(last - first), one allocation for more than a few characters.
[[nodiscard]] inline std::from_chars_result double_from_chars(const char* first, const char* last,
                                                              double& value) {
    const std::string_view text(first, static_cast<std::size_t>(last - first));
    const bool negative = text.starts_with('-');
    const std::string_view number = text.substr(negative ? 1 : 0);
    if (const std::size_t length = special_length(number); length > 0) {
        const bool is_nan = number.front() == 'n' || number.front() == 'N';
        const double special = is_nan ? std::numeric_limits<double>::quiet_NaN()
                                      : std::numeric_limits<double>::infinity();
        value = negative ? -special : special;
        return {number.data() + length, std::errc{}};
    }
    const std::size_t length = decimal_length(number);
    if (length == 0) return {first, std::errc::invalid_argument};
    const char* const end = number.data() + length;
    const double parsed = strtod_in_c_locale(std::string(first, end));
    const std::string_view mantissa =
        number.substr(0, std::min(length, number.find_first_of("eE")));
    const bool is_zero = mantissa.find_first_of("123456789") == std::string_view::npos;
    if (!std::isfinite(parsed) || (parsed == 0.0 && !is_zero)) {
        return {end, std::errc::result_out_of_range};
    }
    value = parsed;
    return {end, std::errc{}};
}

}  // namespace gnomon::io::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Parses a word of a text as a number, independently of the locale.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>
#include <type_traits>

#include <gnomon/io/detail/double_from_chars.hpp>

namespace gnomon::io::detail {

/// std::from_chars, or its replacement for a double where the standard library has none.
template <class T>
[[nodiscard]] std::from_chars_result from_chars(const char* first, const char* last, T& value) {
#ifndef __cpp_lib_to_chars
    if constexpr (std::is_same_v<T, double>) {
        return double_from_chars(first, last, value);
    } else
#endif
        return std::from_chars(first, last, value);
}

/// Parses the whole of `word`. A '+' may precede it, which std::from_chars refuses.
/// @return std::errc{}, invalid_argument or result_out_of_range; `value` is set in the first case
template <class T>
[[nodiscard]] std::errc parse_number(std::string_view word, T& value) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    const char* const end = word.data() + word.size();
    T parsed{};
    const auto [stop, problem] = detail::from_chars(word.data(), end, parsed);
    if (problem != std::errc{}) return problem;
    if (stop != end) return std::errc::invalid_argument;
    value = parsed;
    return problem;
}

/// Returns whether the whole of `word` can be parsed as a number, also if it is out of range.
[[nodiscard]] inline bool is_number(std::string_view word) {
    double value = 0;
    return parse_number(word, value) != std::errc::invalid_argument;
}

}  // namespace gnomon::io::detail

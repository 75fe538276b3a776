// SPDX-License-Identifier: BSL-1.0
/// @file
/// Text to number, in no locale.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace gnomon::io::detail {

/// Parses the whole of `word`, which may begin with '+', as std::from_chars does not.
/// @return std::errc{}, invalid_argument or result_out_of_range; `value` is set in the first case
template <class T>
[[nodiscard]] std::errc parse_number(std::string_view word, T& value) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    const char* const end = word.data() + word.size();
    const auto [stop, problem] = std::from_chars(word.data(), end, value);
    if (problem == std::errc{} && stop != end) return std::errc::invalid_argument;
    return problem;
}

/// Whether the whole of `word` is a number.
[[nodiscard]] inline bool is_number(std::string_view word) {
    double value = 0;
    return parse_number(word, value) != std::errc::invalid_argument;
}

}  // namespace gnomon::io::detail

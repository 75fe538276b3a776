// SPDX-License-Identifier: BSL-1.0
/// @file
/// Splits a line into words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

namespace gnomon::io::detail {

/// Splits a line into words, one at a time. Words are separated by blanks, or by one separator such
/// as ',' with optional blanks around it: the second word of "1,,2" is empty. Refers to the line.
class splitter {
  public:
    splitter() = default;
    /// @param separator  a character in addition to blanks
    explicit splitter(std::string_view line, char separator = ' ')
        : rest_(line), separator_(separator) {
        skip_blanks();
    }

    /// Returns the next word and advances; none at the end of the line.
    [[nodiscard]] std::optional<std::string_view> next() {
        if (rest_.empty()) return std::nullopt;
        const char ends[] = {' ', '\t', '\v', '\f', '\r', separator_};
        const std::size_t length = std::min(rest_.find_first_of({ends, sizeof ends}), rest_.size());
        const std::string_view word = rest_.substr(0, length);
        rest_.remove_prefix(length);
        skip_blanks();
        if (rest_.starts_with(separator_)) {
            rest_.remove_prefix(1);
            skip_blanks();
        }
        return word;
    }

    /// Returns whether no word is left.
    [[nodiscard]] bool empty() const { return rest_.empty(); }

  private:
    void skip_blanks() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\v\f\r"), rest_.size()));
    }

    std::string_view rest_;
    char separator_ = ' ';
};

}  // namespace gnomon::io::detail

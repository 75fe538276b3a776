// SPDX-License-Identifier: BSL-1.0
/// @file
/// A cursor in a text. Gives lines, words and numbers; errors name the line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include <gnomon/core/error.hpp>
#include <gnomon/io/detail/number.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io::detail {

/// Returns `word` for an error message: in quotes, shortened, and without unprintable characters.
[[nodiscard]] inline std::string in_quotes(std::string_view word) {
    constexpr std::size_t longest = 32;
    std::string result = "\"";
    for (const char c : word.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (word.size() > longest ? "...\"" : "\"");
}

/// Reads an input as text. Refers to the input.
class text_cursor {
  public:
    explicit text_cursor(const input& file) : file_(&file) {}

    /// Returns the next line without its end ("\n" or "\r\n") and advances; none at the end of the
    /// file.
    [[nodiscard]] std::optional<std::string_view> line() {
        line_ = next_line_;
        if (remaining() == 0) return std::nullopt;
        const std::string_view rest = std::string_view(file_->bytes).substr(offset_);
        const std::size_t end = rest.find('\n');
        std::string_view result = rest.substr(0, end);
        offset_ += result.size();
        if (end != std::string_view::npos) {
            ++offset_;
            ++next_line_;
        }
        if (result.ends_with('\r')) result.remove_suffix(1);
        return result;
    }

    /// Returns the words of the next line that is not blank, and advances.
    /// @throws gnomon::error  at the end of the file
    [[nodiscard]] splitter words() {
        while (const auto text = line())
            if (text->find_first_not_of(" \t\v\f\r") != std::string_view::npos)
                return splitter(*text);
        fail("the file ends too early");
    }

    /// Skips `prefix` if the text continues with it.
    void skip(std::string_view prefix) {
        if (std::string_view(file_->bytes).substr(offset_).starts_with(prefix))
            offset_ += prefix.size();
    }

    /// Returns the next word of `words` as a number.
    /// @throws gnomon::error  if there is none, if it cannot be parsed, or if a double overflows
    [[nodiscard]] double number(splitter& words) const { return parse<double>(words, "a number"); }

    /// Returns the next word of `words` as a count.
    /// @throws gnomon::error  if there is none, or if it is no count
    [[nodiscard]] std::uint64_t count(splitter& words) const {
        return parse<std::uint64_t>(words, "a count");
    }

    /// Returns the next word of `words` as a size in memory.
    /// @throws gnomon::error  if there is none, or if it is no size
    [[nodiscard]] std::size_t size(splitter& words) const {
        return parse<std::size_t>(words, "a count");
    }

    /// Checks that the rest of the text can hold `rows` rows of one-digit numbers, before memory is
    /// allocated for them.
    /// @param values  minimum number of values per row
    /// @throws gnomon::error  if it cannot
    void require_rows(std::uint64_t rows, std::size_t values) const {
        if (rows > (std::uint64_t{remaining()} + 1) / (2 * std::max<std::size_t>(values, 1)))
            fail(std::to_string(rows) + " points or elements are declared, but only " +
                 std::to_string(remaining()) + " bytes are left");
    }

    /// The number of bytes before the cursor.
    [[nodiscard]] std::size_t offset() const { return offset_; }

    /// The number of bytes to the end of the file.
    [[nodiscard]] std::size_t remaining() const { return file_->bytes.size() - offset_; }

    /// Throws an error at the line returned last.
    [[noreturn]] void fail(const std::string& message) const {
        GNOMON_THROW(error(file_->name, "line " + std::to_string(line_), message));
    }

  private:
    template <class T>
    [[nodiscard]] T parse(splitter& words, const char* what) const {
        const std::optional<std::string_view> word = words.next();
        if (!word) fail(std::string(what) + " is missing");
        T value{};
        const std::errc problem = parse_number(*word, value);
        if (problem == std::errc::result_out_of_range) fail(in_quotes(*word) + " is out of range");
        if (problem != std::errc{}) fail(in_quotes(*word) + " is not " + what);
        return value;
    }

    const input* file_;
    std::size_t offset_ = 0;
    std::size_t line_ = 1;       // number of the line returned last
    std::size_t next_line_ = 1;  // number of the next line
};

}  // namespace gnomon::io::detail

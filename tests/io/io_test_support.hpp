// SPDX-License-Identifier: BSL-1.0
/// @file
/// Support for the tests of file formats: temporary files, the expectation of an error at a
/// position, and laws that every parser satisfies for any bytes.
#pragma once

#include <cstddef>
#include <cstdio>
#include <random>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include <gnomon/core/error.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/input.hpp>

namespace io_test {

/// A path that no other test uses.
[[nodiscard]] inline std::string scratch_path(const std::string& name) {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    return testing::TempDir() + test->test_suite_name() + "_" + test->name() + "_" + name;
}

/// Writes a file, with the C library only.
[[nodiscard]] inline std::string scratch_file(const std::string& name, std::string_view bytes) {
    std::string path = scratch_path(name);
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    EXPECT_NE(file, nullptr);
    EXPECT_EQ(std::fwrite(bytes.data(), 1, bytes.size(), file), bytes.size());
    EXPECT_EQ(std::fclose(file), 0);
    return path;
}

[[nodiscard]] inline bool exists(const std::string& path) {
    std::FILE* const file = std::fopen(path.c_str(), "rb");
    return file != nullptr && std::fclose(file) == 0;
}

/// The bytes of literals, which may contain zeros.
template <std::size_t N>
[[nodiscard]] std::string bytes_of(const char (&literal)[N]) {
    return std::string(literal, N - 1);
}

/// Expects that `parser` throws an error for `bytes` at `position`, with `part` in its message.
template <class Parser>
void expect_error(Parser parser, const std::string& bytes, const std::string& position,
                  const std::string& part) {
    SCOPED_TRACE(bytes.substr(0, 400));
    try {
        static_cast<void>(parser(gnomon::io::input{"some.file", bytes}));
        ADD_FAILURE() << "parsed, but should have failed with \"" << part << "\" at " << position;
    } catch (const gnomon::error& e) {
        EXPECT_EQ(e.file(), "some.file");
        EXPECT_EQ(e.position(), position) << e.what();
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
}

/// Law: any bytes give a scan or a gnomon::error, never a crash or another exception.
/// @return whether they give a scan
template <class Parser>
bool survives(Parser parser, const std::string& bytes) {
    try {
        const gnomon::scan result = parser(gnomon::io::input{"some.file", bytes});
        for (const gnomon::scan::scalar_field& field : result.fields)
            EXPECT_EQ(field.values.size(), result.size());
        EXPECT_TRUE(result.viewpoints.covers(result.size()));
        EXPECT_LE(result.size(), 100 * bytes.size() + 100);
        return true;
    } catch (const gnomon::error& e) {
        EXPECT_FALSE(e.position().empty()) << e.what();
        return false;
    }
}

/// Law: no prefix of a file crashes the parser; if the format declares the number of bytes, no
/// proper prefix gives a scan.
template <class Parser>
void check_truncation(Parser parser, const std::string& bytes, bool is_binary) {
    ASSERT_TRUE(survives(parser, bytes));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const bool parsed = survives(parser, bytes.substr(0, size));
        EXPECT_FALSE(is_binary && parsed) << "the first " << size << " bytes";
    }
}

/// Law: no damage crashes the parser; up to four bytes are changed, inserted or removed.
template <class Parser>
void check_mutation(Parser parser, const std::string& bytes, int rounds = 3000) {
    std::mt19937_64 random(20170401);
    const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const std::string_view likely = "0123456789-+.e \n,nafi\xff";
    for (int i = 0; i < rounds; ++i) {
        std::string damaged = bytes;
        for (std::size_t k = below(4) + 1; k > 0; --k) {
            const std::size_t at = below(damaged.size());
            const char c =
                below(2) == 0 ? static_cast<char>(below(256)) : likely[below(likely.size())];
            switch (below(3)) {
                case 0:
                    damaged[at] = c;
                    break;
                case 1:
                    damaged.insert(at, 1, c);
                    break;
                default:
                    damaged.erase(at, 1);
                    break;
            }
        }
        survives(parser, damaged);
    }
}

}  // namespace io_test

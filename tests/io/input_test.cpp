// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/error.hpp>
#include <gnomon/io/input.hpp>

TEST(io_input, holds_all_bytes_of_a_file_of_any_size) {
    for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 131072U, 300000U}) {
        std::string bytes(size, '\0');
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i >> 3);
        const std::string path = io_test::scratch_file("any", bytes);
        const gnomon::io::input file = gnomon::io::load(path);
        EXPECT_EQ(file.name, path);
        EXPECT_EQ(file.bytes, bytes);
    }
}

TEST(io_input, refuses_a_missing_file_and_a_directory_with_the_systems_reason) {
    const std::string missing = io_test::scratch_path("missing");
    try {
        static_cast<void>(gnomon::io::load(missing));
        FAIL();
    } catch (const gnomon::error& e) {
        EXPECT_EQ(e.file(), missing);
        EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
    }
    EXPECT_THROW(static_cast<void>(gnomon::io::load(testing::TempDir())), gnomon::error);
}

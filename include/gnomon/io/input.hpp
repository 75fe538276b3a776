// SPDX-License-Identifier: BSL-1.0
/// @file
/// The contents of a file and its name. Readers parse an `input`, so bytes in memory (a message, a
/// test) are parsed as a file is, and every error names its file.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include <gnomon/io/detail/os_error.hpp>

namespace gnomon::io {

/// The argument of the readers.
struct input {
    std::string name;   ///< name for error messages
    std::string bytes;  ///< the whole contents of the file
};

/// Reads the whole file `path` into memory.
/// @throws gnomon::error  with the operating system's message, if the file cannot be opened or read
/// Complexity: O(bytes).
[[nodiscard]] inline input load(const std::string& path) {
    struct closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, closer> file(std::fopen(path.c_str(), "rb"));
    if (!file) GNOMON_THROW(detail::os_error(path, errno));

    // Reads until the end instead of querying the size: pipes have no size, and the C library has
    // no portable 64-bit query.
    std::string bytes;
    std::size_t size = 0;
    do {
        bytes.resize(std::max<std::size_t>(2 * size, 1 << 16));
        size += std::fread(bytes.data() + size, 1, bytes.size() - size, file.get());
    } while (size == bytes.size());
    if (std::ferror(file.get()) != 0) GNOMON_THROW(detail::os_error(path, errno));
    bytes.resize(size);
    return {path, std::move(bytes)};
}

}  // namespace gnomon::io

// SPDX-License-Identifier: BSL-1.0
/// @file
/// A file's bytes with the file's name. Readers parse an `input`, so that bytes from memory (a
/// message, a test) are read as a file is, and every complaint can name its file.
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

/// What a reader parses.
struct input {
    std::string name;   ///< as it shall appear in errors
    std::string bytes;  ///< the whole contents
};

/// The contents of the file `path`, however large.
/// @throws gnomon::error  with the system's reason, for a file that cannot be opened or read
[[nodiscard]] inline input load(const std::string& path) {
    struct closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, closer> file(std::fopen(path.c_str(), "rb"));
    if (!file) throw detail::os_error(path, errno);

    // Until nothing more comes, instead of asking for the size: pipes have none, and the C library
    // has no portable 64-bit answer.
    std::string bytes;
    std::size_t size = 0;
    do {
        bytes.resize(std::max<std::size_t>(2 * size, 1 << 16));
        size += std::fread(bytes.data() + size, 1, bytes.size() - size, file.get());
    } while (size == bytes.size());
    if (std::ferror(file.get()) != 0) throw detail::os_error(path, errno);
    bytes.resize(size);
    return {path, std::move(bytes)};
}

}  // namespace gnomon::io

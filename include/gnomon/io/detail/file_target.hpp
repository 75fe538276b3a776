// SPDX-License-Identifier: BSL-1.0
/// @file
/// Resolves the name of a file that is to be written.
#pragma once

#include <string>

#ifndef _WIN32
#include <climits>
#include <cstdlib>

#include <sys/stat.h>
#endif

#include <gnomon/core/error.hpp>

namespace gnomon::io::detail {

/// Returns the file of the name `path` with symbolic links resolved; `path` itself if the file does
/// not exist, or where the system cannot resolve them (Windows, WASI).
/// @throws gnomon::error  if `path` is a device, a pipe or a directory, which must not be replaced
[[nodiscard]] inline std::string file_target(const std::string& path) {
#ifdef _WIN32
    return path;
#else
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return path;
    if (!S_ISREG(status.st_mode)) GNOMON_THROW(error(path, "", "not a regular file"));
#ifdef __wasi__
    return path;
#else
    char resolved[PATH_MAX];
    return ::realpath(path.c_str(), resolved) != nullptr ? std::string(resolved) : path;
#endif
#endif
}

}  // namespace gnomon::io::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What the operating system says when it refuses a file.
#pragma once

#include <string>
#include <system_error>

#include <gnomon/core/error.hpp>

namespace gnomon::io::detail {

/// The error for `path` with the text of the errno value `code`.
[[nodiscard]] inline error os_error(const std::string& path, int code) {
    return {path, "", std::generic_category().message(code)};
}

}  // namespace gnomon::io::detail

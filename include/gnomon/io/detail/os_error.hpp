// SPDX-License-Identifier: BSL-1.0
/// @file
/// Errors of the operating system as `gnomon::error`.
#pragma once

#include <string>
#include <system_error>

#include <gnomon/core/error.hpp>

namespace gnomon::io::detail {

/// Returns the error for the file `path` with the message of the errno value `code`.
[[nodiscard]] inline error os_error(const std::string& path, int code) {
    return {path, "", std::generic_category().message(code)};
}

}  // namespace gnomon::io::detail

// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

/// The path of a file, or folder, of the data that are too large for the repository, or nothing
/// where it is not at hand; tests are skipped then. (The one of the tests that knows where they
/// lie: all else compiles to the same wherever that is.)
[[nodiscard]] std::string shared_file(const std::string& name);

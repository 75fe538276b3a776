// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

/// The path of a file or folder of the data that are too large for the repository, or nothing where
/// it does not exist; tests are skipped then. (Only shared_file.cpp depends on the location of the
/// data: the objects of all other tests can be cached.)
[[nodiscard]] std::string shared_file(const std::string& name);

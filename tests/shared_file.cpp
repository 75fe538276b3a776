// SPDX-License-Identifier: BSL-1.0
#include "shared_file.hpp"

#include <filesystem>

std::string shared_file(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(GNOMON_SHARED_DATA) / name;
    return exists(path) ? path.string() : std::string();
}

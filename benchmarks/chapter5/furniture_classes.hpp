// SPDX-License-Identifier: BSL-1.0
/// @file
/// Furniture from mesh files, and which models are chairs and tables.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <gnomon/adapters/furniture_file.hpp>
#include <gnomon/simulation/furniture.hpp>

namespace furniture {

enum class_number : std::uint32_t { chair, table, other, classes };

/// From names of models, such as "ikea_chair_agne_0010" and "round table".
[[nodiscard]] inline std::uint32_t class_of(const std::string& name) {
    const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
    if (has("chair") || has("carver")) return chair;
    return has("table") || has("desk") ? table : other;
}

/// Whether the folder is there; else a line says that it is not.
[[nodiscard]] inline bool is_there(const std::string& folder) {
    if (std::filesystem::is_directory(folder)) return true;
    std::printf("%s is not there: left out\n", folder.c_str());
    return false;
}

/// All models of a folder, in the order of their names.
[[nodiscard]] inline std::vector<gnomon::simulation::furniture_model> read_all(
    const std::string& folder) {
    std::vector<std::string> paths;
    for (const auto& file : std::filesystem::directory_iterator(folder))
        if (file.path().extension() == ".obj") paths.push_back(file.path().string());
    std::ranges::sort(paths);
    std::vector<gnomon::simulation::furniture_model> models;
    for (const std::string& path : paths)
        models.push_back(gnomon::simulation::read_furniture(path));
    return models;
}

}  // namespace furniture

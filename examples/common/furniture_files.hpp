// SPDX-License-Identifier: BSL-1.0
/// @file
/// Furniture of mesh files: those of a directory, and of its folders, which are classes. Programs
/// that are built without Assimp refuse them.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/command_line.hpp"
#include <gnomon/core.hpp>
#include <gnomon/simulation.hpp>
#ifdef GNOMON_EXAMPLES_ASSIMP
#include <gnomon/adapters/furniture_file.hpp>
#endif

namespace common {

namespace sim = gnomon::simulation;

/// A piece of furniture, and the class that its file is in.
struct furniture_file {
    std::string class_name;
    sim::furniture_model model;
};

/// Whether there is a directory of this name; not if that cannot be read.
inline bool is_folder(const std::filesystem::path& path) {
    std::error_code problem;
    return std::filesystem::is_directory(path, problem);
}

inline bool is_mesh_file(const std::filesystem::path& path) {
    static const std::vector<std::string> kinds{".obj", ".stl",  ".ply", ".off",
                                                ".dae", ".gltf", ".glb"};
    std::string kind = path.extension().string();
    for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    std::error_code problem;  // a link to nowhere is no file
    return std::ranges::find(kinds, kind) != kinds.end() &&
           !path.stem().string().starts_with(".") &&
           std::filesystem::is_regular_file(path, problem);
}

/// What is in a directory, in the order of the names.
inline std::vector<std::filesystem::path> sorted_entries(const std::filesystem::path& directory) {
    std::error_code problem;
    std::vector<std::filesystem::path> entries;
    for (std::filesystem::directory_iterator entry(directory, problem), end;
         !problem && entry != end; entry.increment(problem))
        entries.push_back(entry->path());
    if (problem) throw gnomon::error(directory.string(), "", problem.message());
    std::ranges::sort(entries);
    return entries;
}

/// The furniture of a mesh file, or of all in a directory. A file is a class of its own, with its
/// name; the files in a folder of the directory are one class with the name of the folder.
/// @throws gnomon::error  if a file cannot be read, or there is none
/// @throws usage_error    without Assimp
inline std::vector<furniture_file> furniture_in([[maybe_unused]] const std::string& option,
                                                [[maybe_unused]] const std::string& path,
                                                [[maybe_unused]] bool y_up) {
#ifdef GNOMON_EXAMPLES_ASSIMP
    std::vector<furniture_file> all;
    const auto add = [&](const std::filesystem::path& file, const std::string& name) {
        all.push_back(
            {name, sim::read_furniture(file.string(), y_up ? sim::up_axis::y : sim::up_axis::z)});
    };
    if (!is_folder(path)) {
        add(path, std::filesystem::path(path).stem().string());
        return all;
    }
    for (const auto& entry : sorted_entries(path)) {
        if (is_folder(entry)) {
            for (const auto& file : sorted_entries(entry))
                if (is_mesh_file(file)) add(file, entry.filename().string());
        } else if (is_mesh_file(entry)) {
            add(entry, entry.stem().string());
        }
    }
    if (all.empty()) throw gnomon::error(path, "", "has no mesh files");
    return all;
#else
    throw usage_error(option + ": this program was built without Assimp, which reads mesh files");
#endif
}

}  // namespace common

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The models to learn from, with their classes: the built-in ones, or mesh files where Assimp is
/// available.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "learn_objects/options.hpp"
#include <gnomon/core.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/simulation.hpp>
#ifdef GNOMON_EXAMPLES_ASSIMP
#include <gnomon/adapters/furniture_file.hpp>
#endif

namespace sim = gnomon::simulation;

/// A model and what it is an example of.
struct example {
    std::string name;  ///< of its class
    sim::furniture_model model;
    std::size_t views;
};

namespace detail {

/// Things that are no furniture: cupboards, cartons, boards and bins of random sizes, and pieces of
/// walls of which the rest is hidden.
inline std::vector<sim::furniture_model> clutter(std::size_t pieces, std::uint64_t seed) {
    std::vector<sim::furniture_model> all;
    for (std::size_t i = 0; i < pieces; ++i) {
        gnomon::random_stream random(seed, i);
        sim::scene piece;
        const auto block = [&](const char* name, double x, double y, double z, double turned = 0) {
            piece.add_object(name, sim::box{x, y, z},
                             sim::yaw(gnomon::degrees(turned)) * sim::at(0.0, 0.0, 0.5 * z));
        };
        switch (i % 6) {
            case 0:
                block("cupboard", random.uniform(0.3, 0.6), random.uniform(0.5, 1.2),
                      random.uniform(0.8, 2.1));
                break;
            case 1:
                block("carton", random.uniform(0.2, 0.6), random.uniform(0.2, 0.6),
                      random.uniform(0.15, 0.6));
                break;
            case 2:
                piece.add_object(
                    "bin", sim::cylinder{random.uniform(0.1, 0.25), random.uniform(0.2, 0.7)});
                break;
            case 3:
                block("board", 0.03, random.uniform(0.5, 2.0), random.uniform(0.8, 2.0));
                break;
            case 4:
                block("wall", 0.1, random.uniform(0.3, 2.0), random.uniform(2.2, 2.6));
                block("other wall", 0.1, random.uniform(0.3, 2.0), random.uniform(2.2, 2.6), 90);
                break;
            default:
                block("carton", 0.5, 0.4, 0.3);
                piece.add_object("upper carton",
                                 sim::box{random.uniform(0.2, 0.45), random.uniform(0.2, 0.4),
                                          random.uniform(0.1, 0.4)},
                                 sim::at(0.0, 0.0, 0.5));
        }
        all.push_back({"clutter " + std::to_string(i + 1), std::move(piece)});
    }
    return all;
}

inline std::vector<example> built_in(const options& o) {
    constexpr std::size_t pieces_of_clutter = 24;
    std::vector<example> all;
    for (auto& model : sim::furniture_models()) all.push_back({model.name, model, o.views});
    // In all the number of views of three models.
    const std::size_t each = std::max<std::size_t>(1, 3 * o.views / pieces_of_clutter);
    for (auto& model : clutter(pieces_of_clutter, o.seed))
        all.push_back({std::string(gnomon::recognition::background_name), std::move(model), each});
    return all;
}

#ifdef GNOMON_EXAMPLES_ASSIMP
inline bool is_mesh_file(const std::filesystem::path& path) {
    static const std::vector<std::string> kinds{".obj", ".stl",  ".ply", ".off",
                                                ".dae", ".gltf", ".glb"};
    std::string kind = path.extension().string();
    for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return std::ranges::find(kinds, kind) != kinds.end() && !path.stem().string().starts_with(".");
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

inline std::vector<example> in_files(const options& o) {
    const auto up = o.y_up ? sim::up_axis::y : sim::up_axis::z;
    std::vector<example> all;
    const auto add = [&](const std::filesystem::path& file, const std::string& name) {
        if (is_mesh_file(file))
            all.push_back({name, sim::read_furniture(file.string(), up), o.views});
    };
    for (const auto& entry : sorted_entries(o.models)) {
        if (std::filesystem::is_directory(entry)) {
            for (const auto& file : sorted_entries(entry)) add(file, entry.filename().string());
        } else {
            add(entry, entry.stem().string());
        }
    }
    if (all.empty()) throw gnomon::error(o.models, "", "has no mesh files");
    return all;
}
#endif

}  // namespace detail

/// The models that the options name, those of a class in one order for all runs.
/// @throws gnomon::error  if a file cannot be read, or there are fewer than two classes
inline std::vector<example> examples_of(const options& o) {
    if (o.models.empty()) return detail::built_in(o);
#ifdef GNOMON_EXAMPLES_ASSIMP
    auto all = detail::in_files(o);
    if (std::ranges::all_of(all, [&](const example& e) { return e.name == all.front().name; }))
        throw gnomon::error(o.models, "",
                            "has the class " + all.front().name +
                                " only; two are required, such as a folder "
                                "\"background\"");
    return all;
#else
    throw usage_error("--models: this program was built without Assimp, which reads mesh files");
#endif
}

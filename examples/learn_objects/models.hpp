// SPDX-License-Identifier: BSL-1.0
/// @file
/// The models to learn from, with their classes: the built-in ones or those of mesh files, and
/// background.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/furniture_files.hpp"
#include "learn_objects/options.hpp"
#include <gnomon/core.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/simulation.hpp>

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
        const auto block = [&](const char* name, const sim::box& of, double turned = 0.0,
                               double base = 0.0) {
            piece.add_object(
                name, of,
                sim::yaw(gnomon::degrees(turned)) * sim::at(0.0, 0.0, base + 0.5 * of.height));
        };
        // Braces, as the order in which arguments are drawn is not defined.
        switch (i % 6) {
            case 0:
                block("cupboard", sim::box{random.uniform(0.3, 0.6), random.uniform(0.5, 1.2),
                                           random.uniform(0.8, 2.1)});
                break;
            case 1:
                block("carton", sim::box{random.uniform(0.2, 0.6), random.uniform(0.2, 0.6),
                                         random.uniform(0.15, 0.6)});
                break;
            case 2:
                piece.add_object(
                    "bin", sim::cylinder{random.uniform(0.1, 0.25), random.uniform(0.2, 0.7)});
                break;
            case 3:
                block("board", sim::box{0.03, random.uniform(0.5, 2.0), random.uniform(0.8, 2.0)});
                break;
            case 4:
                block("wall", sim::box{0.1, random.uniform(0.3, 2.0), random.uniform(2.2, 2.6)});
                block("other wall",
                      sim::box{0.1, random.uniform(0.3, 2.0), random.uniform(2.2, 2.6)}, 90.0);
                break;
            default: {
                constexpr double lower = 0.3;  // height of the carton [m]
                block("carton", sim::box{0.5, 0.4, lower});
                block("upper carton",
                      sim::box{random.uniform(0.2, 0.45), random.uniform(0.2, 0.4),
                               random.uniform(0.1, 0.4)},
                      0.0, lower);
            }
        }
        all.push_back({"clutter " + std::to_string(i + 1), std::move(piece)});
    }
    return all;
}

/// Adds a model as an example of a class, with a view at least.
inline void add_example(std::vector<example>& all, std::string_view name,
                        sim::furniture_model model, std::size_t views) {
    all.push_back({std::string(name), std::move(model), std::max<std::size_t>(1, views)});
}
/// The same for several models.
inline void add_examples(std::vector<example>& all, std::string_view name,
                         std::vector<sim::furniture_model> models, std::size_t views) {
    for (auto& model : models) add_example(all, name, std::move(model), views);
}

/// Adds what is background, with the number of views that three models have.
inline void add_background(std::vector<example>& all, const options& o) {
    constexpr std::size_t pieces = 24;
    add_examples(all, gnomon::recognition::background_name, clutter(pieces, o.seed),
                 3 * o.views / pieces);
}

/// Adds chairs, tables and clutter of offices. There are many models, so that a quarter of the
/// views of each is enough; how many was chosen on a real office (docs/results/chapter5.md). The
/// stool is none of these.
inline void add_office(std::vector<example>& all, const options& o) {
    const std::size_t views = o.views / 4;
    for (auto& model : sim::furniture_models()) {
        if (model.name == "stool") continue;
        const bool is_chair = std::holds_alternative<sim::chair>(model.piece);
        add_example(all, is_chair ? "chair" : "table", std::move(model), views);
    }
    add_examples(all, "chair", sim::office_chairs(16, o.seed), views);
    add_examples(all, "table", sim::office_tables(16, o.seed), views);
    add_examples(all, gnomon::recognition::background_name, sim::clutter_models(48, o.seed), views);
    add_background(all, o);
}

}  // namespace detail

/// The models that the options name, in one order for all runs, and background: the folder
/// "background" of the files if there is one, else clutter; for offices both.
/// @throws gnomon::error  if a file cannot be read
/// @throws usage_error    for mesh files, without Assimp
inline std::vector<example> examples_of(const options& o) {
    std::vector<example> all;
    if (o.office) detail::add_office(all, o);
    if (!o.models.empty()) {
        for (auto& file : common::furniture_in("--models", o.models, o.y_up))
            detail::add_example(all, file.class_name, std::move(file.model), o.views);
    } else if (!o.office) {
        for (auto& model : sim::furniture_models())
            detail::add_example(all, model.name, model, o.views);
    }
    const auto is_background = [](const example& e) {
        return e.name == gnomon::recognition::background_name;
    };
    if (std::ranges::none_of(all, is_background)) detail::add_background(all, o);
    if (std::ranges::all_of(all, is_background))
        throw gnomon::error(o.models, "", "has background only");
    return all;
}

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Furniture models for recognition: twelve built-in ones, six chairs and six tables, modelled
/// after Klasing 2010, Fig. 5.3, and any scene, such as one from a mesh file
/// (gnomon/adapters/furniture_file.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <gnomon/simulation/chair.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/table.hpp>

namespace gnomon::simulation {

/// A furniture model and its name. The frame of a scene, as that of the built-in pieces, lies on
/// the floor below the middle of the piece; z points up.
struct furniture_model {
    std::string name;                         ///< of the model
    std::variant<chair, table, scene> piece;  ///< the model itself
};

/// Adds a model as one object with the model's name.
/// @return the number of the object
inline std::int32_t add(scene& world, const furniture_model& model, const pose& at = {}) {
    return std::visit([&](const auto& piece) { return add(world, model.name, piece, at); },
                      model.piece);
}

namespace detail {

/// The armchair of Figs. 4.8 and 4.11, 0.75 m wide including its arms.
[[nodiscard]] inline chair armchair(double seat_height) {
    return {.width = 0.51,
            .depth = 0.75,
            .seat_height = seat_height,
            .back_height = 0.85,
            .back_thickness = 0.15,
            .arm_height = 0.60,
            .arm_width = 0.12,
            .massive = true};
}

}  // namespace detail

/// The twelve models: six chairs, then six tables.
[[nodiscard]] inline std::vector<furniture_model> furniture_models() {
    return {
        {"kitchen chair", chair{}},
        {"lattice chair", chair{.back = chair_back::lattice}},
        {"ladder chair", chair{.width = 0.40,
                               .depth = 0.38,
                               .seat_height = 0.46,
                               .back = chair_back::ladder,
                               .back_height = 0.98,
                               .slats = 3}},
        {"stool",
         chair{
             .width = 0.36, .depth = 0.36, .leg = 0.035, .back = chair_back::none, .round = true}},
        {"carver", chair{.width = 0.48,
                         .depth = 0.46,
                         .seat_height = 0.44,
                         .back_height = 0.86,
                         .arm_height = 0.66}},
        {"armchair", detail::armchair(0.43)},
        {"dining table", table{.length = 1.60, .width = 0.90}},
        {"coffee table", table{.length = 0.90,
                               .width = 0.55,
                               .height = 0.45,
                               .thickness = 0.05,
                               .inset = 0.0,
                               .shelf_height = 0.15}},
        {"round table",
         table{.length = 1.00, .leg = 0.10, .base = table_base::pedestal, .round = true}},
        {"desk", table{.length = 1.40,
                       .width = 0.70,
                       .height = 0.72,
                       .leg = 0.03,
                       .inset = 0.0,
                       .base = table_base::panels}},
        {"side table", table{.length = 0.55,
                             .width = 0.55,
                             .height = 0.50,
                             .leg = 0.04,
                             .inset = 0.0,
                             .round = false}},
        {"trestle table", table{.length = 1.80,
                                .width = 0.75,
                                .height = 0.75,
                                .inset = 0.20,
                                .base = table_base::trestles}},
    };
}

}  // namespace gnomon::simulation

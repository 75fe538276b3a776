// SPDX-License-Identifier: BSL-1.0
/// @file
/// The lengths of a room: between opposite planes, along walls, and of openings.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "flat_part.hpp"
#include "opening.hpp"
#include "room.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

/// A length of a room.
struct survey_length {
    std::string kind;  ///< "planes", "wall" or "opening"
    std::string name;
    measured_length length;
};

/// A room and its lengths.
struct survey {
    struct named_opening : wall_opening {
        std::string name;
    };

    room planes;
    std::vector<named_opening> openings;
    std::vector<survey_length> lengths;
};

namespace detail {

/// The place at which the distance of two opposite walls is measured: in the middle of both.
inline Eigen::Vector3d between(const wall& a, const wall& b) {
    return 0.5 * (a.middle() + b.middle());
}

inline void add_distances(survey& s) {
    const room& r = s.planes;
    for (std::size_t i = 0; i < r.opposite.size(); ++i) {
        const auto& [a, b] = r.opposite[i];
        std::string name = "wall " + std::to_string(a + 1) + " to wall " + std::to_string(b + 1);
        // Of a room with four walls.
        if (r.walls.size() == 4 && r.opposite.size() == 2) name = i == 0 ? "length" : "width";
        s.lengths.push_back(
            {"planes", name,
             distance_between(r.walls[a], r.walls[b], between(r.walls[a], r.walls[b]))});
    }
    if (r.floor && r.ceiling) {
        const Eigen::Vector3d middle = 0.5 * (r.floor->plane.centroid + r.ceiling->plane.centroid);
        s.lengths.push_back({"planes", "height", distance_between(*r.floor, *r.ceiling, middle)});
    }
    for (std::size_t i = 0; i < r.walls.size(); ++i)
        if (const auto length = length_of(r, r.walls[i]))
            s.lengths.push_back({"wall", "wall " + std::to_string(i + 1), *length});
}

inline void add_lengths(survey& s, const survey::named_opening& o) {
    const auto& [left, right, bottom, top] = o.edges;
    const auto add = [&](const char* what, const measured_length& low,
                         const measured_length& high) {
        s.lengths.push_back({"opening",
                             o.name + " " + what,
                             {high.value - low.value, std::hypot(low.sigma, high.sigma)}});
    };
    if (left && right) add("width", *left, *right);
    if (bottom && top) add("height", *bottom, *top);
    if (!s.planes.floor) return;
    // Heights above the floor at the foot of the opening.
    const wall& w = s.planes.walls[o.wall];
    const Eigen::Vector3d foot = w.at(o.middle_u(), 0.0);
    const measured_length floor{-s.planes.floor->distance(foot),
                                std::sqrt(s.planes.floor->variance_at(foot))};
    if (o.is_door && top) add("height", floor, *top);
    if (bottom) add("sill", floor, *bottom);
}

}  // namespace detail

/// Measures a room.
/// @param seen  what `perception` returned for the scan
inline survey survey_of(const gnomon::scan& scan, const auto& seen, const Eigen::Vector3d& up,
                        const gnomon::threads& threads) {
    const scan_noise noise(seen);
    survey s;
    const flat_parts parts = flat_parts_of(scan, seen, noise, threads);
    s.planes = room_of(scan, parts, noise, up);
    detail::add_distances(s);
    int doors = 0, windows = 0;
    for (std::size_t w = 0; w < s.planes.walls.size(); ++w) {
        for (const wall_opening& o : openings_of(s.planes, w, scan, parts, noise)) {
            s.openings.push_back({o, o.is_door ? "door " + std::to_string(++doors)
                                               : "window " + std::to_string(++windows)});
            detail::add_lengths(s, s.openings.back());
        }
    }
    return s;
}

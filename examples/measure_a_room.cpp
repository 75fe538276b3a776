// SPDX-License-Identifier: BSL-1.0
/// @file
/// How large is this room, and how well do we know? From a scan to the lengths of its walls, doors
/// and windows with their standard deviations, and a floor plan.

#include <algorithm>
#include <cstdio>
#include <string>

#include <Eigen/Core>

#include "common/json.hpp"
#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "common/seen_scan.hpp"
#include "measure_a_room/floor_plan.hpp"
#include "measure_a_room/options.hpp"
#include "measure_a_room/simulated_room.hpp"
#include "measure_a_room/survey.hpp"
#include "picture/picture.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/io/read_las.hpp>
#include <gnomon/perception.hpp>

namespace {

/// @throws gnomon::error  if the file cannot be read, or no point of it is finite
gnomon::scan scan_of(const options& o) {
    constexpr double sigma = 0.015;  // of the simulated scan [m]
    return seen_scan(
        o.scan.empty() ? scan_all_around(room_with_openings(o.seed), sigma, o.seed, o.threads).scan
                       : gnomon::io::read(o.scan),
        o.scan, o.viewpoint);
}

/// @throws gnomon::error  if there is no room
survey measured(const gnomon::scan& scan, const options& o) {
    const progress shown("measuring");
    // [measure_a_room]
    gnomon::perception<> chain;
    if (o.sigma) chain.noise = gnomon::constant_noise{*o.sigma};
    const auto seen = chain(scan, o.threads);
    survey s = survey_of(scan, seen, o.up, o.threads);
    // [measure_a_room]
    if (s.planes.walls.empty()) throw gnomon::error(o.scan, "", "has no walls");
    return s;
}

json report_of(const gnomon::scan& scan, const survey& s) {
    json lengths = json::array();
    for (const auto& [kind, name, length] : s.lengths) {
        lengths.push_back(
            {{"kind", kind}, {"name", name}, {"value", length.value}, {"sigma", length.sigma}});
    }
    json walls = json::array();
    for (const wall& w : s.planes.walls)
        walls.push_back({{"left", array_of(w.at(w.left, 0.0))},
                         {"right", array_of(w.at(w.right, 0.0))},
                         {"normal", array_of(w.normal())},
                         {"points", w.members.size()}});
    json openings = json::array();
    for (const auto& o : s.openings) {
        const auto edge = [&](std::size_t side, double guess) {
            return o.edges[side] ? o.edges[side]->value : guess;
        };
        const double left = edge(0, o.left), right = edge(1, o.right);
        const double bottom = o.is_door ? 0.0 : edge(2, o.bottom), top = edge(3, o.top);
        const wall& w = s.planes.walls[o.wall];
        openings.push_back(
            {{"name", o.name},
             {"wall", o.wall + 1},
             {"corners", json::array({array_of(w.at(left, bottom)), array_of(w.at(right, bottom)),
                                      array_of(w.at(right, top)), array_of(w.at(left, top))})}});
    }
    return {
        {"points", scan.size()}, {"lengths", lengths}, {"walls", walls}, {"openings", openings}};
}

void measure_a_room(const options& o) {
    const gnomon::scan scan = scan_of(o);
    const output_directory out(o.out, {"room.png", "room.json"});
    const survey s = measured(scan, o);
    const std::string plan = floor_plan(scan, s).png();
    gnomon::io::replace_file(out / "room.png", plan);
    gnomon::io::replace_file(out / "room.json", report_of(scan, s).dump(2) + "\n");

    std::printf("%s, %s, %s\n\n", picture::counted(scan.size(), "point").c_str(),
                picture::counted(s.planes.walls.size(), "wall").c_str(),
                picture::counted(s.openings.size(), "opening").c_str());
    for (const auto& [kind, name, length] : s.lengths)
        std::printf("%-20s %8.4f m +- %6.2f mm\n", name.c_str(), length.value, 1e3 * length.sigma);
    out.report();
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("measure_a_room", usage, options_from, measure_a_room, argc, argv);
}

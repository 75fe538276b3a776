// SPDX-License-Identifier: BSL-1.0
// Lengths of rooms with doors and windows, as the example measure_a_room measures them, against the
// truth: whether errors are as large as the standard deviations claim.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "../../examples/measure_a_room/simulated_room.hpp"
#include "../../examples/measure_a_room/survey.hpp"
#include "../chapter4/record.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

namespace {

/// Seeds of rooms that no other program uses. The constants of the example were chosen on the
/// seeds 1 to 3, 101 to 120 and 201 to 224.
constexpr std::uint64_t first_seed = 70'001;

/// A measured length and the true one.
struct compared_length {
    std::string kind;
    double error = 0.0;  ///< [m]
    double sigma = 0.0;  ///< [m]
};

/// What was measured of one room.
struct measured_room {
    std::vector<compared_length> lengths;
    std::size_t openings = 0, found = 0, spurious = 0;
};

/// The size of the room along the direction between two opposite walls, or along a wall.
double true_length(const Eigen::Vector3d& size, const Eigen::Vector3d& direction) {
    Eigen::Index axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    return size[axis];
}

/// The true opening nearest to a measured one, at most half a metre away.
const sim::opening* opening_at(const sim::scene& world, const Eigen::Vector3d& center) {
    constexpr double farthest = 0.5;  // [m]
    const auto distance = [&](const sim::opening& o) {
        return (o.rectangle.center - center).norm();
    };
    const auto nearest = std::ranges::min_element(world.openings, {}, distance);
    return nearest != world.openings.end() && distance(*nearest) < farthest ? &*nearest : nullptr;
}

void compare_openings(measured_room& result, const sim::scene& world, const survey& s) {
    result.openings = world.openings.size();
    std::vector<const sim::opening*> found;
    for (const auto& o : s.openings) {
        const wall& w = s.planes.walls[o.wall];
        const sim::opening* truth = opening_at(world, w.at(o.middle_u(), o.middle_v()));
        if (truth == nullptr) {
            ++result.spurious;
            continue;
        }
        if (std::ranges::find(found, truth) == found.end()) found.push_back(truth);
        const auto& [center, axes, lengths] = truth->rectangle;
        for (const survey_length& l : s.lengths) {
            if (l.kind != "opening" || !l.name.starts_with(o.name + " ")) continue;
            const std::string what = l.name.substr(o.name.size() + 1);
            const double expected = what == "width"    ? lengths[0]
                                    : what == "height" ? lengths[1]
                                                       : center.z() - 0.5 * lengths[1];
            result.lengths.push_back({what, l.length.value - expected, l.length.sigma});
        }
    }
    result.found = found.size();
}

measured_room measure_room(std::uint64_t seed, double noise) {
    const sim::scene world = room_with_openings(seed);
    const gnomon::scan scan =
        scan_all_around(world, noise, 1000 * seed + 1, gnomon::threads{1}).scan;
    const auto seen = gnomon::perception<>{}(scan);
    const survey s = survey_of(scan, seen, Eigen::Vector3d::UnitZ(), gnomon::threads{1});
    Eigen::Vector3d size = world.shapes()[0].extent.size();  // of the floor
    size.z() = world.shapes()[1].extent.high.z();            // of the ceiling

    measured_room result;
    const room& r = s.planes;
    for (const auto& [a, b] : r.opposite) {
        const measured_length l =
            distance_between(r.walls[a], r.walls[b], detail::between(r.walls[a], r.walls[b]));
        result.lengths.push_back(
            {"between walls", l.value - true_length(size, r.walls[a].normal()), l.sigma});
    }
    for (const survey_length& l : s.lengths)
        if (l.name == "height")
            result.lengths.push_back(
                {"floor to ceiling", l.length.value - size.z(), l.length.sigma});
    for (const wall& w : r.walls)
        if (const auto l = length_of(r, w))
            result.lengths.push_back(
                {"along walls", l->value - true_length(size, w.along), l->sigma});
    compare_openings(result, world, s);
    return result;
}

void add_row(json& rows, double noise, const char* name, const std::vector<std::string>& kinds,
             const std::vector<measured_room>& of_rooms) {
    std::size_t number = 0, within = 0;
    std::vector<double> errors, sigmas;
    for (const measured_room& m : of_rooms) {
        for (const compared_length& l : m.lengths) {
            if (std::ranges::find(kinds, l.kind) == kinds.end()) continue;
            ++number;
            within += std::abs(l.error) <= 3.0 * l.sigma ? 1 : 0;
            errors.push_back(std::abs(l.error));
            sigmas.push_back(l.sigma);
        }
    }
    if (number == 0) return;
    rows.push_back({{"noise [mm]", noise},
                    {"lengths", name},
                    {"number", number},
                    {"within 3 standard deviations [%]",
                     rounded(100.0 * static_cast<double>(within) / static_cast<double>(number), 1)},
                    {"median error [mm]", rounded(1e3 * median_of(errors), 2)},
                    {"largest error [mm]", rounded(1e3 * *std::ranges::max_element(errors), 1)},
                    {"median standard deviation [mm]", rounded(1e3 * median_of(sigmas), 2)}});
    std::printf("%s\n", rows.back().dump().c_str());
    std::fflush(stdout);
}

json measure(const effort& much) {
    const std::size_t rooms = much.quick ? 2 : 40;
    json lengths = json::array(), openings = json::array();
    for (const double noise : {5.0, 15.0}) {
        std::vector<measured_room> of_rooms(rooms);
        gnomon::threads{}(rooms, [&](std::size_t i) {
            of_rooms[i] = measure_room(first_seed + static_cast<std::uint64_t>(i), 1e-3 * noise);
        });
        const std::vector<std::string> planes{"between walls", "floor to ceiling"};

        add_row(lengths, noise, "all",
                {"between walls", "floor to ceiling", "along walls", "width", "height", "sill"},
                of_rooms);
        add_row(lengths, noise, "plane to plane", planes, of_rooms);
        add_row(lengths, noise, "along walls", {"along walls"}, of_rooms);
        add_row(lengths, noise, "width of openings", {"width"}, of_rooms);
        add_row(lengths, noise, "height of openings", {"height"}, of_rooms);
        add_row(lengths, noise, "height of sills", {"sill"}, of_rooms);
        std::size_t there = 0, found = 0, spurious = 0;
        for (const measured_room& m : of_rooms)
            there += m.openings, found += m.found, spurious += m.spurious;
        openings.push_back(
            {{"noise [mm]", noise}, {"openings", there}, {"found", found}, {"spurious", spurious}});
    }
    return {{"lengths of rooms", lengths}, {"openings", openings}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

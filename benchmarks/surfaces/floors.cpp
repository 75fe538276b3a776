// SPDX-License-Identifier: BSL-1.0
// The floor that the chain finds: none in scans of furniture alone, whose seats and table tops are
// level, and that of tilted rooms.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "../chapter4/record.hpp"
#include "furnished.hpp"
#include "perceived.hpp"

namespace {

constexpr double sigma = 0.015;  // of the ranges of furniture [m]

/// A piece of furniture, seen from 2 m in one of 8 directions and from one of 5 heights.
gnomon::scan view_of(const sim::furniture_model& model, std::size_t view) {
    sim::scene world;
    add(world, model);
    const double azimuth = 45.0 * static_cast<double>(view % 8);
    const double height = 0.4 + 0.4 * static_cast<double>(view / 8 % 5);
    const double middle = world.extent().middle().z();
    const double down = std::atan2(height - middle, 2.0);
    const sim::pose sensor = sim::yaw(gnomon::degrees(azimuth)) * sim::at(-2.0, 0.0, height) *
                             sim::pitch(gnomon::radians(down));
    return sim::simulate(world, sim::rotational{.mount = sensor}, {},
                         {.sigma = sigma, .seed = view + 1})
        .scan;
}

/// Views of furniture alone: those in which a floor is found.
json furniture(bool quick) {
    const std::size_t views = quick ? 2 : 40;  // of each model
    std::size_t total = 0, found = 0, fewest = std::numeric_limits<std::size_t>::max();
    json rows = json::array();
    for (const sim::furniture_model& model : sim::furniture_models()) {
        std::vector<char> has_floor(views, 0);
        std::vector<std::size_t> points(views, 0);
        gnomon::threads{}(views, [&](std::size_t v) {
            const std::size_t view = quick ? 19 * v : v;
            const gnomon::scan scan = view_of(model, view);
            points[v] = scan.size();
            has_floor[v] = perceive(scan, true, sigma).floor ? 1 : 0;
        });
        const auto wrong = static_cast<std::size_t>(std::ranges::count(has_floor, 1));
        rows.push_back({{"furniture", model.name},
                        {"fewest points", std::ranges::min(points)},
                        {"views", views},
                        {"with a floor", wrong}});
        total += views;
        found += wrong;
        fewest = std::min(fewest, std::ranges::min(points));
    }
    rows.push_back({{"furniture", "all"},
                    {"fewest points", fewest},
                    {"views", total},
                    {"with a floor", found}});
    std::printf("%s\n", rows.back().dump().c_str());
    std::fflush(stdout);
    return rows;
}

/// The floor of a tilted room against the truth.
struct floor_error {
    double angle;   // [degrees]
    double height;  // of the sensor [m]
};

/// A scan in a frame that is turned about the origin.
gnomon::scan turned(const gnomon::scan& scan, const Eigen::Matrix3d& turn) {
    gnomon::scan result;
    std::vector<Eigen::Vector3d> viewpoints;  // of the scan lines, or of the whole scan
    std::vector<gnomon::point_index> viewpoint_of_point;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector3d viewpoint = turn * scan.viewpoints[i];
        if (viewpoints.empty() || viewpoints.back() != viewpoint) viewpoints.push_back(viewpoint);
        viewpoint_of_point.push_back(static_cast<gnomon::point_index>(viewpoints.size() - 1));
        result.points.push_back(turn * scan.points[i]);
    }
    if (viewpoints.size() == 1)
        result.viewpoints = viewpoints.front();
    else
        result.viewpoints = gnomon::viewpoint_table(viewpoints, viewpoint_of_point);
    return result;
}

std::optional<floor_error> floor_error_of(const setting& how, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    const double way = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double tilt = gnomon::degrees(random.uniform(0.0, 3.0)).radians();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(way), std::sin(way), 0.0))
            .toRotationMatrix();
    const sim::scene world = furnished(seed);
    const sim::true_scan upright = scan_of(world, sim::bvh_caster(world), how, 1000 * seed + 1);
    const gnomon::scan scan = turned(upright.scan, turn);
    const auto floor = perceive(scan, true, how.sigma()).floor;
    if (!floor) return std::nullopt;
    const Eigen::Vector3d up = turn.col(2), sensor = scan.viewpoints[0];  // floor: up . x = 0
    const double sine = floor->normal.cross(up).norm();
    return floor_error{gnomon::radians(std::atan2(sine, floor->normal.dot(up))).degrees(),
                       std::abs(floor->signed_distance(sensor) - up.dot(sensor))};
}

json row_of(json row, const std::vector<std::optional<floor_error>>& rooms) {
    constexpr double most = 0.1;  // [degrees]
    std::size_t found = 0, well = 0;
    floor_error worst{0.0, 0.0};
    for (const auto& e : rooms) {
        if (!e) continue;
        ++found;
        well += e->angle <= most ? 1 : 0;
        worst = {std::max(worst.angle, e->angle), std::max(worst.height, e->height)};
    }
    row.update({{"rooms", rooms.size()},
                {"found", found},
                {"within 0.1 degrees", well},
                {"worst angle [degrees]", rounded(worst.angle, 3)},
                {"worst height [mm]", rounded(1e3 * worst.height, 1)}});
    std::printf("%s\n", row.dump().c_str());
    std::fflush(stdout);
    return row;
}

/// Furnished rooms, tilted by 0 to 3 degrees; noise and trajectory change from room to room.
json tilted_rooms(bool quick) {
    const std::size_t count = quick ? 6 : 200;
    std::vector<std::optional<floor_error>> errors(count);
    const auto noise_of = [](std::size_t room) { return noises[room % noises.size()]; };
    gnomon::threads{}(count, [&](std::size_t r) {
        const setting how{noise_of(r), "whole",
                          trajectories[r / noises.size() % trajectories.size()]};
        errors[r] = floor_error_of(how, 10'001 + r);
    });
    json rows = json::array();
    for (const double noise : noises) {
        std::vector<std::optional<floor_error>> of_noise;
        for (std::size_t r = 0; r < count; ++r)
            if (noise_of(r) == noise) of_noise.push_back(errors[r]);
        rows.push_back(row_of({{"noise [mm]", noise}}, of_noise));
    }
    rows.push_back(row_of({{"noise [mm]", "all"}}, errors));
    return rows;
}

json measure(const effort& much) {
    return {{"furniture alone", furniture(much.quick)}, {"tilted rooms", tilted_rooms(much.quick)}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

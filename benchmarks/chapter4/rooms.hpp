// SPDX-License-Identifier: BSL-1.0
/// @file
/// Random furnished rooms, scanned as the thesis scans, and their segments.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

constexpr double room_sigma = 0.015;  ///< of ranges [m]

/// A room of 4 to 12 pieces of furniture.
inline gnomon::scene room(std::uint64_t number) {
    return gnomon::scenes::furnished_room(
        {.pieces = static_cast<int>(4 + 2 * (number % 5)), .seed = number});
}

/// @param trajectory  horizontal, vertical, rotational, or moving: horizontal on an arm of 15 cm
///                    that turns, so that each scan line has a view point of its own
inline gnomon::true_scan scan_of(const gnomon::scene& world, const gnomon::bvh_caster& caster,
                                 const std::string& trajectory, std::uint64_t seed) {
    const gnomon::pose mount = world.sensor;
    const auto along = [&](const auto& way) {
        return gnomon::simulate(world, caster, way, {}, {.sigma = room_sigma, .seed = seed});
    };
    if (trajectory == "horizontal") return along(gnomon::horizontal{.mount = mount});
    if (trajectory == "vertical") return along(gnomon::vertical{.mount = mount});
    if (trajectory == "rotational") return along(gnomon::rotational{.mount = mount});
    if (trajectory != "moving") throw std::invalid_argument("no trajectory " + trajectory);
    return along(gnomon::along(4.0, [&](double seconds) {
        return mount * gnomon::yaw(gnomon::degrees(180.0 * (seconds / 4.0 - 0.5))) *
               gnomon::at(0.15, 0.0, 0.0) * gnomon::roll(gnomon::degrees(90));
    }));
}

/// A scan of a room without floor and ceiling, and its surfaces, with the thesis's parameters
/// (Sec. 4.4.1).
struct segmented_room {
    std::vector<gnomon::point_index> kept;  ///< the numbers in the scan of the points
    gnomon::segments parts;                 ///< of these points

    explicit segmented_room(const gnomon::scan& scan) {
        const auto floor = gnomon::find_floor(scan, gnomon::guess_floor(scan).value()).value();
        kept = gnomon::between_bands(scan, floor, gnomon::find_ceiling(scan, floor));
        const gnomon::subset_view points(scan, kept);
        auto surface = gnomon::estimate_normals(points, gnomon::knn{}, gnomon::plane_pca{});
        gnomon::repair_anisotropic(points, surface, gnomon::knn{}, gnomon::plane_pca{});
        gnomon::orient_normals(points, surface);
        parts = gnomon::segment_surfaces(points, surface);
    }
};

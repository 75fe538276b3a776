// SPDX-License-Identifier: BSL-1.0
/// @file
/// Two methods that find furniture in scans of rooms, learned from simulated views of single
/// objects, clutter among them as background.
#pragma once

#include <cstdint>

#include "outcomes.hpp"
#include "rooms.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/perception/find_objects.hpp>

/// That of the rays.
inline const gnomon::noise_curve noise_in_rooms = gnomon::constant_noise{room_kind{}.sigma};

/// What a finder gets: the noise of the sensor, and the width of its beams.
inline const rec::find_objects_options how_rooms_are_seen{.noise = noise_in_rooms,
                                                          .divergence = wide_beam};

/// The grouping of the thesis: points of at most 10 cm from each other are one object, Sec. 5.5.1.
[[nodiscard]] room_method thesis_grouping(const effort& much, std::uint64_t seed);

/// A finder that has learned furniture_models() and clutter.
[[nodiscard]] rec::object_finder finder_of(const effort& much, std::uint64_t seed);

/// What it finds in a scan of a room.
[[nodiscard]] rec::found_objects objects_in(const gnomon::scan& scan,
                                            const rec::object_finder& finder,
                                            const gnomon::threads& run);

/// Votes of parts, alignment, verification and competition. Refers to the finder.
[[nodiscard]] room_method voting(const rec::object_finder& finder);

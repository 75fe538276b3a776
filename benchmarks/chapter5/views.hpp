// SPDX-License-Identifier: BSL-1.0
/// @file
/// The protocol of this chapter: simulated views of single objects (Klasing 2010, Sec. 5.6), to
/// learn and to test, and how they are perceived.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/simulation/furniture.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

/// The seeds of this page are from this one on. All that is adjustable was chosen on others.
inline constexpr std::uint64_t first_seed = 5001;

/// What a set of views is for: the numbers enter their seeds, so that no two sets are alike.
enum class purpose : std::uint64_t { learning, test };

/// Above the origin, where sensors of views stand [m].
inline constexpr double sensor_height = 1.2;

/// The full angle of a beam that skims: 10 mrad.
inline constexpr gnomon::angle wide_beam = gnomon::radians(0.010);

/// How views are scanned.
struct view_kind {
    double duration = 8.0;        ///< t_s [s]
    double sigma = 0.005;         ///< of the noise along the rays [m]
    double occluded_share = 0.0;  ///< of the points, hidden by a board
    bool skims = false;           ///< whether the beam is wide, and averages
    double farthest = 5.5;        ///< ahead of the sensor [m]
};

/// Scans of single objects, without the board that hides a part.
struct scan_set {
    std::vector<gnomon::scan> scans;
    std::vector<std::uint32_t> classes;           ///< of each scan: the number of its model
    std::vector<std::vector<std::string>> parts;  ///< of each point of each scan, its true part
    std::size_t versions = 1;  ///< this number of consecutive scans shows one view
    double sigma = 0.005;
    /// Of the beams, as perceive_views gets it; 0 if it does not.
    gnomon::angle divergence = gnomon::radians(0.0);
};

/// The views of all models, model by model.
[[nodiscard]] scan_set scans_of(const std::vector<sim::furniture_model>& models, std::size_t views,
                                const view_kind& kind, std::uint64_t seed, purpose use);

/// Each scan, followed by two versions of it of which a part is hidden.
[[nodiscard]] scan_set with_hidden_parts(const scan_set& scans, std::uint64_t seed);

/// The chain of the thesis: neighbors of a point, and the least number of points of a segment.
struct density {
    std::size_t k, min_points;
};
inline constexpr density thesis_density{50, 30};
/// With the repairs of the thesis's method; chosen on seed 1, as these were.
inline constexpr density repaired_density{50, 15};

/// What was seen in a set of scans.
struct view_set {
    std::vector<rec::view> views;
    std::vector<std::uint32_t> classes;
    std::vector<std::vector<std::string>> parts;  ///< of each part of each view, its true name
    std::size_t versions = 1;
};

/// The least cells of a view of `perceive_views`.
inline constexpr std::size_t fewest_cells = 10;

/// The view of a scan of one object on the plane z = 0; without parts if there are hardly points.
/// @param thesis  its chain; else views are those of `perceive_views`, as learn_objects learns them
[[nodiscard]] rec::view view_of(const gnomon::scan& scan, double sigma,
                                const std::optional<density>& thesis = std::nullopt);

/// The views of all scans.
[[nodiscard]] view_set views_of(const scan_set& scans,
                                const std::optional<density>& thesis = std::nullopt);

/// The time of a clock [s].
[[nodiscard]] inline double clock_time(clockid_t of) {
    std::timespec t{};
    clock_gettime(of, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The time of the processor [s]: of this thread, or of all threads.
[[nodiscard]] inline double processor_time(clockid_t of = CLOCK_THREAD_CPUTIME_ID) {
    return clock_time(of);
}

/// The time that passes [s].
[[nodiscard]] inline double wall_time() { return clock_time(CLOCK_MONOTONIC); }

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The default chain as rooms.cpp, cameras.cpp and floors.cpp call it. Of the result of an older
/// version they use only `initial_segments`, `surfaces`, `kept` and `floor`.
///
/// For a comparison, rooms.cpp also compiles with older versions of the library, which require
/// the noise as a parameter; see older_library.hpp.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

#ifndef GNOMON_SIGMA_TOLD

/// @param leave_out_floor  floor and ceiling are found, and left out
inline gnomon::perception_result<gnomon::plane_fit> perceive(const gnomon::scan& scan,
                                                             bool leave_out_floor,
                                                             double /*true_sigma*/ = 0.0) {
    gnomon::perception<> chain;
    if (leave_out_floor) chain.leave_out = gnomon::floor_and_ceiling{};
    return chain(scan);
}

#else

/// The result of a version whose initial segments may have another name.
template <class Result>
struct older_result {
    gnomon::segments initial_segments, surfaces;
    std::vector<gnomon::point_index> kept;
    std::optional<gnomon::plane> floor;

    explicit older_result(Result r)
        : surfaces(std::move(r.surfaces)), kept(std::move(r.kept)), floor(r.floor) {
        if constexpr (requires { r.fragments; })
            initial_segments = std::move(r.fragments);
        else
            initial_segments = std::move(r.initial_segments);
    }
};

/// @param true_sigma  standard deviation of the ranges [m]
inline auto perceive(const gnomon::scan& scan, bool leave_out_floor, double true_sigma) {
    gnomon::perception<> chain = gnomon::perception<>{}.with_sigma(true_sigma);
    if (leave_out_floor) chain.leave_out = gnomon::floor_and_ceiling{};
    return older_result(chain(scan));
}

#endif

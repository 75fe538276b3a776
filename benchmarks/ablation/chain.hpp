// SPDX-License-Identifier: BSL-1.0
/// @file
/// The default chain as a library that score.cpp loads. measure.py compiles it once for each
/// variant of gnomon, while the ground truth and the scores are computed by gnomon as it is.
#pragma once

#include <cstdint>
#include <vector>

#include <gnomon/core/point.hpp>
#include <gnomon/core/scan.hpp>

/// The steps that need no other library to be left out, and the noise.
struct chain_options {
    bool leaves_out_floor = false;  ///< and the ceiling
    bool closes_narrow_gaps = true;
    double noise = 0.0;  ///< standard deviation of the ranges [m]; 0 to measure it
};

struct chain_result {
    std::vector<gnomon::point_index> kept;
    std::vector<std::int32_t> initial, merged;  ///< labels of all points, before and after merging
};

extern "C" void perceive(const gnomon::scan& scan, const chain_options& options,
                         chain_result& result);

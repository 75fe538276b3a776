// SPDX-License-Identifier: BSL-1.0
/// @file
/// The clouds of little noise, of Fig. 3.6 and Table 3.3: a surrogate of the thesis's scan of two
/// boxes and a bin at two levels of noise and, where its file is, a real scan by the same kind of
/// scanner.
#pragma once

#include <string>
#include <vector>

#include "measure.hpp"

inline std::vector<cloud_condition> clouds_of_little_noise(const effort& much) {
    std::vector<cloud_condition> clouds;
    for (const int sigma_mm : {1, 2}) {
        const double sigma = 1e-3 * sigma_mm;
        clouds.push_back({.name = "cloud:surrogate/sigma_mm:" + std::to_string(sigma_mm),
                          .sigma = sigma,
                          .seeds = much.seeds(),
                          .make = scenario_two(sigma)});
    }
    if (const auto real = real_table()) clouds.push_back({.name = "cloud:real", .make = *real});
    return clouds;
}

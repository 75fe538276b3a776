// SPDX-License-Identifier: BSL-1.0
#include "chain.hpp"

#include <gnomon/perception.hpp>

extern "C" __attribute__((visibility("default"))) void perceive(const gnomon::scan& scan,
                                                                const chain_options& options,
                                                                chain_result& result) {
    gnomon::perception<> chain;
    if (options.leaves_out_floor) chain.leave_out = gnomon::floor_and_ceiling{};
    if (!options.closes_narrow_gaps) chain.merging.max_gap = 0.0;
    if (options.noise > 0.0) chain.noise = gnomon::constant_noise{options.noise};
    const auto seen = chain(scan);
    result = {seen.kept, seen.initial_segments.labels(), seen.surfaces.labels()};
}

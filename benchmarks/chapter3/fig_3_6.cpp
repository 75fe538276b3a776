// SPDX-License-Identifier: BSL-1.0
// Fig. 3.6: seven methods over k where there is little noise.
#include <algorithm>

#include "little_noise.hpp"

void enter_benchmarks(const effort& much) {
    for (const cloud_condition& cloud : clouds_of_little_noise(much)) {
        const bool large = cloud.seeds == 1;  // the real one: a third of the passes will do
        for (const std::size_t k :
             much.of<std::size_t>({10, 15, 20, 25, 30, 35, 40, 45, 50}, {10, 20, 30, 50})) {
            enter("fig_3_6", cloud, knn_graph(k), thesis_methods(),
                  large ? std::min(much.passes(), 5) : much.passes());
        }
    }
}

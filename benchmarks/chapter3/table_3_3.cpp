// SPDX-License-Identifier: BSL-1.0
// Table 3.3: five methods on Delaunay stars where there is little noise.
#include "little_noise.hpp"

void enter_benchmarks(const effort& much) {
    const auto five =
        methods({"plane_svd", "plane_pca", "vector_svd", "area_weighted", "angle_weighted"});
    for (const cloud_condition& cloud : clouds_of_little_noise(much))
        enter("table_3_3", cloud, delaunay_graph(), five, much.passes());
}

// SPDX-License-Identifier: BSL-1.0
#include "shared.hpp"

layout layout_there() { return layout_of_crossing_types(); }

gnomon::scan scan_made_there() {
    gnomon::scan scan;
    for (int i = 0; i < 100; ++i) scan.points.emplace_back(i % 10, i / 10, 0.5 * i);
    return scan;
}

gnomon::moments moments_made_there(gnomon::scan scan) {
    gnomon::moments sums;
    for (const auto& point : scan) sums.add(point);
    return sums;
}

gnomon::adjacency neighbors_found_there(const gnomon::scan& scan) {
    return gnomon::knn{.k = 12}(scan);
}

std::vector<gnomon::surfel<gnomon::plane_fit>> normals_found_there(const gnomon::scan& scan) {
    return gnomon::estimate_normals(scan, gnomon::knn{.k = 12}, gnomon::plane_pca{});
}

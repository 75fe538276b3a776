// SPDX-License-Identifier: BSL-1.0
#include "shared.hpp"

/// The two translation units are compiled for different instruction sets; inline functions that
/// both contain are linked once.
bool find_the_same(const gnomon::scan& scan) {
    const auto neighbors = gnomon::knn{.k = 12}(scan);
    const auto normals = gnomon::estimate_normals(scan, gnomon::knn{.k = 12}, gnomon::plane_pca{});
    const auto normals_there = normals_found_there(scan);
    bool same = neighbors == neighbors_found_there(scan) && smallest_of_eight() < 1e-15;
    for (std::size_t i = 0; i < scan.size(); ++i)
        same = same && normals[i].normal.isApprox(normals_there[i].normal, 1e-12);
    return same;
}

int main() {
    auto scan = scan_made_there();
    scan.points.push_back(gnomon::position(std::array{1.0, 2.0, 3.0}));

    gnomon::moments here;
    for (const auto& point : scan) here.add(point);
    const gnomon::moments there = moments_made_there(scan);

    const bool agree =
        layout_of_crossing_types() == layout_there() && here.count == there.count &&
        here.sum == there.sum && here.outer.isApprox(there.outer, 1e-12) &&
        gnomon::detail::symmetric_eigen(there.covariance_of_neighbors()).values[0] >= 0 &&
        find_the_same(scan);
    return agree ? 0 : 1;
}

// SPDX-License-Identifier: BSL-1.0
#include "shared.hpp"

int main() {
    auto scan = scan_made_there();
    scan.points.push_back(gnomon::position(std::array{1.0, 2.0, 3.0}));

    gnomon::moments here;
    for (const auto& point : scan) here.add(point);
    const gnomon::moments there = moments_made_there(scan);

    const bool agree = layout_of_crossing_types() == layout_there() && here.count == there.count &&
                       here.sum == there.sum && here.outer.isApprox(there.outer, 1e-12) &&
                       gnomon::symmetric_eigen(there.covariance_of_neighbors()).values[0] >= 0;
    return agree ? 0 : 1;
}

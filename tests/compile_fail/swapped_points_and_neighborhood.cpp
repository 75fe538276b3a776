// SPDX-License-Identifier: BSL-1.0
// expect first: the points come before the neighborhood
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    (void)gnomon::estimate_normals(gnomon::knn{.k = 20}, points);
}

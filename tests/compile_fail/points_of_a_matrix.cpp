// SPDX-License-Identifier: BSL-1.0
// expect first: columns\(matrix\)
// A matrix has columns or rows, which are points.
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

int main() {
    const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 10);
    (void)gnomon::estimate_normals(points, gnomon::knn{.k = 20}, gnomon::plane_pca{});
}

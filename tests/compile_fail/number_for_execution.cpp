// SPDX-License-Identifier: BSL-1.0
// expect first: write gnomon::threads\{4\}
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    (void)gnomon::estimate_normals(points, gnomon::knn{.k = 20}, gnomon::plane_pca{}, 4);
}

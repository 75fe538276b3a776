// SPDX-License-Identifier: BSL-1.0
// expect first: the neighborhood comes before the estimator
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    const auto surface =
        gnomon::estimate_normals(points, gnomon::plane_pca{}, gnomon::knn{.k = 20});
    return surface[0].surface_variation() > 0.0;
}

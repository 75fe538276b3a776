// SPDX-License-Identifier: BSL-1.0
// expect first: knn\{\.k = 20\}
// As in libraries whose neighborhood is always the k nearest.
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    const auto surface = gnomon::estimate_normals(points, 20, gnomon::plane_pca{});
    return surface[0].surface_variation() > 0.0;
}

// SPDX-License-Identifier: BSL-1.0
// expect first: the points come before the graph
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    const gnomon::adjacency graph = gnomon::knn{.k = 20}(points);
    const auto surface = gnomon::estimate_normals(graph, points, gnomon::plane_pca{});
    return surface[0].surface_variation() > 0.0;
}

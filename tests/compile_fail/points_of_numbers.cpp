// SPDX-License-Identifier: BSL-1.0
// expect first: strided_view
// A flat buffer x, y, z, x, y, z, ...
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

int main() {
    const std::vector<float> points(30);
    const auto surface =
        gnomon::estimate_normals(points, gnomon::knn{.k = 20}, gnomon::plane_pca{});
    return surface[0].surface_variation() > 0.0;
}

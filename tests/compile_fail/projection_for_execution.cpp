// SPDX-License-Identifier: BSL-1.0
// expect first: the execution comes before the projection
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

struct hit {
    Eigen::Vector3f position;
};

int main() {
    const std::vector<hit> hits(10);
    (void)gnomon::estimate_normals(hits, gnomon::knn{.k = 20}, gnomon::plane_pca{}, &hit::position);
}

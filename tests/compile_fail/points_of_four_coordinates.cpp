// SPDX-License-Identifier: BSL-1.0
// expect first: pass as projection .*head<3>
// Homogeneous coordinates: PCL and ROS keep points in four floats.
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

int main() {
    const std::vector<Eigen::Vector4f> points(10);
    const auto surface =
        gnomon::estimate_normals(points, gnomon::knn{.k = 20}, gnomon::plane_pca{});
    return surface[0].surface_variation() > 0.0;
}

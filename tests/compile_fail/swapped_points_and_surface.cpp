// SPDX-License-Identifier: BSL-1.0
// expect first: the points come before the surface
#include <vector>

#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/orient.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    std::vector<gnomon::normal_fit> surface(10);
    gnomon::orient_normals(surface, points);
}

// SPDX-License-Identifier: BSL-1.0
// expect: \A(?![\s\S]*neighborhood_graph)[\s\S]*deleted function[\s\S]*\bnot_an_estimator\b
// The message must name what is wrong, the estimator, and not what is right, the neighborhood.
#include <vector>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    const auto forgot_the_neighborhood = [](const Eigen::Vector3d& p) { return p; };
    (void)gnomon::estimate_normals(points, gnomon::knn{}, forgot_the_neighborhood);
}

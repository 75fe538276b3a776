// SPDX-License-Identifier: BSL-1.0
// expect first: the result is of another estimator
#include <vector>

#include <gnomon/perception.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    gnomon::perception_result<gnomon::normal_fit> result;
    gnomon::perception<>{}.into(result, points);
}

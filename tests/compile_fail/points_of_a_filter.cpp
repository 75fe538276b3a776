// SPDX-License-Identifier: BSL-1.0
// expect first: a range of points needs access by index
#include <ranges>
#include <vector>

#include <gnomon/normals/estimate_normals.hpp>

int main() {
    const std::vector<Eigen::Vector3d> points(10);
    const auto near = [](const Eigen::Vector3d& p) { return p.norm() < 1.0; };
    (void)gnomon::estimate_normals(points | std::views::filter(near));
}

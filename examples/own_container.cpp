// SPDX-License-Identifier: BSL-1.0
// How do I use points that lie in my own container, without copying them?
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <deque>
#include <vector>

#include <Eigen/Core>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

// Your own struct: a projection to its member makes it a point.
struct laser_return {
    double time;
    Eigen::Vector3f xyz;
    float intensity;
};

// A point as PCL and ROS have it: members x, y, z are all it takes.
struct point_xyzi {
    float x, y, z;
    float intensity;
};

// [own_point]
// Any other type: specialize point_traits once.
struct spherical {
    double range, azimuth, elevation;
};

template <>
struct gnomon::point_traits<spherical> {
    using scalar = double;
    static Eigen::Vector3d coordinates(const spherical& p) {
        return {p.range * std::cos(p.elevation) * std::cos(p.azimuth),
                p.range * std::cos(p.elevation) * std::sin(p.azimuth),
                p.range * std::sin(p.elevation)};
    }
};
// [own_point]

namespace {

const gnomon::knn neighbors{.k = 30};
const gnomon::plane_pca plane;

void report(const char* what, const auto& surface, const std::vector<Eigen::Vector3d>& truth) {
    std::printf("%-40s gamma %.6f\n", what, gnomon::mean_gamma(surface, truth));
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Takes points from containers of its own, without copies."))
        return 0;
    const gnomon::simulation::true_scan truth =
        gnomon::simulation::simulate(gnomon::simulation::box_and_cylinder{});
    const gnomon::scan& scan = truth.scan;

    std::deque<laser_return> returns;
    std::vector<point_xyzi> cloud;
    std::vector<spherical> polar;
    Eigen::Matrix<float, 3, Eigen::Dynamic> matrix(3, scan.size());
    std::vector<std::byte> message(16 * scan.size());  // x, y, z and four other bytes
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector3f p = scan.points[i].cast<float>();
        returns.push_back({0.0, p, 1.0f});
        cloud.push_back({p.x(), p.y(), p.z(), 1.0f});
        const Eigen::Vector3d q = p.cast<double>();
        polar.push_back({q.norm(), std::atan2(q.y(), q.x()), std::asin(q.z() / q.norm())});
        matrix.col(static_cast<Eigen::Index>(i)) = p;
        std::memcpy(&message[16 * i], p.data(), 12);
    }

    // [own_container]
    auto a = gnomon::estimate_normals(returns, neighbors, plane, gnomon::threads{},
                                      &laser_return::xyz);  // a projection
    auto b = gnomon::estimate_normals(cloud, neighbors, plane);
    auto c = gnomon::estimate_normals(polar, neighbors, plane);
    auto d = gnomon::estimate_normals(gnomon::columns(matrix), neighbors, plane);

    const gnomon::strided_view<float> points(message.data(), cloud.size(), 16, {0, 4, 8});
    auto e = gnomon::estimate_normals(points, neighbors, plane);
    // [own_container]

    report("a deque of structs, through a member", a, truth.normals);
    report("structs with x, y, z", b, truth.normals);
    report("spherical points, through point_traits", c, truth.normals);
    report("the columns of a matrix", d, truth.normals);
    report("bytes with a stride (a message)", e, truth.normals);
}

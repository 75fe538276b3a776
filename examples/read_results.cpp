// SPDX-License-Identifier: BSL-1.0
// How do I read a normal, its covariance and the coefficients of a plane?
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "common/help.hpp"
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

int main(int argc, char** argv) {
    if (printed_help(
            argc, argv,
            "Prints normals, covariances and the coefficients of planes of a simulated scan."))
        return 0;
    const gnomon::scan scan = sim::simulate(sim::box_and_cylinder{.sigma = 0.003}).scan;
    const gnomon::adjacency graph = gnomon::knn{.k = 30}(scan);

    // [read_normal]
    auto surface = gnomon::estimate_normals(scan, graph, gnomon::plane_pca{});
    gnomon::orient_normals(scan, surface);  // towards the view point
    std::size_t without = 0;
    Eigen::Vector3d sum(0.0, 0.0, 0.0);
    for (const auto& s : surface) {
        if (gnomon::usable(s.trust)) {
            sum += s.normal;  // unit length
        } else {
            ++without;  // s.normal is zero; to_string(s.trust) names the reason
        }
    }
    // [read_normal]
    const Eigen::Vector3d mean = sum / static_cast<double>(surface.size() - without);
    std::printf("the mean normal is (%.2f, %.2f, %.2f); %zu points have none\n", mean.x(), mean.y(),
                mean.z(), without);

    // [read_covariance]
    const auto believed = gnomon::estimate_normals(
        scan, graph, gnomon::plane_eif{.noise = gnomon::constant_noise{0.003}});
    const Eigen::Matrix3d& c = believed[0].covariance;  // [rad^2]; zero along the normal
    const double deviation = std::sqrt(0.5 * believed[0].trace());  // in one direction [rad]
    // [read_covariance]
    std::printf("the first normal: variance of x %.1e, deviation %.2f degrees\n", c(0, 0),
                gnomon::radians(deviation).degrees());

    // [read_plane]
    const gnomon::noise_curve noise = gnomon::constant_noise{0.003};  // or measure_noise(scan)
    const gnomon::segments flat = gnomon::segment_planes(scan, graph, surface, {.noise = noise});
    for (const gnomon::plane_estimate& e : gnomon::estimate_planes(scan, flat, noise)) {
        // normal . x = offset; in the form a x + b y + c z + d = 0 of PCL, d is -offset.
        const gnomon::plane& p = e.plane;
        const std::array coefficients{p.normal.x(), p.normal.y(), p.normal.z(), -p.offset};
        const gnomon::angle tilt = gnomon::radians(std::sqrt(e.covariance(0, 0)));  // about axis 0
        std::printf("%.3f x + %.3f y + %.3f z + %.3f = 0, tilt within %.3f degrees\n",
                    coefficients[0], coefficients[1], coefficients[2], coefficients[3],
                    3.0 * tilt.degrees());  // three standard deviations
    }
    // [read_plane]

    // [size_of_plane]
    // #include <gnomon/features/minimum_area_rectangle.hpp>
    const auto estimates = gnomon::estimate_planes(scan, flat, noise);
    for (std::size_t i = 0; i < flat.size(); ++i) {
        const gnomon::subset_view part(scan, flat[i]);
        const auto outline = gnomon::convex_polygon::of(part, estimates[i].plane);
        const auto lengths = gnomon::minimum_area_rectangle(outline).lengths;
        std::printf("%.2f m x %.2f m, within an outline of %.2f m^2\n", lengths[0], lengths[1],
                    outline.area);
    }
    // [size_of_plane]

    // [plane_of_segment]
    const gnomon::segments parts = gnomon::segment_surfaces(scan, surface);
    std::vector<gnomon::plane> planes;  // one for each segment, where it is flat
    for (const gnomon::plane_estimate& e : gnomon::estimate_planes(scan, parts, noise))
        if (e.is_flat) planes.push_back(e.plane);
    // [plane_of_segment]
    std::printf("%zu of %zu smooth surfaces are flat\n", planes.size(), parts.size());
}

// SPDX-License-Identifier: BSL-1.0
// How do I estimate the normals of a spinning lidar, whose scan lines are far apart? A sweep of a
// lidar of 32 beams in a simulated street, with 2 cm of noise that nothing here knows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// Prints the errors of the normals of the road, from which cars and kerbs are not far.
/// @return their median [degrees]
double report(const char* method, const sim::scene& street, const sim::true_scan& truth,
              const auto& surface) {
    std::vector<double> errors;
    double squares = 0.0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
        if (truth.surfaces[i] == sim::nothing || !gnomon::usable(surface[i].trust)) continue;
        if (!street.surface_name(truth.surfaces[i]).starts_with("road/")) continue;
        errors.push_back(gnomon::unoriented_angle(surface[i].normal, truth.normals[i]).degrees());
        squares += errors.back() * errors.back();
    }
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    std::printf("%-26s median %5.2f, root mean square %5.2f degrees\n", method, *middle,
                std::sqrt(squares / static_cast<double>(errors.size())));
    return *middle;
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Estimates normals of a simulated sweep of a spinning lidar."))
        return 0;
    const sim::scene street = sim::scenes::street({.seed = 1});
    const sim::spinning_lidar lidar = sim::scanners::velodyne_hdl_32e();
    const sim::true_scan truth = sim::simulate(
        street,
        sim::driving{
            .mount = street.sensor, .duration = lidar.revolution(), .velocity = {0.0, 0.0, 0.0}},
        lidar, {.sigma = 0.02, .seed = 1});
    const gnomon::scan& scan = truth.scan;
    report("plane_pca on knn", street, truth, gnomon::estimate_normals(scan));

    // [lidar_normals]
    const gnomon::spatial_index index(scan);
    const gnomon::measured_noise measured = gnomon::measure_noise(index);
    if (!measured.curve) return 1;  // too little is flat; measured.reason
    const gnomon::noise_curve noise = *measured.curve;
    const auto surface = gnomon::estimate_normals(index, gnomon::ray_knn{.k = 30, .noise = noise},
                                                  gnomon::robust_ray_ls{.noise = noise});
    // [lidar_normals]
    const double error = report("robust_ray_ls on ray_knn", street, truth, surface);

    // [wanted_precision]
    // From k = 16 on, doubled where the normal is not certain to 1.5 degrees.
    const auto grown = gnomon::estimate_normals(index, gnomon::ray_knn{.k = 16, .noise = noise},
                                                gnomon::robust_ray_ls{.noise = noise},
                                                gnomon::wanted_precision{gnomon::degrees(1.5)});
    // [wanted_precision]
    report("the same, of 1.5 degrees", street, truth, grown);
    return error < 1.0 ? 0 : 1;
}

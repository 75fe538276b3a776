// SPDX-License-Identifier: BSL-1.0
// [quick_start]
#include <cstddef>
#include <cstdio>
#include <exception>
#include <string_view>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

int main(int argc, char** argv) try {
    if (argc > 1 && std::string_view(argv[1]) == "--help") {
        std::puts("usage: quick_start [SCAN]");
        return 0;
    }
    gnomon::scan scan;  // or any range of points of your own [m]
    if (argc > 1) {
        scan = gnomon::io::read(argv[1]);  // .ply, .pcd, .vtk, text
    } else {                               // two walls of 1 m x 1 m that meet in a corner
        for (int i = 0; i < 100; ++i) {
            for (int j = 0; j < 100; ++j) {
                scan.points.emplace_back(2.0, 0.01 * i, 0.01 * j);
                scan.points.emplace_back(1.99 - 0.01 * i, 1.0, 0.01 * j);
            }
        }
    }

    // Measures the noise of the sensor, from which the thresholds for planes follow.
    const auto seen = gnomon::perception<>{}(scan);
    for (std::size_t label = 0; label < seen.surfaces.size(); ++label) {
        const gnomon::plane_estimate& e = seen.planes[label];
        const Eigen::Vector3d& n = e.plane.normal;  // unit length
        std::printf("surface %zu: %zu points, %zu on its plane, normal (%.2f, %.2f, %.2f)\n", label,
                    seen.surfaces[label].size(), e.points, n.x(), n.y(), n.z());
    }
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
// [quick_start]

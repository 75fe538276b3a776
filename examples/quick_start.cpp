// SPDX-License-Identifier: BSL-1.0
// [quick_start]
#include <cstddef>
#include <cstdio>
#include <exception>

#include <gnomon/gnomon.hpp>

int main(int argc, char** argv) try {
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

    auto surface = gnomon::estimate_normals(scan);  // by the plane of the 30 nearest neighbors
    gnomon::orient_normals(scan, surface);          // towards the sensor

    const gnomon::segments parts = gnomon::segment_surfaces(
        scan, surface, {.max_angle = gnomon::degrees(5), .min_points = 200});  // smooth surfaces
    for (std::size_t label = 0; label < parts.size(); ++label) {
        const Eigen::Vector3d& n = surface[parts[label].front()].normal;
        std::printf("surface %zu: %zu points, the first normal is (%.2f, %.2f, %.2f)\n", label,
                    parts[label].size(), n.x(), n.y(), n.z());
    }
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
// [quick_start]

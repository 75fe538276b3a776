// SPDX-License-Identifier: BSL-1.0
// How do I find the surfaces of an organized image, such as the PCD files of a depth camera,
// without a tree?
//     organized_image [FRAME.pcd]
#include <cstddef>
#include <cstdio>
#include <exception>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/segmentation/segment_image.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

int main(int argc, char** argv) try {
    if (printed_help(argc, argv,
                     "Finds the surfaces of an organized image without a tree; without FRAME.pcd, "
                     "of a simulated scan.",
                     " [FRAME.pcd]"))
        return 0;
    gnomon::scan scan;
    if (argc > 1) {
        scan = gnomon::io::read(argv[1]);  // with the width of the image
    } else {
        const sim::scene kitchen = sim::scenes::kitchen();
        scan = sim::simulate(kitchen, sim::vertical{.mount = kitchen.sensor}).scan;
        scan.width = sim::scanner().beams();
    }

    // [organized_image]
    // #include <gnomon/segmentation/segment_image.hpp>
    // The noise is that of the first Kinect, a function of the depth along the optical axis z. For
    // points without a width: {.width = 640, ...}.
    const gnomon::raster pixels{
        .noise = {gnomon::noises::structured_light(), Eigen::Vector3d(0.0, 0.0, 1.0)}};
    const gnomon::team threads;
    const auto surface = gnomon::estimate_normals(scan, pixels, gnomon::plane_pca{}, threads);
    const auto parts = gnomon::segment_surfaces(scan, pixels, surface, {}, threads);
    // [organized_image]

    for (std::size_t label = 0; label < parts.size() && label < 10; ++label) {
        const Eigen::Vector3d& n = surface[parts[label].front()].normal;
        std::printf("surface %zu: %zu points, normal there (%.2f, %.2f, %.2f)\n", label,
                    parts[label].size(), n.x(), n.y(), n.z());
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}

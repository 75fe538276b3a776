// SPDX-License-Identifier: BSL-1.0
// How do I get from a scan to its surfaces?
#include <cstdio>
#include <exception>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

int main(int argc, char** argv) try {
    // [quick_start]
    const gnomon::scan scan = argc > 1 ? gnomon::io::read(argv[1])  // .ply, .pcd, .vtk, text
                                       : gnomon::simulate(gnomon::box_and_cylinder{}).scan;

    const gnomon::knn nearest{.k = 50};
    auto surface = gnomon::estimate_normals(scan, nearest, gnomon::plane_pca{}, gnomon::threads{});
    gnomon::orient_normals(scan, surface);  // towards where each point was seen from

    const gnomon::segments parts =
        gnomon::segment_surfaces(scan, surface, {.max_angle = gnomon::degrees(5)});

    for (std::size_t label = 0; label < parts.size(); ++label) {
        std::printf("surface %zu: %zu points\n", label, parts[label].size());
    }
    // [quick_start]
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "quick_start: %s\n", e.what());
    return 1;
}

// SPDX-License-Identifier: BSL-1.0
// How do I write what I wrote with PCL, Open3D or CGAL? The left sides are in docs/coming-from.md.
//     coming_from [SCAN]
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include "common/help.hpp"
#include <gnomon/features/describe_points.hpp>
#include <gnomon/features/shape_context.hpp>
#include <gnomon/filters.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace {

/// A room with furniture, as a file.
const char* simulated_room() {
    namespace sim = gnomon::simulation;
    const sim::scene room = sim::scenes::furnished_room({.seed = 4});
    const sim::true_scan seen =
        sim::simulate(room, sim::vertical{.mount = room.sensor}, {}, {.sigma = 0.005});
    gnomon::io::write_ply("room.ply", seen.scan);
    return "room.ply";
}

}  // namespace

int main(int argc, char** argv) try {
    if (printed_help(argc, argv,
                     "Runs the counterparts of code of PCL, Open3D and CGAL on a scan (PLY, PCD, "
                     "VTK or text); without SCAN, a simulated room.",
                     " [SCAN]"))
        return 0;
    const char* const file = argc > 1 ? argv[1] : simulated_room();

    // [read]
    const gnomon::scan scan = gnomon::io::read(file);  // PLY, PCD, VTK or text
    // [read]

    // [outliers]
    const gnomon::scan clean = gnomon::subset(
        scan, gnomon::remove_outliers(scan, gnomon::statistical_outliers{.k = 20, .factor = 2.0}));
    // [outliers]

    // [voxels]
    const auto thin = gnomon::average_voxels(clean, {.edge = 0.02});  // a range of points
    // [voxels]

    // [normals]
    auto surface = gnomon::estimate_normals(clean, gnomon::knn{.k = 30}, gnomon::plane_pca{},
                                            gnomon::threads{});
    gnomon::orient_normals(clean, surface);  // towards the view point of the file
    // [normals]

    // [largest_plane]
    const gnomon::noise_curve noise = gnomon::constant_noise{0.005};
    const gnomon::adjacency graph = gnomon::knn{.k = 20}(clean);
    const gnomon::segments flat = gnomon::segment_planes(clean, graph, surface, {.noise = noise});
    const auto planes = gnomon::estimate_planes(clean, flat, noise);
    const gnomon::plane largest = planes.at(0).plane;  // normal . x = offset
    const auto inliers = flat[0];                      // indices of its points
    // [largest_plane]

    // [clusters]
    const gnomon::segments groups =
        gnomon::euclidean_clusters(clean, {.radius = 0.05, .min_points = 100});
    // [clusters]

    // [descriptors]
    const gnomon::spatial_index index(clean);
    const gnomon::point_descriptors shapes =
        gnomon::describe_points(index, surface, gnomon::shape_context{.radius = 0.1});
    // [descriptors]

    // [write]
    using namespace gnomon::io;
    write_ply("out.ply", clean,
              {normal_properties(surface), scalar_property("label", groups.labels())});
    // [write]

    std::printf(
        "%zu points, %zu voxels, %zu planes, the largest of %zu points at %.2f m, %zu groups\n",
        clean.size(), thin.size(), flat.size(), inliers.size(), largest.offset, groups.size());
    std::printf("%zu descriptors\n", shapes.size());
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "coming_from: %s\n", e.what());
    return 1;
}

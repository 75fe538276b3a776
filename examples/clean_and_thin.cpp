// SPDX-License-Identifier: BSL-1.0
// How do I crop a scan, remove its outliers and thin it, without losing view points, colors and the
// other properties of its file?
//     clean_and_thin [SCAN]
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include <Eigen/Core>

#include "common/help.hpp"
#include <gnomon/filters.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/io/read_las.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// A kitchen with some false returns, and an intensity for each point.
gnomon::scan dirty_kitchen() {
    const sim::scene kitchen = sim::scenes::kitchen();
    auto scan =
        sim::simulate(kitchen, sim::vertical{.mount = kitchen.sensor}, {}, {.sigma = 0.005}).scan;
    gnomon::random_stream random(1);
    for (std::size_t i = 0; i < scan.size(); i += 500) scan.points[i] *= random.uniform(0.1, 0.9);
    scan.fields = {{"intensity", {}, gnomon::scan::field_type::uint8}};
    for (const Eigen::Vector3d& p : scan.points)
        scan.fields[0].values.push_back(gnomon::is_finite(p) ? 10.0 + static_cast<int>(p.norm())
                                                             : 0.0);
    return scan;
}

}  // namespace

int main(int argc, char** argv) try {
    if (printed_help(argc, argv,
                     "Crops a scan (PLY, PCD, LAS, VTK or text), removes its outliers and thins "
                     "it; without SCAN, a simulated kitchen.",
                     " [SCAN]"))
        return 0;
    // [clean_and_thin]
    // "*": with all properties of the file, such as colors and intensities.
    gnomon::scan scan = argc > 1 ? gnomon::io::read(argv[1], {"*"}) : dirty_kitchen();

    const Eigen::Vector3d reach(5.0, 5.0, 5.0);  // [m]
    scan = gnomon::subset(scan, gnomon::crop_box(scan, -reach, reach));
    const auto kept =
        gnomon::remove_outliers(scan, gnomon::statistical_outliers{.k = 20, .factor = 2.0});
    const gnomon::scan clean = gnomon::subset(scan, kept);  // with view points and properties
    const auto outliers = gnomon::complement(kept, scan.size());

    // A measured point for each cube of 2 cm, as small a file as you like:
    using namespace gnomon::io;
    const gnomon::scan thin = gnomon::subset(clean, gnomon::thin_voxels(clean, {.edge = 0.02}));
    write_ply("thin.ply", thin, field_properties(thin));

    // Or the means of the cubes, and what is found for them given to all points:
    const auto means = gnomon::average_voxels(clean, {.edge = 0.02});
    const auto of_means = gnomon::estimate_normals(means, gnomon::knn{}, gnomon::plane_pca{});
    std::vector<Eigen::Vector3d> normals;
    for (const gnomon::point_index cell : means.of_point) normals.push_back(of_means[cell].normal);
    const properties columns = normal_properties(normals);
    write_ply("clean.ply", clean, {columns, field_properties(clean, columns)});
    // [clean_and_thin]

    std::printf("%zu outliers, %zu points left, %zu after thinning\n", outliers.size(),
                clean.size(), thin.size());
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "clean_and_thin: %s\n", e.what());
    return 1;
}

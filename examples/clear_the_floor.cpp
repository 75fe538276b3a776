// SPDX-License-Identifier: BSL-1.0
// What stands on the floor? A moving sensor, the floor left out, the rest grouped by distance, the
// groups written as labels of the whole cloud.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/help.hpp"
#include <gnomon/filters.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

int main(int argc, char** argv) {
    if (printed_help(argc, argv,
                     "Leaves out the floor of a simulated room, and groups what stands on it."))
        return 0;
    const sim::scene room = sim::scenes::furnished_room({.seed = 4});
    const sim::vertical nod{.mount = room.sensor};
    const auto trajectory = sim::along(4.0, [&](double seconds) {  // driving while it nods
        return sim::at(0.1 * seconds, 0, 0) * nod(seconds);
    });
    const auto scan = sim::simulate(room, trajectory, {}, {.sigma = 0.005}).scan;

    // [clear_the_floor]
    // Points and view points as they may lie in your memory.
    const std::vector<Eigen::Vector3d>& points = scan.points;
    std::vector<Eigen::Vector3d> seen_from;
    for (std::size_t i = 0; i < points.size(); ++i) seen_from.push_back(scan.viewpoints[i]);
    const auto cloud = gnomon::with_viewpoints(points, gnomon::viewpoint_table(seen_from));

    auto surface = gnomon::estimate_normals(cloud, gnomon::knn{.k = 30}, gnomon::plane_pca{},
                                            gnomon::threads{});
    gnomon::orient_normals(cloud, surface);

    const std::optional<gnomon::plane> floor = gnomon::find_floor(cloud, Eigen::Vector3d::UnitZ());
    if (!floor) return 1;  // furniture alone, say
    const auto kept = gnomon::crop_height(points, *floor, gnomon::find_ceiling(points, *floor));
    const auto groups = gnomon::euclidean_clusters(gnomon::subset_view(points, kept),
                                                   {.radius = 0.1, .min_points = 100});

    std::vector<std::int32_t> labels(points.size(), gnomon::unlabeled);  // of the whole cloud
    for (std::size_t i = 0; i < kept.size(); ++i) labels[kept[i]] = groups.labels()[i];

    using namespace gnomon::io;
    write_ply("groups.ply", cloud, {normal_properties(surface), scalar_property("label", labels)});
    // [clear_the_floor]
    std::printf("%zu of %zu points stand on the floor, in %zu groups\n", kept.size(), points.size(),
                groups.size());
    return 0;
}

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What would a range finder, a depth camera or a spinning lidar see, and what is the truth about
/// each point? Scans a room or a street of the library or a mesh file and writes points, truth,
/// names and a picture.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/json.hpp"
#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "picture/picture.hpp"
#include "simulate_scan/options.hpp"
#include "simulate_scan/scenes.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

sim::true_scan scan_of(const sim::scene& world, const options& o) {
    const progress telling("scanning");
    sim::beam beam = o.beam;
    if (const auto* camera = std::get_if<sim::depth_camera>(&o.device)) {
        beam.sigma = 0.0;  // the camera has a noise of its own
        if (o.skimmed) beam.footprint = camera->pixel();
        return sim::simulate(world, world.sensor, *camera, beam, o.threads);
    }
    if (o.skimmed) beam.footprint.divergence = gnomon::radians(0.004);
    if (const auto* lidar = std::get_if<sim::spinning_lidar>(&o.device)) {
        const sim::fixed sweep{.mount = world.sensor, .duration = lidar->revolution()};
        return sim::simulate(world, sweep, *lidar, beam, o.threads);
    }
    const auto along = [&](const auto& trajectory) {
        return sim::simulate(world, trajectory, o.finder, beam, o.threads);
    };
    switch (o.trajectory) {
        case trajectory_kind::horizontal:
            return along(sim::horizontal{.mount = world.sensor});
        case trajectory_kind::vertical:
            return along(sim::vertical{.mount = world.sensor});
        case trajectory_kind::rotational:
            break;
    }
    return along(sim::rotational{.mount = world.sensor});
}

/// The number of points of each object of the scene.
std::vector<std::size_t> points_of_objects(const sim::scene& world, const sim::true_scan& truth) {
    std::vector<std::size_t> count(world.objects().size(), 0);
    for (const std::int32_t object : truth.objects) {
        if (object != sim::nothing) ++count[static_cast<std::size_t>(object)];
    }
    return count;
}

std::string picture_of(const sim::scene& world, const sim::true_scan& truth,
                       const std::vector<std::size_t>& count) {
    const progress telling("drawing");
    // Colors go by size.
    std::vector<std::size_t> order(count.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return count[a] > count[b]; });
    std::vector<std::int32_t> label_of(count.size(), gnomon::unlabeled);
    std::vector<std::string> legend;
    for (const std::size_t object : order) {
        if (count[object] == 0) break;
        label_of[object] = static_cast<std::int32_t>(legend.size());
        legend.push_back(world.objects()[object] + " " + picture::with_commas(count[object]));
    }

    const gnomon::spatial_index index(truth.scan);
    std::vector<gnomon::neighbor> neighbors;
    std::vector<picture::splat> splats;
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        constexpr std::size_t k = 12;
        neighbors.clear();
        if (index.is_finite(i)) gnomon::knn{.k = k}.find(index, i, neighbors);
        const double reach = neighbors.empty() ? 0.0 : std::sqrt(neighbors.back().squared_distance);
        const double spacing = reach * std::sqrt(std::numbers::pi / static_cast<double>(k));
        const std::int32_t object = truth.objects[i];
        const std::int32_t label =
            object == sim::nothing ? gnomon::unlabeled : label_of[static_cast<std::size_t>(object)];
        splats.push_back({truth.scan.points[i], truth.normals[i], 1.2 * spacing, label});
    }
    const auto& viewpoints = truth.scan.viewpoints.positions();
    const Eigen::Vector3d viewpoint =
        viewpoints.empty() ? Eigen::Vector3d::Zero() : viewpoints.front();
    return picture::picture_of(splats, legend, "object", viewpoint, Eigen::Vector3d::UnitZ()).png();
}

void write_points(const std::string& path, const sim::true_scan& truth) {
    using namespace gnomon::io;
    write_ply(path, truth.scan,
              {normal_properties(truth.normals), scalar_property("object", truth.objects),
               scalar_property("part", truth.parts), scalar_property("surface", truth.surfaces),
               scalar_property("range", truth.ranges), scalar_property("echo", truth.echoes)});
}

/// Which number means what, and where doors and windows are.
json names_of(const sim::scene& world) {
    json parts = json::array();
    for (const auto& part : world.parts())
        parts.push_back({{"name", part.name}, {"object", part.object}});
    json surfaces = json::array();
    for (const auto& surface : world.surfaces())
        surfaces.push_back({{"name", surface.name}, {"part", surface.part}});
    json openings = json::array();
    for (const auto& [name, rectangle] : world.openings) {
        openings.push_back({{"name", name},
                            {"center", array_of(rectangle.center)},
                            {"horizontal", array_of(rectangle.axes.col(0))},
                            {"width", rectangle.lengths[0]},
                            {"height", rectangle.lengths[1]}});
    }
    return {{"objects", world.objects()},
            {"parts", parts},
            {"surfaces", surfaces},
            {"openings", openings}};
}

void simulate_scan(const options& o) {
    const sim::scene world = scene_of(o);
    const output_directory out(o.out, {"scan.ply", "scan.png", "names.json"});
    const stopwatch watch;
    const sim::true_scan truth = scan_of(world, o);
    const double seconds = watch.seconds();

    // All that could go wrong goes wrong before the first file is written.
    const auto count = points_of_objects(world, truth);
    const std::string drawing = picture_of(world, truth, count);
    const std::string names =
        names_of(world).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    write_points(out / "scan.ply", truth);
    gnomon::io::replace_file(out / "scan.png", drawing);
    gnomon::io::replace_file(out / "names.json", names);

    const auto mixed = std::count(truth.echoes.begin(), truth.echoes.end(), sim::echo::mixed);
    std::printf("%s in %.3f s, %s of several surfaces\n\n",
                picture::counted(truth.scan.size(), "point").c_str(), seconds,
                picture::with_commas(static_cast<std::size_t>(mixed)).c_str());
    for (std::size_t object = 0; object < count.size(); ++object) {
        std::printf("%3zu  %-28s %9s\n", object, world.objects()[object].c_str(),
                    picture::with_commas(count[object]).c_str());
    }
    out.report();
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("simulate_scan", usage, options_from, simulate_scan, argc, argv);
}

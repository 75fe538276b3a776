// SPDX-License-Identifier: BSL-1.0
// Makes a cloud and, where it is known, the truth: DIRECTORY/points and DIRECTORY/normals. Kitchens
// have 15 mm of noise along the rays; the large ones are seen from nine places by a rotational
// scanner of the required density. Of a file, the finite points are taken. With POINTS, only that
// number of them, evenly over the scan.
//     cloud NAME DIRECTORY [POINTS]
// NAME: kitchen, kitchen_preprocessed (without floor and ceiling), kitchen_medium, kitchen_million,
// kitchen_ten_million, or a file
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>

#include "../../examples/common/help.hpp"
#include "vectors.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

struct cloud {
    peers::vectors points;
    peers::vectors normals;  ///< the true ones, or none
};

cloud scan_of_kitchen(const sim::pose& sensor, const sim::scanner& finder, std::uint64_t seed) {
    const auto truth = sim::simulate(sim::scenes::kitchen(), sim::rotational{.mount = sensor},
                                     finder, {.sigma = 0.015, .seed = seed}, gnomon::threads{});
    return {truth.scan.points, truth.normals};
}

cloud kitchen(const sim::scanner& finder) {
    return scan_of_kitchen(sim::scenes::kitchen().sensor, finder, 1);
}

/// What is left of a cloud without floor and ceiling.
cloud preprocessed(const cloud& all) {
    const auto floor = gnomon::find_floor(all.points);
    if (!floor) throw std::runtime_error("there is no floor");
    cloud rest;
    const auto ceiling = gnomon::find_ceiling(all.points, *floor);
    for (const gnomon::point_index i : gnomon::crop_height(all.points, *floor, ceiling)) {
        rest.points.push_back(all.points[i]);
        rest.normals.push_back(all.normals[i]);
    }
    return rest;
}

/// From random places above the table, looking anywhere.
cloud kitchen_of(std::size_t points) {
    constexpr std::size_t scans = 9;
    // Every ray meets something, as the room is closed: a few more than are kept.
    const sim::scanner dense = sim::densities::high();
    const double finer =
        std::sqrt(1.01 * static_cast<double>(points) / static_cast<double>(scans * 115'200));
    const sim::scanner finder{.resolution = gnomon::radians(dense.resolution.radians() / finer),
                              .frequency = dense.frequency * finer};
    cloud all;
    for (std::size_t scan = 1; scan <= scans; ++scan) {
        gnomon::random_stream random(scan);
        const double x = random.uniform(0.4, 3.2);
        const double y = random.uniform(-1.8, 1.8);
        const double z = random.uniform(1.2, 2.2);
        const gnomon::angle turn = gnomon::degrees(random.uniform(-180.0, 180.0));
        const cloud one = scan_of_kitchen(
            sim::at(x, y, z) * sim::yaw(turn) * sim::pitch(gnomon::degrees(10)), finder, scan);
        all.points.insert(all.points.end(), one.points.begin(), one.points.end());
        all.normals.insert(all.normals.end(), one.normals.begin(), one.normals.end());
    }
    if (all.points.size() < points) throw std::runtime_error("too few points were seen");
    all.points.resize(points);
    all.normals.resize(points);
    return all;
}

cloud finite_points_of(const std::string& path) {
    cloud c;
    for (const Eigen::Vector3d& p : gnomon::io::read(path).points) {
        if (gnomon::is_finite(p)) c.points.push_back(p);
    }
    return c;
}

cloud called(const std::string& name) {
    if (name == "kitchen") return kitchen(sim::densities::high());
    if (name == "kitchen_preprocessed") return preprocessed(called("kitchen"));
    if (name == "kitchen_medium") return kitchen(sim::densities::medium());
    if (name == "kitchen_million") return kitchen_of(1'000'000);
    if (name == "kitchen_ten_million") return kitchen_of(10'000'000);
    return finite_points_of(name);
}

/// `points` of them, at equal distances in the list.
peers::vectors part(const peers::vectors& list, std::size_t points) {
    if (list.empty()) return list;  // the truth is not known
    if (points > list.size()) throw std::runtime_error("the cloud has fewer points");
    peers::vectors some;
    for (std::size_t i = 0; i < points; ++i) some.push_back(list[i * list.size() / points]);
    return some;
}

}  // namespace

int main(int argc, char** argv) {
    const char* const arguments = " NAME DIRECTORY [POINTS]";
    const char* const names =
        "NAME: kitchen, kitchen_preprocessed, kitchen_medium, kitchen_million, "
        "kitchen_ten_million, or a file";
    if (printed_help(argc, argv, names, arguments)) return 0;
    const std::string count = argc == 4 ? argv[3] : "0";
    std::size_t points = 0;
    const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), points);
    const bool counts = problem == std::errc{} && *end == '\0' && (argc == 3 || points > 0);
    if (argc < 3 || argc > 4 || !counts) {
        std::fprintf(stderr, "%s%s\n", usage_of(argv[0], arguments).c_str(), names);
        return 2;
    }
    try {
        cloud c = called(argv[1]);
        if (points > 0) c = {part(c.points, points), part(c.normals, points)};
        const std::string directory = argv[2];
        peers::write_vectors(directory + "/points", c.points);
        peers::write_vectors(directory + "/normals", c.normals);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "cloud: %s\n", failure.what());
        return 1;
    }
}

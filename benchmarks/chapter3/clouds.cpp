// SPDX-License-Identifier: BSL-1.0
#include "clouds.hpp"

#include <cmath>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <utility>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

labeled_cloud labeled(sim::true_scan truth) {
    return {std::move(truth.scan), std::move(truth.normals)};
}

sim::scanner of_density(int beams) {
    for (const sim::scanner& finder :
         {sim::densities::low(), sim::densities::medium(), sim::densities::high()}) {
        if (finder.beams() * finder.lines(4.0) == static_cast<std::size_t>(beams)) return finder;
    }
    throw std::invalid_argument("kitchen: there is no such density");
}

sim::true_scan simulated(const sim::scene& world, const std::string& trajectory,
                         const sim::scanner& finder, const sim::beam& beam) {
    const gnomon::threads all{};
    if (trajectory == "horizontal")
        return sim::simulate(world, sim::horizontal{.mount = world.sensor}, finder, beam, all);
    if (trajectory == "vertical")
        return sim::simulate(world, sim::vertical{.mount = world.sensor}, finder, beam, all);
    if (trajectory == "rotational")
        return sim::simulate(world, sim::rotational{.mount = world.sensor}, finder, beam, all);
    throw std::invalid_argument("kitchen: there is no such trajectory");
}

/// Marks the points of a segment that lie within three standard deviations of its plane. The plane
/// is fitted to them in turn, until its rim has settled.
void mark_plane(labeled_cloud& cloud, std::span<const gnomon::point_index> segment) {
    std::vector<gnomon::point_index> inliers(segment.begin(), segment.end());
    Eigen::Vector3d normal;
    for (int round = 0; round < 10; ++round) {
        std::vector<Eigen::Vector3d> positions;
        for (const auto i : inliers) positions.push_back(cloud.scan.points[i]);
        const auto others = std::span(positions).subspan(1);
        normal = gnomon::plane_pca{}(positions[0], others).normal;
        const Eigen::Vector3d middle =
            positions[0] + gnomon::moments::about(positions[0], others).mean_with_point();
        const auto distance = [&](gnomon::point_index i) {
            return std::abs(normal.dot(cloud.scan.points[i] - middle));
        };
        double squares = 0.0;
        for (const auto i : inliers) squares += distance(i) * distance(i);
        const double deviation = std::sqrt(squares / static_cast<double>(inliers.size()));
        inliers.clear();
        for (const auto i : segment) {
            if (distance(i) <= 3.0 * deviation) inliers.push_back(i);
        }
    }
    for (const auto i : inliers) cloud.normals[i] = normal;
}

}  // namespace

cloud_source scenario_one(double sigma, double scale) {
    return [=](std::uint64_t seed) {
        return labeled(
            sim::simulate(sim::box_and_cylinder{.sigma = sigma, .scale = scale, .seed = seed}));
    };
}

cloud_source scenario_two(double sigma) {
    return [=](std::uint64_t seed) {
        const sim::scene world = sim::scenes::boxes_and_bin();
        const sim::horizontal sweep{
            .mount = world.sensor, .duration = 0.455, .sweep = gnomon::degrees(70)};
        return labeled(sim::simulate(world, sweep, sim::scanners::sick_lms_400(),
                                     {.sigma = sigma, .seed = seed}));
    };
}

cloud_source kitchen(const std::string& trajectory, int density, double sigma, double scale) {
    return [=](std::uint64_t seed) {
        return labeled(simulated(sim::scenes::kitchen(scale), trajectory, of_density(density),
                                 {.sigma = sigma, .seed = seed}));
    };
}

std::optional<cloud_source> real_table() {
    const std::string path = CHAPTER3_DATA "/scans/lms400_table_scene_1cm.pcd";
    if (!std::filesystem::exists(path)) return std::nullopt;
    return [path](std::uint64_t) {
        labeled_cloud cloud{gnomon::io::read(path), {}};
        const gnomon::scan& scan = cloud.scan;
        cloud.normals.assign(scan.size(), Eigen::Vector3d::Zero());
        const gnomon::threads all{};
        auto surface = gnomon::estimate_normals(scan, gnomon::knn{}, gnomon::plane_pca{}, all);
        gnomon::repair_anisotropic(scan, gnomon::knn{}, surface, gnomon::plane_pca{}, {}, all);
        const auto parts = gnomon::segment_surfaces(scan, surface, {}, all);
        for (std::size_t s = 0; s < 2 && s < parts.size(); ++s) mark_plane(cloud, parts[s]);
        return cloud;
    };
}

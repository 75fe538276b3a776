// SPDX-License-Identifier: BSL-1.0
// The surfaces of random streets in sweeps of spinning lidars, whose scan lines are far apart, and
// of a real sweep. The ground of a street is its road without the pavements.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "../chapter4/record.hpp"
#include "furnished.hpp"
#include "perceived.hpp"
#include "scores.hpp"
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/neighborhoods/noise_knn.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/detail/separate_parts.hpp>
#include <gnomon/segmentation/segment_planes.hpp>
#include <gnomon/simulation/spinning_lidar.hpp>
#include <gnomon/simulation/street.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace {

constexpr double sigma = 0.02;  // [m]

/// A lidar, how it moves, and what the chain is given.
struct setting {
    std::string name;
    sim::spinning_lidar lidar;
    double speed = 0.0;      // [m/s]
    double given = 0.0;      // noise [m]; measured, if 0
    double misplaced = 0.0;  // the view point, along the road [m]
    bool plain = false;      // the street
    double crown = 0.0;      // of the road [m]
};

std::vector<setting> settings() {
    const auto few = sim::scanners::velodyne_vlp_16(), some = sim::scanners::velodyne_hdl_32e(),
               many = sim::scanners::velodyne_hdl_64e();
    std::vector<setting> all{{"16 beams", few}, {"32 beams", some}, {"64 beams", many}};
    all.push_back({"32 beams at 15 m/s", some, 15.0});
    for (const auto& [name, lidar] :
         {std::pair("16", few), std::pair("32", some), std::pair("64", many)})
        all.push_back(
            {.name = std::string(name) + " beams, plain streets", .lidar = lidar, .plain = true});
    for (const auto& [name, lidar] : {std::pair("32 beams", some), std::pair("64 beams", many)}) {
        all.push_back({.name = std::string(name) + ", curved roads", .lidar = lidar, .crown = 0.1});
        all.push_back({std::string(name) + ", half of the noise", lidar, 0.0, 0.5 * sigma});
        all.push_back({std::string(name) + ", twice the noise", lidar, 0.0, 2.0 * sigma});
        all.push_back({std::string(name) + ", view point 1 m off", lidar, 0.0, 0.0, 1.0});
    }
    return all;
}

/// The sweep of a lidar from the middle of a street.
sim::true_scan sweep(const sim::scene& street, const setting& s, std::uint64_t seed) {
    const sim::driving drive{.mount = street.sensor,
                             .duration = s.lidar.revolution(),
                             .velocity = Eigen::Vector3d(s.speed, 0.0, 0.0)};
    sim::true_scan truth =
        sim::simulate(street, drive, s.lidar, sim::beam{.sigma = sigma, .seed = seed});
    if (s.misplaced > 0.0)
        truth.scan.viewpoints = gnomon::viewpoint_table(
            Eigen::Vector3d(street.sensor.position + Eigen::Vector3d(s.misplaced, 0.0, 0.0)));
    return truth;
}

/// The label of most points, and their share.
struct majority {
    std::int32_t label = gnomon::unlabeled;
    double share = 0.0;

    majority(const std::vector<std::size_t>& points, const gnomon::segments& found) {
        std::map<std::int32_t, std::size_t> count;
        for (const std::size_t i : points) ++count[found.labels()[i]];
        std::size_t most = 0;
        for (const auto& [l, n] : count)
            if (l != gnomon::unlabeled && n > most) most = n, label = l;
        if (!points.empty()) share = double(most) / double(points.size());
    }
};

/// The points of each surface of a scene.
std::map<std::string, std::vector<std::size_t>> points_by_name(const sim::scene& street,
                                                               const sim::true_scan& truth) {
    std::map<std::string, std::vector<std::size_t>> points;
    for (std::size_t i = 0; i < truth.scan.size(); ++i)
        if (truth.surfaces[i] != sim::nothing)
            points[street.surface_name(truth.surfaces[i])].push_back(i);
    return points;
}

/// The name of the face that most points of each joined surface are of.
std::map<std::int32_t, std::string> names_of(
    const std::map<std::string, std::vector<std::size_t>>& points,
    const joined_surfaces& surfaces) {
    std::map<std::int32_t, std::pair<std::size_t, std::string>> largest;
    for (const auto& [name, of] : points) {
        auto& [most, its_name] = largest[surfaces.of(of.front())];
        if (of.size() > most) most = of.size(), its_name = name;
    }
    std::map<std::int32_t, std::string> names;
    for (const auto& [surface, face] : largest) names[surface] = face.second;
    return names;
}

/// The true surfaces as a segmentation without any error has them before merging, one piece for
/// each part that no neighbors connect, and merged as the chain does. What they lack to 1 is the
/// loss of the rules by which gaps are closed.
gnomon::segments merged_true_pieces(const sim::true_scan& truth, const joined_surfaces& surfaces,
                                    const gnomon::noise_curve& noise) {
    const gnomon::spatial_index index(truth.scan);
    std::map<std::int32_t, std::int32_t> number;
    gnomon::detail::scratch<std::int32_t> labels(index.size(), gnomon::unlabeled);
    for (std::size_t i = 0; i < index.size(); ++i) {
        const std::int32_t surface = surfaces.of(i);
        if (surface == sim::nothing) continue;
        labels[i] =
            number.try_emplace(surface, static_cast<std::int32_t>(number.size())).first->second;
    }
    const auto graph = gnomon::noise_knn{.noise = noise}(index);
    (void)gnomon::detail::separate_parts(graph, labels, gnomon::segment_planes_options{}.min_points,
                                         gnomon::sequential{});
    const gnomon::visibility visible(truth.scan, {.noise = noise});
    return gnomon::merge_occluded(index, gnomon::segments({labels.begin(), labels.end()}), visible,
                                  gnomon::conservative{}, {.noise = noise})
        .segments;
}

/// What a surface is of, for the table of losses.
std::string kind_of(const std::string& name) {
    const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
    if (name.ends_with("facade/wall")) return "walls of facades";
    if (has("/facade/")) return "windows, doors";
    if (has("wheel")) return "wheels";
    if (has("/body/left") || has("/cabin/left")) return "sides of vehicles";
    if (has("road") || has("pavement") || has("kerb")) return "ground, kerbs";
    return "other";
}

/// The mean IoU by points of recovered surfaces, and how much each kind of them takes from 1.
struct street_score {
    double iou = 0.0, of_facades = 0.0;
    std::map<std::string, double> lost;
};
street_score score_of(const std::vector<recovered_surface>& all,
                      const std::map<std::int32_t, std::string>& names) {
    std::vector<recovered_surface> counted, facades;
    double whole = 0.0;
    for (const recovered_surface& s : all) {
        const std::string& name = names.at(s.surface);
        if (name.ends_with("leaves")) continue;
        counted.push_back(s);
        if (name.ends_with("facade/wall")) facades.push_back(s);
        whole += static_cast<double>(s.points);
    }
    street_score score{mean_iou(counted, true), mean_iou(facades, true), {}};
    for (const recovered_surface& s : counted)
        score.lost[kind_of(names.at(s.surface))] +=
            static_cast<double>(s.points) * (1.0 - s.iou) / whole;
    return score;
}

/// The rows of a setting in both tables.
struct street_rows {
    json row, lost;
};
street_rows rows_of(const setting& s, std::uint64_t first, std::uint64_t count) {
    double share = 0.0, least = 1.0, iou = 0.0, facades = 0.0, seconds = 0.0, squares = 0.0;
    std::size_t apart = 0, sides = 0, ground = 0, segments = 0;
    std::vector<double> errors;  // [degrees]
    double true_iou = 0.0, true_facades = 0.0;
    std::map<std::string, double> lost;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const sim::scene street =
            sim::scenes::street({.crown = s.crown, .plain = s.plain, .seed = seed});
        const sim::true_scan truth = sweep(street, s, seed);
        gnomon::perception<> chain;
        if (s.given > 0.0) chain.noise = gnomon::constant_noise{s.given};
        const auto start = std::chrono::steady_clock::now();
        const auto seen = chain(truth.scan);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        seconds += taken.count();
        segments += seen.surfaces.size();

        const auto points = points_by_name(street, truth);
        const joined_surfaces surfaces(truth, seen.kept);
        const auto& road = points.at("road/body/plane");
        const majority of_road(road, seen.surfaces);
        share += of_road.share;
        least = std::min(least, of_road.share);
        for (const char* side : {"pavement left/body/plane", "pavement right/body/plane"}) {
            const auto found = points.find(side);
            if (found == points.end() || found->second.size() < 100) continue;
            ++sides;
            apart += majority(found->second, seen.surfaces).label != of_road.label ? 1 : 0;
        }
        const auto names = names_of(points, surfaces);
        const auto of = [&](const gnomon::segments& found) {
            return score_of(recovered(surfaces, seen.kept, found, 100), names);
        };
        const street_score score = of(seen.surfaces);
        const street_score best = of(merged_true_pieces(truth, surfaces, seen.noise.of_planes));
        true_iou += best.iou;
        true_facades += best.of_facades;
        iou += score.iou;
        facades += score.of_facades;
        for (const auto& [kind, part] : score.lost) lost[kind] += part;
        ground += road.size();
        const gnomon::noise_curve& noise = seen.noise.curve;
        const auto normals = gnomon::estimate_normals(truth.scan, gnomon::ray_knn{.noise = noise},
                                                      gnomon::robust_ray_ls{.noise = noise});
        for (const std::size_t i : road) {
            errors.push_back(
                gnomon::unoriented_angle(normals[i].normal, truth.normals[i]).degrees());
            squares += errors.back() * errors.back();
        }
    }
    const auto n = static_cast<double>(count);
    json losses{{"sweep", s.name}, {"lost", rounded(1.0 - iou / n, 3)}};
    for (const char* kind : {"windows, doors", "walls of facades", "sides of vehicles", "wheels",
                             "ground, kerbs", "other"})
        losses[kind] = rounded(lost[kind] / n, 3);
    losses["IoU from the truth"] = rounded(true_iou / n, 3);
    losses["of facades, from the truth"] = rounded(true_facades / n, 3);
    return {{{"sweep", s.name},
             {"streets", count},
             {"ground points", ground},
             {"ground in one segment", rounded(share / n, 3)},
             {"least", rounded(least, 3)},
             {"pavements apart", std::to_string(apart) + " of " + std::to_string(sides)},
             {"IoU by points", rounded(iou / n, 3)},
             {"of facades", rounded(facades / n, 3)},
             {"ground normals, RMS [degrees]", rounded(std::sqrt(squares / double(ground)), 1)},
             {"median", rounded(median_of(errors), 2)},
             {"segments", rounded(double(segments) / n, 1)},
             {"time [s]", rounded(seconds / n, 2)}},
            losses};
}

/// The points within 15 cm of the plane, of 500 through three of the low points drawn, that has
/// most of them within 10 cm; 3 to 40 m away.
std::vector<std::size_t> ground_of(const gnomon::scan& scan) {
    std::vector<std::size_t> low;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector3d& p = scan.points[i];
        if (p.z() < -1.2 && p.head<2>().norm() > 3.0 && p.head<2>().norm() < 30.0) low.push_back(i);
    }
    if (low.size() < 3) return {};
    gnomon::random_stream random(1);
    Eigen::Vector3d normal(0.0, 0.0, 1.0), through(0.0, 0.0, 0.0);
    std::ptrdiff_t most = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const auto draw = [&] { return scan.points[low[random.below(low.size())]]; };
        const Eigen::Vector3d a = draw(), b = draw(), c = draw();
        Eigen::Vector3d n = (b - a).cross(c - a);
        if (n.norm() < 1.0 || std::abs(n.normalized().z()) < 0.95) continue;
        n.normalize();
        const auto on = std::ranges::count_if(
            low, [&](std::size_t i) { return std::abs(n.dot(scan.points[i] - a)) < 0.10; });
        if (on > most) most = on, normal = n, through = a;
    }
    std::vector<std::size_t> ground;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Vector3d& p = scan.points[i];
        if (std::abs(normal.dot(p - through)) < 0.15 && p.norm() > 3.0 && p.norm() < 40.0)
            ground.push_back(i);
    }
    return ground;
}

/// A real sweep, by its own noise, by others, and from elsewhere.
json real_sweep() {
    json rows = json::array();
    const std::filesystem::path file =
        std::filesystem::path(SURFACES_DATA) / "scans" / "kitti_000008_front.ply";
    if (!std::filesystem::exists(file)) return rows;
    gnomon::scan scan = gnomon::io::read(file.string());
    const auto ground = ground_of(scan);
    const auto add = [&](const char* name, double given, double misplaced) {
        scan.viewpoints = Eigen::Vector3d(misplaced, 0.0, 0.0);
        gnomon::perception<> chain;
        if (given > 0.0) chain.noise = gnomon::constant_noise{given};
        const auto seen = chain(scan);
        rows.push_back(
            {{"sweep", std::string("kitti_000008_front, ") + name},
             {"ground points", ground.size()},
             {"noise at 10 m [mm]", rounded(1000.0 * seen.noise.curve(10.0), 1)},
             {"ground in one segment", rounded(majority(ground, seen.surfaces).share, 3)},
             {"segments", seen.surfaces.size()}});
    };
    add("noise measured", 0.0, 0.0);
    add("noise of 1 cm", 0.01, 0.0);
    add("noise of 2 cm", 0.02, 0.0);
    add("noise of 4 cm", 0.04, 0.0);
    add("view point 1 m off", 0.0, 1.0);
    return rows;
}

json measure(const effort& much) {
    json rows = json::array(), lost = json::array();
    for (const setting& s : settings()) {
        const street_rows both = rows_of(s, 10'001, much.quick ? 1 : 5);
        rows.push_back(both.row);
        lost.push_back(both.lost);
        std::printf("%s\n%s\n", both.row.dump().c_str(), both.lost.dump().c_str());
        std::fflush(stdout);
    }
    json real = real_sweep();
    for (const json& row : real) std::printf("%s\n", row.dump().c_str());
    return {{"simulated sweeps", rows}, {"where the IoU is lost", lost}, {"a real sweep", real}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How far can I trust a normal? Estimates normals with their covariances, colors a scan by them,
/// and, where the truth is known, tests whether the errors agree with the covariances.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/output_directory.hpp"
#include "common/program.hpp"
#include "common/progress.hpp"
#include "normal_uncertainty/options.hpp"
#include "picture/picture.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// Classes of deviation: up to 0.5, 1, 2, 4 and 8 degrees, and beyond.
constexpr std::array<double, 5> limits{0.5, 1.0, 2.0, 4.0, 8.0};
constexpr std::array<const char*, 6> class_names{"to 0.5 deg", "to 1 deg", "to 2 deg",
                                                 "to 4 deg",   "to 8 deg", "more"};

std::size_t class_of(double degrees) {
    std::size_t c = 0;
    while (c < limits.size() && degrees > limits[c]) ++c;
    return c;
}

/// Without a file: a kitchen, and what is true of it.
sim::true_scan scan_of(const options& o) {
    if (!o.scan.empty()) {
        sim::true_scan known;
        known.scan = gnomon::io::read(o.scan);
        return known;
    }
    const sim::scene world = sim::scenes::kitchen();
    return sim::simulate(world, sim::rotational{.mount = world.sensor}, sim::densities::high(),
                         {.sigma = o.sigma, .seed = 1}, o.threads);
}

/// One line per class: the errors of the normals whose estimated deviation is in it. At edges,
/// where two surfaces meet, no plane is true: these neighborhoods are counted apart.
void print_calibration(const sim::true_scan& truth, const auto& surface,
                       const std::vector<double>& deviations, const gnomon::adjacency& graph) {
    std::array<std::size_t, 6> points{};
    std::array<double, 6> squares{};
    std::array<double, 6> errors{};
    std::size_t within = 0;
    std::size_t of_one_surface = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
        if (!gnomon::usable(surface[i].trust) || gnomon::is_missing(truth.normals[i])) continue;
        bool flat = true;
        for (const auto j : graph[i])
            flat = flat && truth.normals[j].dot(truth.normals[i]) > 1.0 - 1e-9;
        if (!flat) continue;
        ++of_one_surface;
        const std::size_t c = class_of(deviations[i]);
        ++points[c];
        squares[c] += deviations[i] * deviations[i];
        const double error =
            gnomon::unoriented_angle(surface[i].normal, truth.normals[i]).degrees();
        errors[c] += error * error;
        within += gnomon::nees(surface[i], truth.normals[i]) < 5.991;
    }
    std::printf("%-12s %10s %12s %12s\n", "deviation", "points", "estimated", "found");
    for (std::size_t c = 0; c < points.size(); ++c) {
        if (points[c] == 0) continue;
        const auto n = static_cast<double>(points[c]);
        // Of two directions across the normal: the angle is larger by the root of two.
        std::printf("%-12s %10s %8.2f deg %8.2f deg\n", class_names[c],
                    picture::with_commas(points[c]).c_str(), std::sqrt(2.0 * squares[c] / n),
                    std::sqrt(errors[c] / n));
    }
    std::printf(
        "%.1f %% of the true normals lie within the regions of 95 %%\n"
        "(%s of %s points, those whose neighbors are all on one plane)\n",
        100.0 * static_cast<double>(within) / static_cast<double>(of_one_surface),
        picture::with_commas(of_one_surface).c_str(), picture::with_commas(surface.size()).c_str());
}

void normal_uncertainty(const options& o) {
    const sim::true_scan known = scan_of(o);
    const gnomon::scan& scan = known.scan;
    const output_directory out(o.out, {"normals.ply", "uncertainty.png"});
    const stopwatch watch;
    // [normal_uncertainty]
    const gnomon::noise_curve noise = gnomon::constant_noise{o.sigma};
    const gnomon::adjacency graph = gnomon::ray_knn{.k = o.k, .noise = noise}(scan, o.threads);
    auto surface =
        gnomon::estimate_normals(scan, graph, gnomon::plane_eif{.noise = noise}, o.threads);
    std::vector<double> deviations;  // of each normal, in one direction [degrees]; NaN for none
    for (const auto& s : surface) {
        deviations.push_back(gnomon::usable(s.trust)
                                 ? gnomon::radians(std::sqrt(0.5 * s.trace())).degrees()
                                 : std::numeric_limits<double>::quiet_NaN());
    }
    // [normal_uncertainty]
    gnomon::orient_normals(scan, surface);
    std::printf("%s in %.3f s\n\n", picture::counted(scan.size(), "normal").c_str(),
                watch.seconds());
    if (!known.normals.empty()) print_calibration(known, surface, deviations, graph);

    std::vector<picture::splat> splats;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        if (!gnomon::is_finite(scan.points[i])) continue;
        const bool usable = gnomon::usable(surface[i].trust);
        const auto label = usable ? static_cast<std::int32_t>(class_of(deviations[i])) : -1;
        splats.push_back({scan.points[i], surface[i].normal, 0.5 * surface[i].mean_distance, label,
                          picture::warning_color(label)});
    }
    const auto& viewpoints = scan.viewpoints.positions();
    const std::string drawing =
        picture::picture_of(splats, {class_names.begin(), class_names.end()}, "level",
                            viewpoints.empty() ? Eigen::Vector3d::Zero() : viewpoints.front(),
                            Eigen::Vector3d::UnitZ(), picture::warning_color)
            .png();
    using namespace gnomon::io;
    write_ply(out / "normals.ply", scan,
              {normal_properties(surface), scalar_property("deviation", deviations)});
    replace_file(out / "uncertainty.png", drawing);
    out.report();
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("normal_uncertainty", usage, options_from, normal_uncertainty, argc, argv);
}

// SPDX-License-Identifier: BSL-1.0
// Which furniture is in a cluttered room, and where exactly, although pieces touch?
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception/find_objects.hpp>
#include <gnomon/simulation.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

// [learn_to_find]
/// A finder that knows the surface of each model, and which parts of it are seen where.
rec::object_finder finder_of(const std::vector<sim::furniture_model>& models,
                             std::uint64_t views_per_model) {
    constexpr double spacing = 0.02;  // of the samples of surfaces [m]
    rec::object_finder finder;
    for (const sim::furniture_model& model : models) {
        const auto samples = sim::sample_surface(model, {.spacing = spacing});
        const std::size_t object =
            finder.add(model.name, rec::surface_model(samples, samples, spacing, std::nullopt,
                                                      &sim::surface_sample::position));
        for (std::uint64_t v = 0; v < views_per_model; ++v) {
            const auto shot = sim::simulate_object_view(model, v);
            const auto seen =
                rec::perceive_views(shot.truth.scan, {.ground = gnomon::plane{},
                                                      .noise = gnomon::constant_noise{0.005},
                                                      .gap = rec::infinite_gap});
            for (const rec::view& view : seen.views) finder.learn(view, shot.pose, object);
        }
    }
    finder.fit(gnomon::threads{});
    return finder;
}
// [learn_to_find]

int main(int argc, char** argv) {
    if (printed_help(argc, argv,
                     "Finds the furniture of a simulated, cluttered room, with its poses."))
        return 0;
    const rec::object_finder finder = finder_of(sim::furniture_models(), 12);
    const sim::scene room =
        sim::scenes::furnished_room({.pieces = 5, .seed = 3, .clutter = 12, .touching = true});
    const gnomon::scan scan =
        sim::simulate(room, sim::vertical{.mount = room.sensor, .duration = 4.0}, sim::scanner{},
                      {.sigma = 0.005, .seed = 3})
            .scan;

    // [find_objects]
    const rec::found_objects found = finder(scan, {}, gnomon::threads{});
    std::printf("%zu points, %zu objects\n", scan.size(), found.objects.size());
    for (std::size_t i = 0; i < found.objects.size(); ++i) {
        const rec::found_object& o = found.objects[i];
        const gnomon::rigid_motion& pose = o.aligned.pose;
        std::printf("%-14s %.2f  at %.3f %.3f m, heading %.1f degrees, %zu points\n",
                    finder.names()[o.object].c_str(), o.probability, pose.position.x(),
                    pose.position.y(),
                    std::atan2(pose.rotation(1, 0), pose.rotation(0, 0)) * 180.0 / std::numbers::pi,
                    found.points[i].size());
        // Of turns [rad] and shifts [m]. The heading of a round table cannot be known.
        const auto covariance = o.aligned.covariance_about(pose.position);
        if (o.aligned.is_usable())
            std::printf("    +- %.1f mm and %.2f degrees\n",
                        1e3 * std::sqrt(covariance(3, 3) + covariance(4, 4)),
                        std::sqrt(covariance(2, 2)) * 180.0 / std::numbers::pi);
        std::printf(
            "    %.0f %% of the visible surface is there, %.0f %% of the points are on it\n",
            100.0 * o.evidence.support(), 100.0 * o.evidence.explanation());
    }
    // [find_objects]
    for (const std::string& name : room.objects()) std::printf("%s, ", name.c_str());
    std::puts("are in the room");
    return 0;
}

// SPDX-License-Identifier: BSL-1.0
// How does a surface bend, and what is such a surface called? One of each of the eight types,
// scanned from the origin with a noise of 1 mm.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// Bends about both axes: radius(z) about the upright one, and as its profile along it.
sim::surface_of_revolution turned(double half_height, double (*radius)(double z)) {
    std::vector<sim::profile_point> profile;
    for (int i = -20; i <= 20; ++i) {
        const double z = half_height * i / 20.0;
        profile.push_back({.radius = radius(z), .height = z});
    }
    return sim::surface_of_revolution(profile, {.bottom = false});
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Prints how the shape bends, and the type of most of its points.
/// @return whether that type is the expected one
bool report(const char* name, gnomon::surface_type expected, const auto& shape,
            const sim::pose& place) {
    sim::scene world;
    world.add_object(name, shape, place);
    const gnomon::scan scan =
        sim::simulate(world, sim::rotational{}, sim::densities::medium(), {.sigma = 0.001}).scan;

    // [name_surface_types]
    const gnomon::adjacency graph = gnomon::knn{.k = 100}(scan);
    auto surface = gnomon::estimate_normals(scan, graph, gnomon::plane_pca{});
    gnomon::orient_normals(scan, surface);  // bent towards the sensor is positive
    const std::vector<gnomon::curvature> bends = gnomon::estimate_curvature(scan, graph, surface);
    const gnomon::besl_jain type{.gaussian_tolerance = 0.7, .mean_tolerance = 0.3};
    // [name_surface_types]

    std::array<std::size_t, 9> points{};
    std::vector<double> larger;
    std::vector<double> smaller;
    for (const gnomon::curvature& c : bends) {
        ++points[static_cast<std::size_t>(type(c))];
        if (!gnomon::usable(c.trust)) continue;
        larger.push_back(c.kappa1);
        smaller.push_back(c.kappa2);
    }
    const auto most = std::max_element(points.begin(), points.end());
    const auto found = static_cast<gnomon::surface_type>(most - points.begin());
    std::printf("%-24s %6zu  %6.2f  %6.2f  %-14s %3.0f %%\n", name, bends.size(), median(larger),
                median(smaller), gnomon::to_string(found),
                100.0 * static_cast<double>(*most) / static_cast<double>(bends.size()));
    return found == expected;
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv,
                     "Names the types of curved surfaces, one simulated scan for each."))
        return 0;
    using enum gnomon::surface_type;
    const sim::pose ahead = sim::at(1.2, 0.0, 0.0);
    const sim::pose wall = ahead * sim::pitch(gnomon::degrees(90));
    const auto catenary = [](double z) { return 0.4 * std::cosh(z / 0.4); };
    const auto slender = [](double z) { return 0.2 + 0.4 * z * z; };
    const auto spool = [](double z) { return 0.5 + 2.5 * z * z; };

    std::printf("%-24s %6s  %6s  %6s  %s\n", "", "points", "kappa1", "kappa2", "type of most");
    bool all = report("ball of 0.5 m", peak, sim::sphere{0.5}, ahead);
    all &= report("column of 0.3 m", ridge, sim::cylinder{0.3, 2.0}, sim::at(1.2, 0.0, -1.0));
    all &= report("vase, slender", saddle_ridge, turned(0.3, slender), ahead);
    all &= report("wall", flat, sim::plane_patch{1.5, 1.5}, wall);
    all &= report("catenoid", minimal, turned(0.3, catenary), ahead);
    all &= report("spool", saddle_valley, turned(0.15, spool), ahead);
    all &=
        report("pipe of 0.8 m, inside", valley, sim::cylinder{0.8, 4.0}, sim::at(0.0, 0.0, -2.0));
    all &= report("dome of 1 m, inside", pit, sim::sphere{1.0}, sim::pose{});
    return all ? 0 : 1;
}

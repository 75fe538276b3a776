// SPDX-License-Identifier: BSL-1.0
// Fig. 4.1: what remains without the floor falls apart into groups of points (Alg. 4.1). The thesis
// scanned its own laboratory by a SICK LMS-400 on a turning robot; here a surrogate of as many
// points, 150,000, of which one in a hundred is an outlier anywhere on its ray.
#include <chrono>
#include <map>

#include "rooms.hpp"
#include <gnomon/filters/crop_height.hpp>

namespace sim = gnomon::simulation;

namespace {

/// Near enough for r = 1 cm: the points are to be less than that apart on every surface.
sim::scene boxes_and_bins() {
    using namespace gnomon;
    using namespace gnomon::simulation;
    scene world;
    world.sensor = at(0.0, 0.0, 1.0) * pitch(degrees(45));
    world.add_object("floor", plane_patch{6.0, 6.0});
    world.add_object("box 1", box{0.40, 0.30, 0.25}, at(0.95, 0.50, 0.125) * yaw(degrees(20)));
    world.add_object("box 2", box{0.30, 0.30, 0.40}, at(1.00, -0.50, 0.20) * yaw(degrees(-35)));
    world.add_object("box 3", box{0.25, 0.35, 0.15}, at(0.75, 0.05, 0.075) * yaw(degrees(10)));
    world.add_object("bin 1", cylinder{0.15, 0.35}, at(1.25, 0.10, 0.0));
    world.add_object("bin 2", cylinder{0.10, 0.30}, at(1.30, -0.20, 0.0));
    return world;
}

sim::true_scan scanned(std::uint64_t seed, const sim::scene& world) {
    const sim::horizontal turn{
        .mount = world.sensor, .duration = 1.34, .sweep = gnomon::degrees(90)};
    sim::scanner finder = sim::scanners::sick_lms_400();
    finder.resolution = gnomon::degrees(0.125);
    finder.frequency = 200.0;
    return sim::simulate(world, turn, finder, {.sigma = 0.002, .clutter = 0.01, .seed = seed},
                         gnomon::threads{});
}

json measure(const effort& much) {
    const sim::scene world = boxes_and_bins();
    json rows = json::array();
    for (unsigned seed = 1; seed <= much.seeds(); ++seed) {
        const sim::true_scan truth = scanned(seed, world);
        const gnomon::scan& scan = truth.scan;
        const auto floor = gnomon::find_floor(scan).value();
        const auto kept = gnomon::crop_height(scan, floor, std::nullopt);
        const gnomon::subset_view rest(scan, kept);
        gnomon::segments groups;
        std::vector<double> seconds;
        for (int pass = 0; pass < much.passes(); ++pass) {
            const auto start = std::chrono::steady_clock::now();
            groups = gnomon::euclidean_clusters(scan);  // all, as the thesis times it
            seconds.push_back(
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
        groups = gnomon::euclidean_clusters(rest);

        // What each group is, and where the outliers went.
        std::map<std::int32_t, std::size_t> groups_of_object;
        std::size_t pure = 0, outliers = 0, outliers_left = 0;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            std::map<std::int32_t, std::size_t> of;
            for (const auto i : groups[g]) ++of[truth.objects[kept[i]]];
            const auto most = std::ranges::max_element(of, {}, [](auto& o) { return o.second; });
            ++groups_of_object[most->first];
            pure += 100 * most->second >= 98 * groups[g].size() ? 1 : 0;
        }
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (truth.objects[kept[i]] != sim::nothing) continue;
            ++outliers;
            outliers_left += groups.labels()[i] != gnomon::unlabeled ? 1 : 0;
        }
        rows.push_back({{"seed", seed},
                        {"points", scan.size()},
                        {"without the floor", kept.size()},
                        {"groups", groups.size()},
                        {"of one object", pure},
                        {"objects", groups_of_object.size()},
                        {"outliers", outliers},
                        {"outliers in groups", outliers_left},
                        {"ms for all points", rounded(1e3 * median_of(seconds), 1)}});
        if (seed > 1) continue;
        std::vector<Eigen::Vector3d> points;
        for (const auto i : kept) points.push_back(scan.points[i]);
        draw(points, {}, groups, scan.viewpoints[0], much.out / "fig_4_1.png");
    }
    return {{"groups", rows}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

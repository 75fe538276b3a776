// SPDX-License-Identifier: BSL-1.0
// Merging of occluded segments where its work could grow faster than the cloud: with very many
// coplanar segments, and with a view point for each point. And with a point that is far from all
// others of its segment.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../chapter4/record.hpp"
#include <gnomon/core/detail/stopwatch.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

namespace {

/// Points and the segments that they are in.
struct drawn {
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> labels;

    void add(const Eigen::Vector3d& p, int label) {
        points.push_back(p);
        labels.push_back(label);
    }
};

double seconds_of(auto&& work) {
    const gnomon::detail::stopwatch watch;
    work();
    return watch.seconds();
}

/// A wall 3 m away of segments of 3 x 2 points each, 2 cm apart.
/// @param gap  between segments that are next to each other [m]
drawn wall_of(int segments, double gap) {
    constexpr double spacing = 0.02;  // [m]
    drawn wall;
    const int columns = static_cast<int>(std::sqrt(segments));
    for (int s = 0; s < segments; ++s) {
        const double y = (2 * spacing + gap) * (s % columns - columns / 2);
        const double z = (spacing + gap) * (s / columns - columns / 2);
        for (int p = 0; p < 6; ++p)
            wall.add({3.0, y + spacing * (p % 3), z + spacing * (p / 3)}, s);
    }
    return wall;
}

json many_segments(bool quick) {
    const std::vector<int> counts =
        quick ? std::vector{2'000} : std::vector{20'000, 25'000, 50'000, 100'000};
    json rows = json::array();
    for (const double gap : {0.02, 0.10, 0.50}) {
        for (const int count : counts) {
            const drawn wall = wall_of(count, gap);
            const gnomon::segments parts(wall.labels);
            const gnomon::visibility visible(wall.points);
            std::size_t left = 0;
            const double taken = seconds_of([&] {
                left = gnomon::merge_occluded(wall.points, parts, visible).segments.size();
            });
            rows.push_back({{"gaps [cm]", rounded(100.0 * gap, 0)},
                            {"segments", count},
                            {"left", left},
                            {"time [s]", rounded(taken, 2)},
                            {"per segment [us]", rounded(1e6 * taken / count, 1)}});
            std::printf("%s\n", rows.back().dump().c_str());
            std::fflush(stdout);
        }
    }
    return rows;
}

/// A wall of 4.5 m x 3 m in 15 x 10 segments, at each point of which the sensor, on a path of 1 m,
/// was somewhere else.
json many_viewpoints() {
    constexpr int points = 500, across = 15, segments = 150;
    gnomon::random_stream random(1);
    drawn wall;
    std::vector<Eigen::Vector3d> path;
    for (int i = 0; i < points; ++i) {
        const int s = i % segments;
        wall.add({3.0 + 0.005 * random.gaussian(), 0.3 * (s % across + random.uniform()) - 2.25,
                  0.3 * (s / across + random.uniform()) - 1.5},
                 s);
        path.push_back({0.0, static_cast<double>(i) / points - 0.5, 0.0});
    }
    const gnomon::scan scan{wall.points, gnomon::viewpoint_table(path), {}};
    json rows = json::array();
    const auto add = [&](const char* what, std::size_t before, std::size_t after, double taken) {
        rows.push_back({{"of 500 points", what},
                        {"segments", before},
                        {"left", after},
                        {"time [s]", rounded(taken, 3)}});
        std::printf("%s\n", rows.back().dump().c_str());
    };

    gnomon::perception_result<gnomon::plane_fit> seen;
    const double whole = seconds_of([&] { seen = gnomon::perception<>{}(scan); });
    add("perception", seen.initial_segments.size(), seen.surfaces.size(), whole);

    std::size_t left = 0;
    const gnomon::segments parts(wall.labels);
    const double merging = seconds_of([&] {
        const gnomon::visibility visible(scan);
        left = gnomon::merge_occluded(scan, parts, visible).segments.size();
    });
    add("merge_occluded with its visibility, of given segments", parts.size(), left, merging);
    return rows;
}

/// Two parts of a wall with a narrow gap between them; one of them may have one point 100 m away.
json one_far_point() {
    json rows = json::array();
    const Eigen::Vector3d of_wall(3.0, 0.3, 0.0);
    const std::vector<std::pair<const char*, Eigen::Vector3d>> offsets{
        {"none", {0.0, 0.0, 0.0}},
        {"in the plane", {0.0, 100.0, 0.0}},
        {"in the plane, across the gap", {0.0, -100.0, 0.0}},
        {"behind the wall, on the ray of one of its points", 100.0 * of_wall.normalized()}};
    for (const auto& [where, offset] : offsets) {
        drawn wall;
        for (int i = 0; i < 50; ++i)
            for (int j = 0; j < 25; ++j)
                wall.add({3.0, 0.02 * (i - 25) + (i < 25 ? -0.05 : 0.05), 0.02 * (j - 12)},
                         i < 25 ? 0 : 1);
        if (offset.norm() > 0.0) wall.add(of_wall + offset, 1);
        const auto merged = gnomon::merge_occluded(wall.points, gnomon::segments(wall.labels),
                                                   gnomon::visibility(wall.points));
        rows.push_back({{"point 100 m away", where}, {"merged", merged.segments.size() == 1}});
        std::printf("%s\n", rows.back().dump().c_str());
    }
    return rows;
}

json measure(const effort& much) {
    return {{"coplanar segments of six points", many_segments(much.quick)},
            {"a view point for each point", many_viewpoints()},
            {"two parts of a wall", one_far_point()}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }

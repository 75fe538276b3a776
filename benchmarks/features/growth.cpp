// SPDX-License-Identifier: BSL-1.0
// How the time of the shapes of one segment grows with its points, from 100,000 to 1,000,000: about
// ten times, as long as nothing is worse than O(n log n). Times are those of the processor, the
// medians of several turns of both sizes, in memory that the process keeps: glibc returns large
// blocks to the system after each call, small ones not, and new pages are slow. In each turn the
// small segment is measured ten times, as long as the large one, so that a busy machine disturbs
// both alike: a short run finds a quiet moment more easily than a long one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "two_scans.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/features/alpha_shape.hpp>
#include <gnomon/features/convex_hull.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/fit_cone.hpp>
#include <gnomon/features/fit_cylinder.hpp>
#include <gnomon/features/fit_sphere.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/features/minimum_volume_box.hpp>
#include <gnomon/features/segment_shape.hpp>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

using gnomon::random_stream;

constexpr double noise = 0.005;  // [m]

/// Points with their true normals.
struct segment {
    std::vector<Eigen::Vector3d> points;
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface;

    void add(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, random_stream& random) {
        points.push_back(p + noise * random.gaussian() * normal);
        surface.push_back({});
        surface.back().normal = normal;
    }
};

/// A wall of 4 m x 2.5 m with an opening of 1 m x 2 m.
segment wall_of(std::size_t n) {
    random_stream random(1);
    segment s;
    while (s.points.size() < n) {
        const double x = 4.0 * random.uniform(), z = 2.5 * random.uniform();
        if (std::abs(x - 2.0) < 0.5 && z < 2.0) continue;
        s.add({x, 0.0, z}, {0.0, 1.0, 0.0}, random);
    }
    return s;
}

/// Half of a sphere of 0.5 m, whose points are nearly all extreme without noise.
segment sphere_of(std::size_t n) {
    random_stream random(2);
    segment s;
    while (s.points.size() < n) {
        const double z = random.uniform(), turn = 2.0 * std::numbers::pi * random.uniform();
        const double across = std::sqrt(1.0 - z * z);
        const Eigen::Vector3d normal(across * std::cos(turn), across * std::sin(turn), z);
        s.add(0.5 * normal, normal, random);
    }
    return s;
}

/// Half of a cone of an apex angle of 2 atan(slope); a cylinder of 0.1 m if that is zero.
segment cone_of(std::size_t n, double slope) {
    random_stream random(3);
    segment s;
    while (s.points.size() < n) {
        const double z = 1.0 + random.uniform(), turn = std::numbers::pi * random.uniform();
        const double radius = slope > 0.0 ? slope * z : 0.1;
        const Eigen::Vector3d out(std::cos(turn), std::sin(turn), -slope);
        s.add({radius * out.x(), radius * out.y(), z}, out.normalized(), random);
    }
    return s;
}

/// A shape, of a segment.
struct shape_of {
    std::string shape, segment;
    std::function<void(const ::segment&)> find;
};

const gnomon::plane wall{{0.0, 1.0, 0.0}, 0.0};

std::vector<shape_of> all_shapes() {
    const gnomon::noise_curve of_ranges = gnomon::constant_noise{noise};
    const auto moments = [](const segment& s) {
        std::vector<gnomon::point_index> all(s.points.size());
        std::iota(all.begin(), all.end(), gnomon::point_index{0});
        (void)gnomon::segment_shape::of(s.points, s.surface, all);
    };
    const auto hull = [](const segment& s) { (void)gnomon::convex_hull::of(s.points); };
    const auto box = [](const segment& s) { (void)gnomon::minimum_volume_box(s.points); };
    const auto rectangle = [](const segment& s) {
        (void)gnomon::minimum_area_rectangle(gnomon::convex_polygon::of(s.points, wall));
    };
    const auto outline = [](const segment& s) { (void)gnomon::alpha_shape::of(s.points, wall); };
    return {
        {"principal frame and box", "wall", moments},
        {"minimum-area rectangle", "wall", rectangle},
        {"alpha shape", "wall", outline},
        {"convex hull", "wall", hull},
        {"convex hull", "sphere", hull},
        {"minimum-volume box", "wall", box},
        {"minimum-volume box", "sphere", box},
        {"sphere", "sphere",
         [=](const segment& s) { (void)gnomon::fit_sphere(s.points, s.surface, of_ranges); }},
        {"cylinder", "cylinder",
         [=](const segment& s) { (void)gnomon::fit_cylinder(s.points, s.surface, of_ranges); }},
        {"cone", "cone",
         [=](const segment& s) { (void)gnomon::fit_cone(s.points, s.surface, of_ranges); }},
    };
}

segment make(const std::string& name, std::size_t n) {
    if (name == "wall") return wall_of(n);
    if (name == "sphere") return sphere_of(n);
    return cone_of(n, name == "cone" ? 0.3 : 0.0);
}

json measure(const effort& much) {
    const effort once{.quick = true, .out = {}};
    const std::size_t few = much.quick ? 1'000 : 100'000;
    const int runs = much.quick ? 1 : 7;
    json rows = json::array();
    for (const shape_of& s : all_shapes()) {
        const std::array<segment, 2> segments{make(s.segment, few), make(s.segment, 10 * few)};
        std::vector<double> of_few, of_many, ratios;  // [s]
        for (int run = 0; run < runs; ++run) {
            of_few.push_back(0.1 * seconds_of(once, [&] {
                                 for (int i = 0; i < 10; ++i) s.find(segments[0]);
                             }));
            of_many.push_back(seconds_of(once, [&] { s.find(segments[1]); }));
            ratios.push_back(of_many.back() / of_few.back());
        }
        rows.push_back({{"shape", s.shape},
                        {"segment", s.segment},
                        {"100,000 points [ms]", rounded(1e3 * median_of(of_few), 2)},
                        {"1,000,000 points [ms]", rounded(1e3 * median_of(of_many), 2)},
                        {"ratio", rounded(median_of(ratios), 1)}});
    }
    return {{"growth", rows}};
}

}  // namespace

int main(int argc, char** argv) {
#if defined(__GLIBC__)
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
    return run_program(argc, argv, measure);
}

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Scans of small scenes: walls with gaps, objects in front of or behind them, and the segments
/// that a segmentation would find.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace looks {

namespace sim = gnomon::simulation;

inline const Eigen::Vector3d origin(0, 0, 0);

/// Rays in scan lines from floor to ceiling, one after another from right to left.
struct eye {
    Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< the view point of the first line [m]
    Eigen::Vector3d step = Eigen::Vector3d::Zero();   ///< to that of the next [m]
    double spacing = 1.0;                             ///< of rays [degrees]
    double right = -50.0, left = 50.0;                ///< azimuths [degrees]
    double low = -25.0, high = 25.0;                  ///< elevations [degrees]
    double sigma = 0.0;                               ///< of ranges [m]
};

/// A scan with the true object of each point.
struct look {
    gnomon::scan scan;
    std::vector<std::int32_t> objects;

    /// The segments of a label for each point.
    [[nodiscard]] gnomon::segments parts(auto&& label_of) const {
        std::vector<std::int32_t> labels;
        for (std::size_t i = 0; i < scan.size(); ++i)
            labels.push_back(label_of(scan.points[i], objects[i]));
        return gnomon::segments(labels);
    }
};

inline look look_at(const sim::scene& world, const eye& e = {}) {
    look seen;
    std::vector<Eigen::Vector3d> viewpoints;
    std::vector<gnomon::point_index> line_of_point;
    gnomon::random_stream random(11);
    for (int line = 0; e.right + line * e.spacing <= e.left; ++line) {
        const gnomon::angle azimuth = gnomon::degrees(e.right + line * e.spacing);
        viewpoints.push_back(e.first + line * e.step);
        for (double t = e.low; t <= e.high; t += e.spacing) {
            const gnomon::angle elevation = gnomon::degrees(t);
            const sim::ray r{
                viewpoints.back(),
                {cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)}};
            double range = 100.0;
            std::int32_t surface = sim::nothing;
            for (const sim::placed_shape& s : world.shapes()) {
                const auto hit = s.first_hit(r);
                if (!hit || hit->range >= range) continue;
                range = hit->range;
                surface = hit->surface;
            }
            if (surface == sim::nothing) continue;
            const auto part = world.surfaces()[static_cast<std::size_t>(surface)].part;
            seen.scan.points.push_back(r.point_at(range + e.sigma * random.gaussian()));
            seen.objects.push_back(world.parts()[static_cast<std::size_t>(part)].object);
            line_of_point.push_back(static_cast<gnomon::point_index>(line));
        }
    }
    if (e.step.norm() > 0.0)
        seen.scan.viewpoints = gnomon::viewpoint_table(viewpoints, line_of_point);
    else
        seen.scan.viewpoints = e.first;
    return seen;
}

/// A wall 3 m ahead from y = right to y = left, its front at x = 3.
inline void add_wall(sim::scene& world, double right, double left, double front = 3.0) {
    world.add_object("wall", sim::box{0.1, left - right, 3.0},
                     sim::at(front + 0.05, 0.5 * (right + left), 0.0));
}

/// A column half way to the wall; what it hides of that is 60 cm wide.
inline void add_column(sim::scene& world) {
    world.add_object("column", sim::box{0.1, 0.3, 3.0}, sim::at(1.55, 0.0, 0.0));
}

/// The wall behind the column.
inline sim::scene hidden() {
    sim::scene world;
    add_wall(world, -2.0, 2.0);
    add_column(world);
    return world;
}

/// A wall with a gap of some width, through which nothing is seen.
inline sim::scene torn(double gap) {
    sim::scene world;
    add_wall(world, -2.0, -0.5 * gap);
    add_wall(world, 0.5 * gap, 2.0);
    return world;
}

/// Such a gap, through which another wall is seen.
inline sim::scene opened(double gap) {
    sim::scene world = torn(gap);
    add_wall(world, -3.0, 3.0, 5.0);
    return world;
}

/// The walls 3 m ahead, what is right of the middle and what is left of it; nothing else.
inline gnomon::segments halves(const look& seen) {
    return seen.parts([](const Eigen::Vector3d& p, std::int32_t) {
        if (std::abs(p.x() - 3.0) > 0.08) return gnomon::unlabeled;
        return p.y() < 0.0 ? 0 : 1;
    });
}

}  // namespace looks

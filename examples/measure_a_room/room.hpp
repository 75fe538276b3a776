// SPDX-License-Identifier: BSL-1.0
/// @file
/// Floor, ceiling and walls among the planes of a scan: by their direction, their size, and because
/// no ray goes beyond them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "flat_part.hpp"
#include <gnomon/gnomon.hpp>

/// How far a wall may be from a plane in places [m]; chosen: plaster, less than a leaf is set back.
inline constexpr double unevenness = 0.03;

/// Where a ray crosses the plane of a wall. Only its range has noise, so that the crossing has no
/// error along the wall.
struct crossing {
    double u = 0.0, v = 0.0;              ///< along the wall, and above the floor [m]
    double depth = 0.0;                   ///< of the measured point behind the wall [m]
    double sigma = 0.0;                   ///< of the depth [m]
    double slope_u = 0.0, slope_v = 0.0;  ///< of the ray, per depth
    bool is_of_wall = false;              ///< whether the point is of a segment of this plane,
    bool is_of_other = false;             ///< or of another one

    [[nodiscard]] double tolerance() const { return std::max(3.0 * sigma, unevenness); }
    [[nodiscard]] bool is_on() const {
        return !is_of_other && std::abs(depth) <= (is_of_wall ? tolerance() : 3.0 * sigma);
    }
    [[nodiscard]] bool is_through() const { return depth > (is_of_other ? sigma : tolerance()); }
    [[nodiscard]] bool is_before() const { return depth < -tolerance(); }
};

/// A wall, or a part of one. It is seen from inside: u goes to the right.
struct wall : flat_part {
    std::size_t number = 0;                 ///< of its plane
    Eigen::Vector3d origin{0.0, 0.0, 0.0};  ///< of u and v, on the wall and the floor
    Eigen::Vector3d along{1.0, 0.0, 0.0};
    Eigen::Vector3d up{0.0, 0.0, 1.0};
    double left = 0.0, right = 0.0;                            ///< the ends [m]
    double top = 0.0;                                          ///< at the ceiling [m]
    std::optional<std::size_t> left_neighbor, right_neighbor;  ///< the walls at corners

    [[nodiscard]] Eigen::Vector3d at(double u, double v) const {
        return origin + u * along + v * up;
    }
    [[nodiscard]] double u_of(const Eigen::Vector3d& x) const { return along.dot(x - origin); }
    [[nodiscard]] double v_of(const Eigen::Vector3d& x) const { return up.dot(x - origin); }
    [[nodiscard]] Eigen::Vector3d middle() const { return at(0.5 * (left + right), 0.5 * top); }

    /// Where the ray of a point crosses the wall, if it does, and not too obliquely.
    [[nodiscard]] std::optional<crossing> cross(const gnomon::scan& scan, std::size_t i,
                                                const scan_noise& noise) const {
        const Eigen::Vector3d& from = scan.viewpoints[i];
        const Eigen::Vector3d ray = scan.points[i] - from;
        if (!ray.allFinite()) return std::nullopt;
        const double approach = -normal().dot(ray), away = distance(from);
        constexpr double most_oblique = 0.05;  // cosine; chosen: 87 degrees
        if (!(approach > most_oblique * ray.norm() && away > 0.0)) return std::nullopt;
        const Eigen::Vector3d x = from + away / approach * ray;
        return crossing{u_of(x),
                        v_of(x),
                        -distance(scan.points[i]),
                        sigma_of(scan, i, noise),
                        along.dot(ray) / approach,
                        up.dot(ray) / approach,
                        false,
                        false};
    }
};

/// The planes of a room.
struct room {
    Eigen::Vector3d up{0.0, 0.0, 1.0};
    std::optional<flat_part> floor, ceiling;
    std::vector<wall> walls;                                    ///< clockwise, as seen from above
    std::vector<std::pair<std::size_t, std::size_t>> opposite;  ///< the farthest apart first

    [[nodiscard]] double height_of(const Eigen::Vector3d& x) const {
        return floor ? floor->distance(x) / floor->normal().dot(up) : up.dot(x);
    }
};

namespace detail {

/// The largest level plane with its normal on one side, and with hardly a point beyond.
inline std::optional<flat_part> level_part(const gnomon::scan& scan,
                                           const std::vector<flat_part>& parts,
                                           const Eigen::Vector3d& normal) {
    constexpr double level = 0.985;        // the cosine of 10 degrees; chosen
    constexpr double smallest_area = 1.0;  // [m^2]; chosen: more than most tables
    constexpr double beyond = 0.15;        // [m]; chosen
    constexpr double most_beyond = 0.03;   // of all points; chosen: windows, steps
    const flat_part* found = nullptr;
    for (const flat_part& part : parts) {
        if (part.normal().dot(normal) < level || part.area < smallest_area) continue;
        if (found != nullptr && part.area <= found->area) continue;
        const auto n = std::ranges::count_if(
            scan.points, [&](const Eigen::Vector3d& p) { return part.distance(p) < -beyond; });
        if (static_cast<double>(n) <= most_beyond * static_cast<double>(scan.size())) found = &part;
    }
    if (found == nullptr) return std::nullopt;
    return *found;
}

/// The ends of the parts of a plane that reach the ceiling: the highest rays of each column of it
/// end on the plane, and do not go through. They do over furniture.
inline std::vector<std::array<double, 2>> closed_parts(const wall& w, const gnomon::scan& scan,
                                                       const scan_noise& noise) {
    constexpr double cell = 0.1;            // [m]; chosen
    constexpr double below_ceiling = 0.05;  // [m]; chosen
    constexpr std::size_t longest_gap = 2;  // columns; chosen: not a narrow window
    struct count {
        int on = 0, through = 0;
    };
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto i : w.members) {
        low = std::min(low, w.u_of(scan.points[i]));
        high = std::max(high, w.u_of(scan.points[i]));
    }
    std::map<int, std::map<int, count, std::greater<>>> columns;
    for (std::size_t i = 0; i < scan.size(); ++i) {
        const auto c = w.cross(scan, i, noise);
        if (!c || c->u < low || c->u > high || c->v < 0.0 || c->v > w.top - below_ceiling) continue;
        if (c->is_before()) continue;
        count& n = columns[static_cast<int>(std::floor(c->u / cell))]
                          [static_cast<int>(std::floor(c->v / cell))];
        (c->is_through() ? n.through : n.on) += 1;
    }
    std::vector<std::array<double, 2>> parts;
    int last_closed = 0;
    std::size_t open = 0;
    for (const auto& [u, column] : columns) {
        count top;
        int rows = 0;
        for (const auto& [v, n] : column) {
            if (n.on + n.through < 2) continue;
            top.on += n.on, top.through += n.through;
            if (++rows == 2) break;
        }
        if (rows == 0) continue;
        if (top.through > top.on) {
            ++open;
            continue;
        }
        if (parts.empty() || open > longest_gap) parts.push_back({cell * u, 0.0});
        open = 0;
        last_closed = u;
        parts.back()[1] = cell * (last_closed + 1);
    }
    // Columns at the ends contain points only in part.
    for (auto& [begin, end] : parts) begin = std::max(begin, low), end = std::min(end, high);
    return parts;
}

/// The frame of an upright plane.
inline wall framed(const flat_part& part, const room& of, const Eigen::Vector3d& highest) {
    wall w;
    static_cast<flat_part&>(w) = part;
    const Eigen::Vector3d up = of.floor ? of.floor->normal() : of.up;
    w.up = (up - up.dot(w.normal()) * w.normal()).normalized();
    w.along = w.up.cross(w.normal());
    w.origin = w.plane.centroid;
    if (of.floor) w.origin -= of.floor->distance(w.origin) / of.floor->normal().dot(w.up) * w.up;
    if (of.ceiling)
        w.top = of.ceiling->distance(w.origin) / -of.ceiling->normal().dot(w.up);
    else
        w.top = w.v_of(highest);
    return w;
}

/// Whether most rays to a wall cross another one, so that it is outside of the room.
inline bool is_beyond(const wall& w, const wall& other, const gnomon::scan& scan,
                      const scan_noise& noise) {
    std::size_t crossed = 0, all = 0;
    for (const auto i : w.members) {
        const double u = w.u_of(scan.points[i]);
        if (u < w.left || u > w.right) continue;
        ++all;
        const auto c = other.cross(scan, i, noise);
        if (c && c->is_through() && c->u > other.left && c->u < other.right) ++crossed;
    }
    return 2 * crossed > all;
}

/// Whether a larger plane is at about the same place, as a wall is behind its cornice.
inline bool is_part_of(const wall& w, const wall& larger) {
    constexpr double near = 0.3;          // [m]; chosen
    constexpr double least_share = 0.25;  // of its width; chosen
    constexpr double parallel = 0.985;    // the cosine of 10 degrees; chosen
    if (larger.area <= w.area || larger.normal().dot(w.normal()) < parallel) return false;
    const double a = larger.u_of(w.at(w.left, 0.0)), b = larger.u_of(w.at(w.right, 0.0));
    const double overlap =
        std::min(larger.right, std::max(a, b)) - std::max(larger.left, std::min(a, b));
    return std::abs(larger.distance(w.middle())) < near &&
           overlap > least_share * (w.right - w.left);
}

/// The place of the intersection with another wall, along the first one.
inline std::optional<double> corner_of(const wall& w, const wall& other) {
    constexpr double least_sine = 0.5;  // of 30 degrees; chosen
    const double sine = other.normal().dot(w.along);
    if (std::abs(sine) < least_sine) return std::nullopt;
    return -other.distance(w.at(0.0, 0.5 * w.top)) / sine;
}

/// Extends walls to the corners with their neighbors.
inline void find_corners(std::vector<wall>& walls) {
    constexpr double longest_gap = 0.6;  // [m]; chosen: furniture in the corner
    const std::vector<wall> seen = walls;
    for (std::size_t a = 0; a < walls.size(); ++a) {
        for (const bool at_left : {true, false}) {
            double nearest = longest_gap;
            for (std::size_t b = 0; b < walls.size(); ++b) {
                const auto corner = corner_of(seen[a], seen[b]);
                if (!corner) continue;
                const Eigen::Vector3d x = seen[a].at(*corner, 0.5 * seen[a].top);
                // The left end of a wall is at the right end of its neighbor.
                const double own = std::abs(*corner - (at_left ? seen[a].left : seen[a].right));
                const double u = seen[b].u_of(x);
                const double others = std::abs(u - (at_left ? seen[b].right : seen[b].left));
                const double gap = std::max(own, others);
                if (gap >= nearest) continue;
                nearest = gap;
                (at_left ? walls[a].left : walls[a].right) = *corner;
                (at_left ? walls[a].left_neighbor : walls[a].right_neighbor) = b;
            }
        }
    }
}

}  // namespace detail

/// The length of a wall from corner to corner, if it has both. A corner moves with the wall at it,
/// and, unless the angle is right, with the wall itself.
inline std::optional<measured_length> length_of(const room& r, const wall& w) {
    if (!w.left_neighbor || !w.right_neighbor) return std::nullopt;
    double variance = 0.0, own = 0.0;
    for (const bool at_left : {true, false}) {
        const wall& other = r.walls[at_left ? *w.left_neighbor : *w.right_neighbor];
        const Eigen::Vector3d corner = w.at(at_left ? w.left : w.right, 0.5 * w.top);
        const double sine = other.normal().dot(w.along), cosine = other.normal().dot(w.normal());
        variance += other.variance_at(corner) / (sine * sine);
        own += (at_left ? -1.0 : 1.0) * cosine / sine;
    }
    variance += own * own * w.variance_at(w.middle());
    return measured_length{w.right - w.left, std::sqrt(variance)};
}

/// The room around the sensor.
inline room room_of(const gnomon::scan& scan, const flat_parts& all, const scan_noise& noise,
                    const Eigen::Vector3d& up) {
    constexpr double upright = 0.1;        // the sine of 6 degrees; chosen
    constexpr double narrowest = 0.3;      // [m]; chosen
    constexpr double smallest_area = 0.5;  // [m^2]; chosen
    constexpr double facing = -0.9962;     // the cosine of 175 degrees; chosen
    constexpr double least_overlap = 0.5;  // [m]; chosen
    const std::vector<flat_part>& parts = all.planes;
    room r;
    r.up = up;
    r.floor = detail::level_part(scan, parts, up);
    r.ceiling = detail::level_part(scan, parts, -up);
    Eigen::Vector3d highest = scan.points.front();
    for (const Eigen::Vector3d& p : scan.points)
        if (p.allFinite() && !(up.dot(p) <= up.dot(highest))) highest = p;

    std::vector<wall> walls;
    for (const flat_part& part : parts) {
        if (part.normal().isZero() || std::abs(part.normal().dot(up)) > upright ||
            part.area < smallest_area)
            continue;
        wall whole = detail::framed(part, r, highest);
        whole.number = static_cast<std::size_t>(&part - parts.data());
        for (const auto& [left, right] : detail::closed_parts(whole, scan, noise)) {
            if (right - left < narrowest) continue;
            walls.push_back(whole);
            walls.back().left = left, walls.back().right = right;
        }
    }
    const auto leave_out = [](std::vector<wall>& from, auto&& is_out) {
        std::vector<wall> kept;
        std::ranges::copy_if(from, std::back_inserter(kept), [&](const wall& w) {
            return std::ranges::none_of(from, [&](const wall& other) { return is_out(w, other); });
        });
        from = std::move(kept);
    };
    const auto is_outside = [&](const wall& w, const wall& other) {
        return detail::is_beyond(w, other, scan, noise);
    };
    leave_out(walls, is_outside);
    leave_out(walls, detail::is_part_of);
    r.walls = std::move(walls);
    const Eigen::Vector3d viewpoint = scan.viewpoints[0];
    const Eigen::Vector3d first = up.unitOrthogonal(), second = up.cross(first);
    std::ranges::sort(r.walls, std::greater<>{}, [&](const wall& w) {
        const Eigen::Vector3d x = w.middle() - viewpoint;
        return std::atan2(second.dot(x), first.dot(x));
    });
    std::vector<wall> joined = r.walls;
    detail::find_corners(joined);
    constexpr double narrow = 1.0;  // [m]; chosen: without a corner, furniture or a pillar
    for (std::size_t i = joined.size(); i-- > 0;) {
        const bool has_corner = joined[i].left_neighbor || joined[i].right_neighbor;
        if (!has_corner && joined[i].right - joined[i].left < narrow)
            r.walls.erase(r.walls.begin() + static_cast<std::ptrdiff_t>(i));
    }
    detail::find_corners(r.walls);
    for (std::size_t a = 0; a < r.walls.size(); ++a) {
        for (std::size_t b = a + 1; b < r.walls.size(); ++b) {
            const wall &v = r.walls[a], &w = r.walls[b];
            if (v.normal().dot(w.normal()) > facing) continue;
            const double one = v.u_of(w.at(w.left, 0.0)), two = v.u_of(w.at(w.right, 0.0));
            const double overlap =
                std::min(v.right, std::max(one, two)) - std::max(v.left, std::min(one, two));
            if (overlap >= least_overlap) r.opposite.emplace_back(a, b);
        }
    }
    std::ranges::stable_sort(r.opposite, std::greater<>{}, [&](const auto& pair) {
        return r.walls[pair.first].distance(r.walls[pair.second].middle());
    });
    return r;
}

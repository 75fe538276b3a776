// SPDX-License-Identifier: BSL-1.0
/// @file
/// Doors and windows: holes in the outline of a wall through which rays go.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "edge.hpp"
#include "room.hpp"
#include <gnomon/features/alpha_shape.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/gnomon.hpp>

/// An upright rectangle in a wall. An edge without a value is hidden by furniture.
struct wall_opening {
    std::size_t wall = 0;
    bool is_door = false;                                     ///< reaches the floor
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;  ///< a first guess, in the wall [m]
    /// In the order of the guess; that of a door has no bottom.
    std::array<std::optional<measured_length>, 4> edges;

    [[nodiscard]] double middle_u() const { return 0.5 * (left + right); }
    [[nodiscard]] double middle_v() const { return 0.5 * (bottom + top); }
};

namespace detail {

/// The rays that cross a wall, and cells of it.
struct wall_rays {
    std::vector<crossing> rays;
    double spacing = 0.0;  ///< about the distance of rays on the wall [m]

    wall_rays(const wall& w, const gnomon::scan& scan, const flat_parts& parts,
              const scan_noise& noise) {
        constexpr double cell = 0.1;  // [m]; chosen
        std::size_t on = 0;
        std::set<std::pair<int, int>> covered;
        for (std::size_t i = 0; i < scan.size(); ++i) {
            auto c = w.cross(scan, i, noise);
            if (c && parts.plane_of_point[i] != gnomon::unlabeled) {
                const auto plane = static_cast<std::size_t>(parts.plane_of_point[i]);
                (plane == w.number ? c->is_of_wall : c->is_of_other) = true;
            }
            if (!c || c->u < w.left || c->u > w.right || c->v < 0.0 || c->v > w.top) continue;
            rays.push_back(*c);
            if (!c->is_on()) continue;
            ++on;
            covered.emplace(static_cast<int>(std::floor(c->u / cell)),
                            static_cast<int>(std::floor(c->v / cell)));
        }
        spacing =
            on == 0
                ? cell
                : cell * std::sqrt(static_cast<double>(covered.size()) / static_cast<double>(on));
    }
};

/// The outlines of the holes of a wall, in u and v. A frame around the wall closes those that reach
/// its edge, such as doors.
inline std::vector<std::vector<Eigen::Vector2d>> holes_of(const wall& w, const wall_rays& seen) {
    std::vector<Eigen::Vector3d> points;
    for (const crossing& c : seen.rays)
        if (c.is_on()) points.emplace_back(c.u, c.v, 0.0);
    const double step = std::clamp(seen.spacing, 0.01, 0.1);
    for (const double out : {0.0, step}) {  // two rows, as a frame has triangles
        const double l = w.left - out, r = w.right + out, b = -out, t = w.top + out;
        for (double u = l; u < r; u += step)
            points.insert(points.end(), {{u, b, 0.0}, {u, t, 0.0}});
        for (double v = b; v < t; v += step)
            points.insert(points.end(), {{l, v, 0.0}, {r, v, 0.0}});
    }
    std::vector<std::vector<Eigen::Vector2d>> holes;
    const auto shape = gnomon::alpha_shape::of(points, {Eigen::Vector3d::UnitZ(), 0.0});
    for (const auto& polygon : shape.polygons) {
        for (const auto& hole : polygon.holes) {
            auto& corners = holes.emplace_back();
            for (const auto i : hole) corners.emplace_back(points[i].head<2>());
        }
    }
    return holes;
}

/// Whether a point is in a polygon: by the edges that a ray from it to the right crosses.
inline bool is_inside(const std::vector<Eigen::Vector2d>& polygon, double u, double v) {
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const auto &a = polygon[i], &b = polygon[j];
        if ((a.y() > v) != (b.y() > v) &&
            u < (b.x() - a.x()) * (v - a.y()) / (b.y() - a.y()) + a.x())
            inside = !inside;
    }
    return inside;
}

/// The cells of a wall that are open: in a hole, and not hidden by something in front.
class open_cells {
  public:
    using place = std::pair<int, int>;

    open_cells(const wall& w, const wall_rays& seen)
        : cell_(std::max(2.0 * seen.spacing, 0.03)),
          columns_(cells_to(w.right - w.left)),
          rows_(cells_to(w.top)),
          left_(w.left),
          state_(static_cast<std::size_t>(columns_ * rows_), 0) {
        std::map<place, int> before, through;
        for (const crossing& c : seen.rays) {
            const place p{at(c.u - left_), at(c.v)};
            if (c.is_before()) ++before[p];
            if (c.is_through()) ++through[p];
        }
        for (const auto& hole : holes_of(w, seen)) {
            Eigen::Vector2d low = hole.front(), high = low;
            for (const auto& corner : hole)
                low = low.cwiseMin(corner), high = high.cwiseMax(corner);
            for (int i = std::max(at(low.x() - left_), 0);
                 i <= std::min(at(high.x() - left_), columns_ - 1); ++i) {
                for (int j = std::max(at(low.y()), 0); j <= std::min(at(high.y()), rows_ - 1);
                     ++j) {
                    if (!is_inside(hole, u_of(i), v_of(j))) continue;
                    const auto count = [&](const auto& map) {
                        const auto found = map.find({i, j});
                        return found == map.end() ? 0 : found->second;
                    };
                    if (count(through) >= count(before)) state(i, j) = 1;
                }
            }
        }
        open_up();
    }

    [[nodiscard]] double size() const { return cell_; }
    [[nodiscard]] double u_of(int i) const { return left_ + cell_ * (i + 0.5); }
    [[nodiscard]] double v_of(int j) const { return cell_ * (j + 0.5); }

    /// The connected groups of open cells.
    [[nodiscard]] std::vector<std::vector<place>> groups() {
        std::vector<std::vector<place>> result;
        for (int i = 0; i < columns_; ++i) {
            for (int j = 0; j < rows_; ++j) {
                if (state(i, j) != 1) continue;
                std::vector<place> group{{i, j}};
                state(i, j) = 2;
                for (std::size_t k = 0; k < group.size(); ++k) {
                    const auto [x, y] = group[k];
                    for (const auto& [a, b] :
                         {place{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
                        if (!is_open(a, b)) continue;
                        state(a, b) = 2;
                        group.emplace_back(a, b);
                    }
                }
                result.push_back(std::move(group));
            }
        }
        return result;
    }

  private:
    [[nodiscard]] int at(double x) const { return static_cast<int>(std::floor(x / cell_)); }
    [[nodiscard]] int cells_to(double x) const { return std::max(at(x) + 1, 1); }
    [[nodiscard]] char& state(int i, int j) {
        return state_[static_cast<std::size_t>(j * columns_ + i)];
    }
    [[nodiscard]] bool is_open(int i, int j) {
        return i >= 0 && j >= 0 && i < columns_ && j < rows_ && state(i, j) == 1;
    }

    /// The morphological opening by squares of 2 by 2 cells, which cuts narrow connections.
    void open_up() {
        std::vector<char> kept(state_.size(), 0);
        for (int i = 0; i + 1 < columns_; ++i) {
            for (int j = 0; j + 1 < rows_; ++j) {
                if (!is_open(i, j) || !is_open(i + 1, j) || !is_open(i, j + 1) ||
                    !is_open(i + 1, j + 1))
                    continue;
                for (const int x : {i, i + 1})
                    for (const int y : {j, j + 1})
                        kept[static_cast<std::size_t>(y * columns_ + x)] = 1;
            }
        }
        state_ = std::move(kept);
    }

    double cell_;
    int columns_, rows_;
    double left_;
    std::vector<char> state_;
};

/// The rectangle of a group of open cells, if that fills most of it and is upright.
inline std::optional<wall_opening> rectangle_of(const std::vector<open_cells::place>& group,
                                                const open_cells& cells) {
    constexpr double least_filled = 0.7;  // chosen
    constexpr double smallest = 0.25;     // [m]; chosen
    std::vector<Eigen::Vector3d> corners;
    const double half = 0.5 * cells.size();
    std::map<int, int> columns, rows;
    for (const auto& [i, j] : group) {
        ++columns[i], ++rows[j];
        for (const double du : {-half, half})
            for (const double dv : {-half, half})
                corners.emplace_back(cells.u_of(i) + du, cells.v_of(j) + dv, 0.0);
    }
    const auto outline = gnomon::convex_polygon::of(corners, {Eigen::Vector3d::UnitZ(), 0.0});
    const gnomon::oriented_box box = gnomon::minimum_area_rectangle(outline);
    const double area = cells.size() * cells.size() * static_cast<double>(group.size());
    if (box.lengths[1] < smallest || area < least_filled * box.lengths[0] * box.lengths[1])
        return std::nullopt;
    // Columns and rows that are half as full as the fullest.
    const auto ends_of = [](const std::map<int, int>& counts) {
        int fullest = 0;
        for (const auto& [k, n] : counts) fullest = std::max(fullest, n);
        std::pair<int, int> ends{counts.rbegin()->first, counts.begin()->first};
        for (const auto& [k, n] : counts) {
            if (2 * n < fullest) continue;
            ends = {std::min(ends.first, k), std::max(ends.second, k)};
        }
        return ends;
    };
    const auto [left, right] = ends_of(columns);
    const auto [bottom, top] = ends_of(rows);
    wall_opening o;
    o.left = cells.u_of(left) - half, o.right = cells.u_of(right) + half;
    o.bottom = cells.v_of(bottom) - half, o.top = cells.v_of(top) + half;
    if (std::min(o.right - o.left, o.top - o.bottom) < smallest) return std::nullopt;
    return o;
}

/// An edge of an opening, from the rays of the middle of its length.
/// @param side  0 to 3 for left, right, bottom and top
inline std::optional<measured_length> edge_of(const wall_opening& o, std::size_t side,
                                              const wall_rays& seen, double reach) {
    const bool is_upright = side < 2;
    const double guess = std::array{o.left, o.right, o.bottom, o.top}[side];
    const double inwards = side % 2 == 0 ? 1.0 : -1.0;
    const double begin = is_upright ? o.bottom : o.left, end = is_upright ? o.top : o.right;
    const double size = is_upright ? o.right - o.left : o.top - o.bottom;
    constexpr double window = 0.3;  // [m]; chosen
    const double margin = std::max(0.1 * (end - begin), std::min(reach, 0.3 * (end - begin)));
    std::vector<edge_ray> rays;
    int before = 0, others = 0;
    for (const crossing& c : seen.rays) {
        const double across = is_upright ? c.u : c.v, lengthwise = is_upright ? c.v : c.u;
        if (lengthwise < begin + margin || lengthwise > end - margin) continue;
        const double w = inwards * (across - guess);
        if (std::abs(w) < reach) ++(c.is_before() ? before : others);
        if (c.is_before() || w > 0.5 * size) continue;
        const double slope = is_upright ? c.slope_v : c.slope_u;
        rays.push_back({w, c.depth, c.sigma, inwards * (is_upright ? c.slope_u : c.slope_v),
                        slope == 0.0 ? std::numeric_limits<double>::infinity()
                                     : ((slope > 0.0 ? end : begin) - lengthwise) / slope});
    }
    detail::level_out(rays, window);
    constexpr int most_hidden = 5;  // of five rays next to the edge, one; chosen
    auto edge = edge_near(rays, reach, most_hidden * before > others);
    if (edge) edge->value = guess + inwards * edge->value;
    return edge;
}

}  // namespace detail

/// The openings of a wall, from left to right.
inline std::vector<wall_opening> openings_of(const room& r, std::size_t number,
                                             const gnomon::scan& scan, const flat_parts& parts,
                                             const scan_noise& noise) {
    constexpr std::size_t fewest_through = 20;  // rays; chosen
    constexpr double least_certain = 0.05;      // [m]; chosen: a standard deviation
    constexpr double threshold = 0.2;           // [m]; chosen: a door has no higher one
    constexpr double highest_guess = 0.4;       // [m]; chosen: the floor is hidden by furniture
    const wall& w = r.walls[number];
    const detail::wall_rays seen(w, scan, parts, noise);
    detail::open_cells cells(w, seen);
    const double reach = std::max(0.15, 2.0 * cells.size());
    std::vector<wall_opening> openings;
    for (const auto& group : cells.groups()) {
        auto o = detail::rectangle_of(group, cells);
        if (!o) continue;
        const auto through = std::ranges::count_if(seen.rays, [&](const crossing& c) {
            return c.is_through() && c.u > o->left && c.u < o->right && c.v > o->bottom &&
                   c.v < o->top;
        });
        if (static_cast<std::size_t>(through) < fewest_through) continue;
        o->wall = number;
        for (std::size_t side = 0; side < 4; ++side) {
            auto& edge = o->edges[side];
            edge = detail::edge_of(*o, side, seen, reach);
            if (edge && edge->sigma > least_certain) edge.reset();
        }
        const auto& bottom = o->edges[2];
        o->is_door = r.floor && o->bottom < highest_guess &&
                     !(bottom && bottom->value - 3.0 * bottom->sigma > threshold);
        if (o->is_door) o->edges[2].reset();
        const auto& [left, right, low, top] = o->edges;
        if (!(left && right) && !((low || o->is_door) && top)) continue;  // not seen well enough
        openings.push_back(*o);
    }
    std::ranges::sort(openings, {}, &wall_opening::left);
    return openings;
}

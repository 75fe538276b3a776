// SPDX-License-Identifier: BSL-1.0
/// @file
/// The floor plan of a room: walls with their openings and lengths, over a slice of the scan.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "picture/image.hpp"
#include "picture/palette.hpp"
#include "survey.hpp"
#include <gnomon/gnomon.hpp>

/// A length as on a drawing: "4.213 m", and its standard deviation in millimetres.
inline std::string text_of(const measured_length& l) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3f m \u00b1 %.1f mm", l.value, 1e3 * l.sigma);
    return text;
}

/// A drawing from above, the longest wall horizontal.
class floor_plan {
  public:
    floor_plan(const gnomon::scan& scan, const survey& s) : survey_(s), sheet_(width, height) {
        set_frame();
        draw_slice(scan);
        for (const wall& w : s.planes.walls) draw_wall(w);
        for (const auto& o : s.openings) draw_opening(o);
        draw_distances();
        const auto [x, y] = pixel(scan.viewpoints[0]);
        sheet_.fill(x - 5, y - 1, x + 6, y + 2, sensor);
        sheet_.fill(x - 1, y - 5, x + 2, y + 6, sensor);
        write_lengths();
        draw_scale_and_height();
    }

    [[nodiscard]] std::string png() const { return sheet_.png(); }

  private:
    using pixel_place = std::pair<int, int>;
    struct box {
        int x0, y0, x1, y1;
    };

    [[nodiscard]] bool is_written(const box& b) const {
        return std::ranges::any_of(written_, [&](const box& o) {
            return b.x0 < o.x1 + 6 && o.x0 < b.x1 + 6 && b.y0 < o.y1 + 2 && o.y0 < b.y1 + 2;
        });
    }

    static constexpr int width = 1500, height = 1200, margin = 240;
    static constexpr picture::color cloud{205, 208, 214}, sensor{214, 65, 70}, door{40, 140, 90},
        window{66, 133, 200}, dimension{110, 112, 120};

    void set_frame() {
        const room& r = survey_.planes;
        const auto longest =
            std::ranges::max_element(r.walls, {}, [](const wall& w) { return w.right - w.left; });
        up_ = r.floor ? r.floor->normal() : r.up;
        x_ = longest->along;
        y_ = up_.cross(x_);
        Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
        Eigen::Vector2d high = -low;
        for (const wall& w : r.walls) {
            for (const double u : {w.left, w.right}) {
                const Eigen::Vector3d p = w.at(u, 0.0);
                const Eigen::Vector2d q(x_.dot(p), y_.dot(p));
                low = low.cwiseMin(q), high = high.cwiseMax(q);
            }
        }
        middle_ = 0.5 * (low + high);
        scale_ = std::min((width - 2 * margin) / (high - low).x(),
                          (height - 2 * margin) / (high - low).y());
    }

    [[nodiscard]] pixel_place pixel(const Eigen::Vector3d& p) const {
        return {static_cast<int>(std::lround(0.5 * width + scale_ * (x_.dot(p) - middle_.x()))),
                static_cast<int>(std::lround(0.5 * height - scale_ * (y_.dot(p) - middle_.y())))};
    }

    void draw_slice(const gnomon::scan& scan) {
        constexpr double low = 0.8, high = 1.8;  // [m]
        for (const Eigen::Vector3d& p : scan.points) {
            const double h = p.allFinite() ? survey_.planes.height_of(p) : -1.0;
            if (survey_.planes.floor && (h < low || h > high)) continue;
            const auto [x, y] = pixel(p);
            sheet_.fill(x, y, x + 2, y + 2, cloud);
        }
    }

    void draw_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const picture::color& c,
                   int thickness) {
        const auto [x0, y0] = pixel(from);
        const auto [x1, y1] = pixel(to);
        const int steps = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
        for (int k = 0; k <= steps; ++k) {
            const int x = x0 + (x1 - x0) * k / steps - thickness / 2;
            const int y = y0 + (y1 - y0) * k / steps - thickness / 2;
            sheet_.fill(x, y, x + thickness, y + thickness, c);
        }
    }

    /// Lines of text at a place, on white, moved in the direction `away`, where they are free.
    void write(const Eigen::Vector3d& at, const Eigen::Vector3d& away,
               const std::vector<std::string>& lines, const picture::color& c) {
        constexpr int line_height = 26, gap = 16;
        auto [x, y] = pixel(at);
        int w = 0;
        for (const std::string& line : lines) w = std::max(w, picture::image::width_of(line));
        const int h = line_height * static_cast<int>(lines.size());
        const double dx = x_.dot(away), dy = -y_.dot(away);  // of unit length, or 0
        x += static_cast<int>(dx * (0.5 * w + gap)), y += static_cast<int>(dy * (0.5 * h + gap));
        box text{x - w / 2, y - h / 2, x - w / 2 + w, y - h / 2 + h};
        // Moved on in the same direction, or down, until nothing else is written there.
        const int step_x = static_cast<int>(std::lround(8.0 * dx));
        const int step_y = away.isZero() ? 8 : static_cast<int>(std::lround(8.0 * dy));
        for (int k = 0; k < 60 && is_written(text); ++k)
            text = {text.x0 + step_x, text.y0 + step_y, text.x1 + step_x, text.y1 + step_y};
        written_.push_back(text);
        sheet_.fill(text.x0 - 3, text.y0 - 3, text.x1 + 3, text.y1 - 3, picture::white);
        for (std::size_t k = 0; k < lines.size(); ++k)
            sheet_.write(text.x0, text.y0 + line_height * static_cast<int>(k), lines[k], c);
    }

    void draw_wall(const wall& w) {
        draw_line(w.at(w.left, 0.0), w.at(w.right, 0.0), picture::ink, 7);
    }

    void draw_opening(const survey::named_opening& o) {
        const wall& w = survey_.planes.walls[o.wall];
        const auto [left, right] = ends_of(o);
        const picture::color& c = o.is_door ? door : window;
        draw_line(w.at(left, 0.0), w.at(right, 0.0), picture::white, 9);
        draw_line(w.at(left, 0.0), w.at(right, 0.0), c, o.is_door ? 1 : 3);
        const Eigen::Vector3d across = 0.06 * w.normal();
        for (const double u : {left, right})
            draw_line(w.at(u, 0.0) - across, w.at(u, 0.0) + across, c, 3);
    }

    [[nodiscard]] static std::pair<double, double> ends_of(const wall_opening& o) {
        return {o.edges[0] ? o.edges[0]->value : o.left, o.edges[1] ? o.edges[1]->value : o.right};
    }

    void draw_distances() {
        const room& r = survey_.planes;
        for (std::size_t i = 0; i < r.opposite.size(); ++i) {
            const wall &a = r.walls[r.opposite[i].first], &b = r.walls[r.opposite[i].second];
            const Eigen::Vector3d place = detail::between(a, b);
            draw_line(place - a.distance(place) * a.normal(),
                      place - b.distance(place) * b.normal(), dimension, 1);
        }
    }

    /// The lengths inside and outside of the walls, after all lines.
    void write_lengths() {
        const room& r = survey_.planes;
        for (const auto& o : survey_.openings) {
            std::vector<std::string> lines{o.name};
            for (const survey_length& l : survey_.lengths)
                if (l.kind == "opening" && l.name.starts_with(o.name + " "))
                    lines.push_back(l.name.substr(o.name.size() + 1) + " " + text_of(l.length));
            const wall& w = r.walls[o.wall];
            const auto [left, right] = ends_of(o);
            write(w.at(0.5 * (left + right), 0.0), w.normal(), lines, o.is_door ? door : window);
        }
        for (std::size_t i = 0; i < r.walls.size(); ++i) {
            const auto length = length_of(r, r.walls[i]);
            std::vector<std::string> lines{"wall " + std::to_string(i + 1)};
            if (length) lines.push_back(text_of(*length));
            write(r.walls[i].middle(), -r.walls[i].normal(), lines, picture::ink);
        }
        for (std::size_t i = 0; i < r.opposite.size(); ++i) {
            const wall &a = r.walls[r.opposite[i].first], &b = r.walls[r.opposite[i].second];
            const Eigen::Vector3d place = detail::between(a, b);
            const Eigen::Vector3d from = place - a.distance(place) * a.normal();
            const Eigen::Vector3d to = place - b.distance(place) * b.normal();
            write(from + (i % 2 == 0 ? 0.35 : 0.65) * (to - from), Eigen::Vector3d::Zero(),
                  {text_of(distance_between(a, b, place))}, dimension);
        }
    }

    void draw_scale_and_height() {
        const int metre = static_cast<int>(scale_);
        sheet_.fill(40, height - 40, 40 + metre, height - 34, picture::ink);
        sheet_.write(48, height - 62, "1 m");
        int x = 40 + metre + 40;
        for (const survey_length& l : survey_.lengths) {
            if (l.name == "height") sheet_.write(x, height - 46, "height " + text_of(l.length));
        }
        sheet_.write(40, 20, "floor plan; grey: points 0.8 to 1.8 m above the floor; red: sensor");
    }

    const survey& survey_;
    picture::image sheet_;
    std::vector<box> written_;
    Eigen::Vector3d up_, x_, y_;
    Eigen::Vector2d middle_;
    double scale_ = 1.0;  // [pixels / m]
};

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

#include <Eigen/Core>

#include "picture/image.hpp"
#include "picture/palette.hpp"
#include "survey.hpp"
#include <gnomon/gnomon.hpp>

/// A length as on a drawing: "4.213 m", and its standard deviation in millimetres.
inline std::string text_of(const measured_length& l) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3f m +-%.1f mm", l.value, 1e3 * l.sigma);
    return text;
}

/// A drawing from above, the longest wall horizontal.
class floor_plan {
  public:
    floor_plan(const gnomon::scan& scan, const survey& s) : survey_(s), sheet_(width, height) {
        set_frame();
        draw_slice(scan);
        for (std::size_t i = 0; i < s.planes.walls.size(); ++i) draw_wall(s.planes.walls[i], i);
        for (const auto& o : s.openings) draw_opening(o);
        draw_distances();
        const auto [x, y] = pixel(scan.viewpoints[0]);
        sheet_.fill(x - 5, y - 1, x + 6, y + 2, sensor);
        sheet_.fill(x - 1, y - 5, x + 2, y + 6, sensor);
        draw_scale_and_height();
    }

    [[nodiscard]] std::string png() const { return sheet_.png(); }

  private:
    using pixel_place = std::pair<int, int>;

    static constexpr int width = 1400, height = 1100, margin = 150;
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

    /// Text about a place, on white.
    void write(const Eigen::Vector3d& at, double away_x, double away_y, const std::string& text,
               const picture::color& c, int line = 0) {
        const auto [x, y] = pixel(at);
        const int w = picture::image::width_of(text);
        // Beside upright walls, above and below level ones.
        int left = x - w / 2 + static_cast<int>(away_x * (0.5 * w + 16));
        int top = y - 8 - static_cast<int>(away_y * 30.0) + 20 * line;
        left = std::clamp(left, 4, width - w - 4), top = std::clamp(top, 4, height - 24);
        sheet_.fill(left - 3, top - 3, left + w + 3, top + 17, picture::white);
        sheet_.write(left, top, text, c);
    }

    void draw_wall(const wall& w, std::size_t number) {
        draw_line(w.at(w.left, 0.0), w.at(w.right, 0.0), picture::ink, 7);
        const auto length = length_of(survey_.planes, w);
        std::string text = std::to_string(number + 1);
        if (length) text += ": " + text_of(*length);
        const Eigen::Vector3d n = w.normal();
        write(w.middle(), -x_.dot(n), -y_.dot(n), text, picture::ink, 0);
    }

    void draw_opening(const survey::named_opening& o) {
        const wall& w = survey_.planes.walls[o.wall];
        const double left = o.edges[0] ? o.edges[0]->value : o.left;
        const double right = o.edges[1] ? o.edges[1]->value : o.right;
        const picture::color& c = o.is_door ? door : window;
        draw_line(w.at(left, 0.0), w.at(right, 0.0), picture::white, 9);
        draw_line(w.at(left, 0.0), w.at(right, 0.0), c, o.is_door ? 1 : 3);
        const Eigen::Vector3d across = 0.06 * w.normal();
        for (const double u : {left, right})
            draw_line(w.at(u, 0.0) - across, w.at(u, 0.0) + across, c, 3);
        int line = 0;
        const Eigen::Vector3d at = w.at(o.middle_u(), 0.0), n = w.normal();
        write(at, 1.1 * x_.dot(n), 1.1 * y_.dot(n), o.name, c, line++);
        for (const survey_length& l : survey_.lengths) {
            if (l.kind != "opening" || !l.name.starts_with(o.name + " ")) continue;
            const std::string what = l.name.substr(o.name.size() + 1);
            write(at, 1.1 * x_.dot(n), 1.1 * y_.dot(n), what + " " + text_of(l.length), c, line++);
        }
    }

    void draw_distances() {
        const room& r = survey_.planes;
        for (std::size_t i = 0; i < r.opposite.size(); ++i) {
            const wall &a = r.walls[r.opposite[i].first], &b = r.walls[r.opposite[i].second];
            Eigen::Vector3d place = detail::between(a, b);
            const Eigen::Vector3d from = place - a.distance(place) * a.normal();
            const Eigen::Vector3d to = place - b.distance(place) * b.normal();
            draw_line(from, to, dimension, 1);
            const double share = 0.5 + 0.12 * (static_cast<double>(i % 3) - 1.0);
            write(from + share * (to - from), 0.0, 0.0, text_of(distance_between(a, b, place)),
                  dimension);
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
    Eigen::Vector3d up_, x_, y_;
    Eigen::Vector2d middle_;
    double scale_ = 1.0;  // [pixels / m]
};

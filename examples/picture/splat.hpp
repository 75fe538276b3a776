// SPDX-License-Identifier: BSL-1.0
/// @file
/// How do points become surfaces? Each is drawn as a little disc that lies in its surface and just
/// reaches the next one; the nearest wins. Shading by the normal, and a darker rim wherever
/// something stands in front of something else, let shapes be read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "camera.hpp"
#include "disc.hpp"
#include "image.hpp"
#include "palette.hpp"

namespace picture {

/// A point as it is drawn.
struct splat {
    Eigen::Vector3d position;  ///< finite [m]
    Eigen::Vector3d normal;    ///< unit length towards the sensor, or zero
    double radius;             ///< [m]
    std::int32_t label;        ///< of its segment, -1 for none
    color tint = color_of(label);
};

/// A straight line between two places, drawn over all else.
struct stroke {
    Eigen::Vector3d from, to;  ///< finite [m]
    color tint;
};

/// A text at a place, written over all else.
struct inscription {
    Eigen::Vector3d at;  ///< its middle, finite [m]
    std::string text;    ///< UTF-8
    color tint;
};

/// What is drawn of surfaces that turn their back to the camera.
enum class backs { shown, hidden };

/// An image with depth, into which splats are drawn.
class canvas {
  public:
    canvas(int width, int height)
        : colors_(width, height),
          nearness_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0) {}

    /// Draws one splat as `from` sees it; those of unlabeled points are small.
    void draw(const splat& s, const camera& from) {
        const Eigen::Vector3d center = from.axes * (s.position - from.position);
        const Eigen::Vector3d q = from.pixel_of(center);
        if (!(q.z() > 0.0) || !(std::abs(q.x()) < 1e6) || !(std::abs(q.y()) < 1e6)) return;
        const bool is_dot = s.normal.isZero();
        const double smallest = s.label < 0 ? 1.5 : 2.0;  // pixels
        const double largest = s.label < 0 ? 4.0 : 20.0;
        const double pixels = std::clamp(from.focal * s.radius / q.z(), smallest, largest);
        const disc surface(center, from.axes * s.normal, pixels * q.z() / from.focal);
        // In steps, so that surfaces look smooth although their normals are noisy.
        const double facing = std::round(12.0 * std::abs(surface.cosine())) / 12.0;
        const double light = is_dot ? 0.8 : 0.55 + 0.45 * facing;
        const color c = mixed(color{}, s.tint, light);

        const int y0 = std::max(0, static_cast<int>(std::ceil(q.y() - pixels)));
        const int y1 = std::min(colors_.height() - 1, static_cast<int>(std::floor(q.y() + pixels)));
        for (int y = y0; y <= y1; ++y) {
            const disc::row row(surface, (y - from.center_y) / from.focal);
            // The dot in the middle, and what the disc covers, with a pixel for rounding.
            double left = q.x() - smallest, right = q.x() + smallest;
            if (const auto ends = row.ends(); !is_dot && ends) {
                left = std::min(left, from.center_x + from.focal * (*ends)[0] - 1.0);
                right = std::max(right, from.center_x + from.focal * (*ends)[1] + 1.0);
            } else if (!is_dot) {
                left = q.x() - pixels, right = q.x() + pixels;
            }
            const int x0 = std::max(0, static_cast<int>(std::ceil(std::max(left, q.x() - pixels))));
            const int x1 = std::min(colors_.width() - 1,
                                    static_cast<int>(std::floor(std::min(right, q.x() + pixels))));
            const double dy = y - q.y();
            for (int x = x0; x <= x1; ++x) {
                double near = 1.0 / q.z();
                const double dx = x - q.x();
                if (dx * dx + dy * dy > smallest * smallest) {
                    const double u = (x - from.center_x) / from.focal;
                    if (is_dot || !row.is_met(u)) continue;
                    near = row.nearness(u);
                }
                double& nearest = nearness_[index(x, y)];
                if (near > nearest) {
                    nearest = near;
                    colors_.at(x, y) = c;
                }
            }
        }
    }

    /// Draws one stroke as `from` sees it, whatever is in front of it.
    void draw(const stroke& line, const camera& from) {
        const Eigen::Vector3d a = from.project(line.from), b = from.project(line.to);
        if (!(a.z() > 0.0 && b.z() > 0.0)) return;
        const Eigen::Vector2d start = a.head<2>(), way = b.head<2>() - start;
        if (!(start.norm() < 1e6 && way.norm() < 1e6)) return;
        const int steps = 1 + static_cast<int>(way.norm());
        for (int s = 0; s <= steps; ++s) {
            const Eigen::Vector2d at = start + static_cast<double>(s) / steps * way;
            const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
            for (int dy = 0; dy < 3; ++dy) {
                for (int dx = 0; dx < 3; ++dx) {
                    if (x + dx < 0 || x + dx >= colors_.width()) continue;
                    if (y + dy < 0 || y + dy >= colors_.height()) continue;
                    colors_.at(x + dx, y + dy) = line.tint;
                }
            }
        }
    }

    /// Darkens what lies behind its neighbors in the picture (eye-dome lighting, Boucheny 2009).
    void darken_steps() {
        constexpr int distance = 2;      // pixels
        constexpr double noise = 0.012;  // of the depth: no step
        constexpr double most = 0.05;
        constexpr double strength = 6.0;
        std::vector<double> log_depth = nearness_;
        for (double& depth : log_depth) depth = -std::log(depth);
        for (int y = 0; y < colors_.height(); ++y) {
            for (int x = 0; x < colors_.width(); ++x) {
                const double own = log_depth[index(x, y)];
                if (std::isinf(own)) continue;
                double behind = 0.0;
                for (const int dy : {-distance, 0, distance}) {
                    for (const int dx : {-distance, 0, distance}) {
                        if (x + dx < 0 || x + dx >= colors_.width()) continue;
                        if (y + dy < 0 || y + dy >= colors_.height()) continue;
                        const double step = own - log_depth[index(x + dx, y + dy)];
                        behind += std::clamp(step - noise, 0.0, most);
                    }
                }
                if (behind > 0.0) {
                    color& c = colors_.at(x, y);
                    c = mixed(color{}, c, std::exp(-strength * behind));
                }
            }
        }
    }

    /// The image at half its size, four pixels becoming one.
    [[nodiscard]] image halved() const {
        image half(colors_.width() / 2, colors_.height() / 2);
        for (int y = 0; y < half.height(); ++y) {
            for (int x = 0; x < half.width(); ++x) {
                half.at(x, y) = mixed(
                    mixed(colors_.at(2 * x, 2 * y), colors_.at(2 * x + 1, 2 * y), 0.5),
                    mixed(colors_.at(2 * x, 2 * y + 1), colors_.at(2 * x + 1, 2 * y + 1), 0.5),
                    0.5);
            }
        }
        return half;
    }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(colors_.width()) +
               static_cast<std::size_t>(x);
    }

    image colors_;
    std::vector<double> nearness_;  ///< 1 / depth of each pixel [1/m]; 0 where nothing is drawn
};

/// Writes a text on white where a camera sees its place, further down where others are.
/// @param taken  upper left corners and widths of the texts so far
inline void write(image& drawing, const inscription& text, const camera& from,
                  std::vector<std::array<int, 3>>& taken) {
    const Eigen::Vector3d q = from.project(text.at);
    const bool is_inside =
        q.x() >= 0.0 && q.x() < drawing.width() && q.y() >= 0.0 && q.y() < drawing.height();
    if (!(q.z() > 0.0) || !is_inside) return;
    constexpr int line = 24;  // pixels
    const int width = image::width_of(text.text);
    const int x =
        std::clamp(static_cast<int>(q.x()) - width / 2, 0, std::max(0, drawing.width() - width));
    int y = std::clamp(static_cast<int>(q.y()) - line / 2, 0, drawing.height() - line);
    const auto is_taken = [&](const std::array<int, 3>& t) {
        return x < t[0] + t[2] + 6 && t[0] < x + width + 6 && std::abs(y - t[1]) < line;
    };
    while (std::ranges::any_of(taken, is_taken) && y + 2 * line < drawing.height()) y += 4;
    taken.push_back({x, y, width});
    drawing.fill(x - 3, y - 3, x + width + 3, y + line - 3, white);
    drawing.write(x, y, text.text, text.tint);
}

/// Lines and texts over a picture.
struct overlay {
    std::vector<stroke> strokes;
    std::vector<inscription> texts;
};

/// Splats, and strokes and texts over them, as `from` sees them, `width` x `height` pixels; the
/// points of segments fill it.
[[nodiscard]] inline image drawn(const std::vector<splat>& splats, const overlay& over, camera from,
                                 int width, int height, backs back) {
    const auto hidden = [&](const splat& s) {
        return back == backs::hidden && s.normal.dot(from.position - s.position) < 0.0;
    };
    std::vector<Eigen::Vector3d> all;
    std::vector<Eigen::Vector3d> important;
    for (const splat& s : splats) {
        if (hidden(s)) continue;
        all.push_back(s.position);
        if (s.label >= 0) important.push_back(s.position);
    }
    canvas large(2 * width, 2 * height);  // drawn twice as large, for smooth edges
    frame(from, 4 * important.size() > all.size() ? important : all, 2 * width, 2 * height);
    for (const splat& s : splats) {
        if (!hidden(s)) large.draw(s, from);
    }
    large.darken_steps();
    for (const stroke& s : over.strokes) large.draw(s, from);
    image half = large.halved();
    from.focal *= 0.5, from.center_x *= 0.5, from.center_y *= 0.5;
    std::vector<std::array<int, 3>> taken;
    for (const inscription& text : over.texts) write(half, text, from, taken);
    return half;
}

}  // namespace picture

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a sensor saw towards a place: a range image for each of its view points, be it one, one for
/// each of several scans, or one for each scan line of a sensor that moves. So places are asked
/// for, not pixels of one image, and gaps between points are walked in space.
///
/// Klasing 2010, Sec. 4.3.5, with the depth of the line at each pixel's ray instead of an
/// interpolated one (specification of it, A19, F12).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/range_image.hpp>

namespace gnomon {

/// How range images are made, and when a range differs.
struct sight_options {
    angle pixel = radians(0);  ///< of the images; 0 stands for the spacing of the rays
    std::optional<Eigen::Vector3d> pole = std::nullopt;  ///< as in `range_image_format`
    double sigma = 0.015;  ///< standard deviation of ranges [m]; three of them are no difference
};

/// How often something was seen, by kind of sighting.
struct sighting_count {
    std::array<std::size_t, 4> of{};

    [[nodiscard]] std::size_t operator[](sighting s) const {
        return of[static_cast<std::size_t>(s)];
    }
    void add(sighting s) { ++of[static_cast<std::size_t>(s)]; }
    [[nodiscard]] std::size_t total() const { return of[0] + of[1] + of[2] + of[3]; }
};

/// The spacing of the rays of a cloud [rad]: the side of the square of directions that each of the
/// 16 nearest rays has for itself, for three of four rays at least that. From 24 rays; O(n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] angle ray_spacing(const R& points, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    const viewpoint_table viewpoints = viewpoints_of(points);
    std::vector<Eigen::Vector3d> directions;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!is_finite(p[i]) || !is_finite(viewpoints[i])) continue;
        const Eigen::Vector3d d = detail::difference(p[i], viewpoints[i]);
        const double length = std::sqrt(detail::dot(d, d));
        if (length > 0.0) directions.emplace_back(d[0] / length, d[1] / length, d[2] / length);
    }
    constexpr std::size_t rays = 24, neighbors = 16;
    const double least = std::numbers::pi / 3600, most = std::numbers::pi / 36;
    if (directions.size() <= neighbors) return radians(most);
    std::vector<point_index> all(directions.size());
    std::iota(all.begin(), all.end(), point_index{0});
    std::vector<double> squared;
    for (std::size_t r = 0; r < rays; ++r) {
        const std::size_t seed = (2 * r + 1) * directions.size() / (2 * rays);
        const auto nearest = detail::nearest_of(directions, all, directions[seed], neighbors + 1);
        squared.push_back(nearest.back().squared_distance);
    }
    std::nth_element(squared.begin(), squared.begin() + rays * 3 / 4, squared.end());
    const double side = std::sqrt(squared[rays * 3 / 4] * std::numbers::pi / neighbors);
    return radians(std::clamp(side, least, most));
}

/// Knows what was seen towards any place.
class lines_of_sight {
  public:
    /// What a whole cloud tells: also of points that belong to nothing, such as floor and ceiling
    /// that were left out before segmentation. The view points are those of the range, or else the
    /// origin. O(n log n) in the view points, and a range image for each.
    /// @throws std::invalid_argument  for a negative or NaN sigma, an angle of a pixel that is
    ///                                negative or more than 90 degrees, or a pole of no length
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    explicit lines_of_sight(const R& points, const sight_options& options = {},
                            Proj projection = {})
        : sigma_(options.sigma), viewpoints_(viewpoints_of(points)) {
        detail::require(options.sigma >= 0.0, "lines_of_sight: sigma must not be negative or NaN");
        detail::require(
            options.pixel.radians() >= 0.0 && options.pixel.radians() <= 0.5 * std::numbers::pi,
            "lines_of_sight: a pixel has between 0 and 90 degrees");
        const angle pixel =
            options.pixel.radians() > 0.0 ? options.pixel : ray_spacing(points, projection);
        const auto height =
            static_cast<std::size_t>(std::max(1.0, std::round(std::numbers::pi / pixel.radians())));
        pixel_ = std::numbers::pi / static_cast<double>(height);
        const range_image_format format{2 * height, height, options.pole};

        const position_view<R, Proj> p(points, projection);
        const auto key_of = [](const Eigen::Vector3d& v) {
            return std::array<double, 3>{v[0], v[1], v[2]};
        };
        std::vector<std::array<double, 3>> places;
        for (const Eigen::Vector3d& v : viewpoints_.positions())
            if (is_finite(v)) places.push_back(key_of(v));
        if (viewpoints_.empty()) places.push_back({0.0, 0.0, 0.0});
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());

        std::vector<std::vector<Eigen::Vector3d>> seen(places.size());
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Eigen::Vector3d v = viewpoints_[i];
            if (!is_finite(p[i]) || !is_finite(v)) continue;
            const auto place = std::lower_bound(places.begin(), places.end(), key_of(v));
            seen[static_cast<std::size_t>(place - places.begin())].push_back(p[i]);
        }
        for (std::size_t v = 0; v < places.size(); ++v) {
            if (seen[v].empty()) continue;
            const auto& [x, y, z] = places[v];
            images_.emplace_back(seen[v], Eigen::Vector3d(x, y, z), format);
        }
    }

    /// The images, one for each view point.
    [[nodiscard]] const std::vector<range_image>& images() const { return images_; }
    /// The angle of a pixel.
    [[nodiscard]] angle pixel() const { return radians(pixel_); }

    /// What was seen towards a place, by most view points that saw anything there; of equally many
    /// what speaks against a surface.
    [[nodiscard]] sighting towards(const Eigen::Vector3d& place) const {
        sighting_count count;
        for (const range_image& image : images_) count.add(towards(place, image));
        sighting most = sighting::unseen;
        std::size_t votes = 0;
        for (const sighting s : {sighting::farther, sighting::level, sighting::closer}) {
            if (count[s] > votes) {
                most = s;
                votes = count[s];
            }
        }
        return most;
    }

    /// What was seen along the straight line between two places, as `viewpoint` sees it: at steps
    /// of a pixel, the ends left out.
    [[nodiscard]] sighting_count between(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                         const Eigen::Vector3d& viewpoint) const {
        const Eigen::Vector3d to_p = detail::difference(p, viewpoint);
        const Eigen::Vector3d to_q = detail::difference(q, viewpoint);
        const Eigen::Vector3d across = detail::cross(to_p, to_q);
        const double angle =
            std::atan2(std::sqrt(detail::dot(across, across)), detail::dot(to_p, to_q));
        const double near = std::sqrt(detail::dot(to_p, to_p));
        const double far = std::sqrt(detail::dot(to_q, to_q));
        sighting_count count;
        if (!std::isfinite(angle)) return count;
        const auto steps = static_cast<std::size_t>(std::ceil(angle / pixel_));
        for (std::size_t s = 1; s < steps; ++s) {
            const double turned = angle * static_cast<double>(s) / static_cast<double>(steps);
            // Where the ray that is turned by so much meets the line, by the law of sines.
            const double a = near * std::sin(turned), b = far * std::sin(angle - turned);
            count.add(towards(detail::combined(b / (a + b), p, a / (a + b), q)));
        }
        return count;
    }

  private:
    /// What one view point has seen there.
    [[nodiscard]] sighting towards(const Eigen::Vector3d& place, const range_image& image) const {
        const double expected = image.distance_to(place);
        if (!std::isfinite(expected) || !image.may_show(place)) return sighting::unseen;
        const double margin = 3.0 * sigma_ + expected * pixel_;
        const auto told_by = [&](const range_image::pixel& at) {
            const double range = image.range(at);
            if (range < 0.0) return sighting::unseen;
            if (range < expected - margin) return sighting::closer;
            return range > expected + margin ? sighting::farther : sighting::level;
        };
        const range_image::pixel at = image.pixel_of(place);
        const sighting here = told_by(at);
        if (here != sighting::unseen) return here;
        // Rays are not spaced as evenly as pixels: what all pixels about it tell holds here, too.
        // At an edge of what is in front of a surface some tell of that, and some of the surface:
        // the place is not empty, nor certainly hidden.
        sighting about = sighting::unseen;
        for (std::size_t e = at.elevation - (at.elevation > 0 ? 1 : 0);
             e <= std::min(at.elevation + 1, image.height() - 1); ++e) {
            for (std::size_t a = at.azimuth + image.width() - 1;
                 a <= at.azimuth + image.width() + 1; ++a) {
                const sighting s = told_by({a % image.width(), e});
                if (s == sighting::unseen) continue;
                if (about == sighting::unseen || s == about) {
                    about = s;
                } else if (s == sighting::farther || about == sighting::farther) {
                    return sighting::unseen;
                } else {
                    about = sighting::level;
                }
            }
        }
        return about;
    }

    double sigma_;
    double pixel_ = 0.0;  // [rad]
    viewpoint_table viewpoints_;
    std::vector<range_image> images_;
};

}  // namespace gnomon

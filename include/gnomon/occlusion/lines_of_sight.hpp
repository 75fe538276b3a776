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
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
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
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/viewpoints.hpp>
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

namespace detail {

/// See ray_spacing.
/// @param p  a position_view
[[nodiscard]] angle spacing_of_rays(const auto& p, const viewpoint_table& viewpoints) {
    constexpr std::size_t seeds = 24, neighbors = 16;
    constexpr double least = std::numbers::pi / 3600, most = std::numbers::pi / 36;
    std::vector<Eigen::Vector3d> directions;
    directions.reserve(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Eigen::Vector3d at = p[i], from = viewpoints[i];
        if (!is_finite(at) || !is_finite(from)) continue;
        const Eigen::Vector3d d = difference(at, from);
        const double range = length(d);
        if (range > 0.0 && std::isfinite(range)) directions.push_back(scaled(1.0 / range, d));
    }
    if (directions.size() <= neighbors) return radians(most);

    // Rays farther from a seed than this need not be looked at: 16 within it are `most` apart. In
    // cubes of more than this size, a ray has the seeds in its own cube and those about it.
    constexpr double reach2 = most * most * neighbors / std::numbers::pi, size = 0.2;
    static_assert(reach2 < size * size);
    constexpr std::size_t cubes = 13;  // along a side, with one more at both ends
    std::vector<std::uint32_t> seeds_about(cubes * cubes * cubes, 0);
    const auto cube_of = [](const Eigen::Vector3d& d) {
        const auto place = [&d](int a) { return static_cast<std::size_t>(d[a] / size + 6.5); };
        return (place(0) * cubes + place(1)) * cubes + place(2);
    };
    const auto seed = [&](std::size_t s) {
        return directions[(2 * s + 1) * directions.size() / (2 * seeds)];
    };
    for (std::size_t s = 0; s < seeds; ++s) {
        for (std::size_t c = 0; c < 27; ++c) {
            const std::size_t way = (c / 9 * cubes + c / 3 % 3) * cubes + c % 3;
            seeds_about[cube_of(seed(s)) + way - (cubes + 1) * cubes - 1] |= 1U << s;
        }
    }
    std::array<std::vector<double>, seeds> near;
    for (const Eigen::Vector3d& d : directions) {
        for (std::uint32_t left = seeds_about[cube_of(d)]; left != 0; left &= left - 1) {
            const auto s = static_cast<std::size_t>(std::countr_zero(left));
            const double squared = squared_distance(seed(s), d);
            if (squared < reach2) near[s].push_back(squared);
        }
    }
    std::array<double, seeds> squared;
    for (std::size_t s = 0; s < seeds; ++s) {
        squared[s] = reach2;
        if (near[s].size() <= neighbors) continue;
        std::nth_element(near[s].begin(), near[s].begin() + neighbors, near[s].end());
        squared[s] = near[s][neighbors];
    }
    std::nth_element(squared.begin(), squared.begin() + seeds * 3 / 4, squared.end());
    const double side = std::sqrt(squared[seeds * 3 / 4] * std::numbers::pi / neighbors);
    return radians(std::clamp(side, least, most));
}

}  // namespace detail

/// The spacing of the rays of a cloud [rad]: the side of the square of directions that each of the
/// 16 nearest rays has for itself, for three of four rays at least that. From 24 rays; O(n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] angle ray_spacing(const R& points, Proj projection = {}) {
    return detail::spacing_of_rays(position_view<R, Proj>(points, std::move(projection)),
                                   viewpoints_of(points));
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
        : sigma_(options.sigma) {
        detail::require(options.sigma >= 0.0, "lines_of_sight: sigma must not be negative or NaN");
        detail::require(
            options.pixel.radians() >= 0.0 && options.pixel.radians() <= 0.5 * std::numbers::pi,
            "lines_of_sight: a pixel has between 0 and 90 degrees");
        const viewpoint_table viewpoints = viewpoints_of(points);
        const position_view<R, Proj> p(points, projection);
        const angle pixel =
            options.pixel.radians() > 0.0 ? options.pixel : detail::spacing_of_rays(p, viewpoints);
        const auto height =
            static_cast<std::size_t>(std::max(1.0, std::round(std::numbers::pi / pixel.radians())));
        pixel_ = std::numbers::pi / static_cast<double>(height);
        const range_image_format format{2 * height, height, options.pole};

        // Points by view point. Those of a scan line follow one another, so that there is hardly
        // anything to sort or to look up.
        std::vector<sort_key> places;
        for (const Eigen::Vector3d& v : viewpoints.positions())
            if (is_finite(v) && (places.empty() || places.back() != key_of(v)))
                places.push_back(key_of(v));
        if (viewpoints.empty()) places.push_back({0.0, 0.0, 0.0});
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        std::vector<std::vector<point_index>> seen(places.size());
        std::size_t latest = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Eigen::Vector3d v = viewpoints[i];
            if (!is_finite(p[i]) || !is_finite(v)) continue;
            if (places[latest] != key_of(v))
                latest = static_cast<std::size_t>(
                    std::lower_bound(places.begin(), places.end(), key_of(v)) - places.begin());
            seen[latest].push_back(static_cast<point_index>(i));
        }
        for (std::size_t v = 0; v < places.size(); ++v) {
            if (seen[v].empty()) continue;
            const auto& [x, y, z] = places[v];
            images_.emplace_back(subset_view<R, Proj>(points, seen[v], projection),
                                 Eigen::Vector3d(x, y, z), format);
        }
    }

    /// The images, one for each view point.
    [[nodiscard]] const std::vector<range_image>& images() const { return images_; }
    /// The angle of a pixel.
    [[nodiscard]] angle pixel() const { return radians(pixel_); }

    /// What was seen towards a place [m], by most view points that saw anything there; of equally
    /// many what speaks against a surface. O(view points).
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

    /// What was seen along the straight line between two places, as `viewpoint` sees it, all [m]:
    /// at steps of a pixel, the ends left out; nothing if one of them is not finite. O(steps * view
    /// points).
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
    /// A view point, to sort by.
    using sort_key = std::array<double, 3>;
    static sort_key key_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

    /// What one view point has seen there.
    [[nodiscard]] sighting towards(const Eigen::Vector3d& place, const range_image& image) const {
        const double expected = image.distance_to(place);
        if (!std::isfinite(expected) || !image.may_show(place)) return sighting::unseen;
        const double margin = 3.0 * sigma_ + expected * pixel_;
        const auto told_by = [&](const range_image::pixel& other) {
            const double range = image.range(other);
            if (range < 0.0) return sighting::unseen;
            if (range < expected - margin) return sighting::closer;
            return range > expected + margin ? sighting::farther : sighting::level;
        };
        const range_image::pixel at = image.pixel_of(place);
        const sighting here = told_by(at);
        if (here != sighting::unseen) return here;
        // Rays are not spaced as evenly as pixels: what those about it tell holds here, too. Across
        // the lines of a scan they may be two pixels away; of these only what hides is believed.
        const sighting beside = told_about(at, 1, image, told_by);
        const bool is_hidden =
            beside == sighting::unseen && told_about(at, 2, image, told_by) == sighting::closer;
        return is_hidden ? sighting::closer : beside;
    }

    /// What all pixels about one tell that tell anything. At an edge of what is in front of a
    /// surface some tell of that, and some of the surface: the place is not empty, nor certainly
    /// hidden.
    [[nodiscard]] static sighting told_about(const range_image::pixel& at, std::size_t reach,
                                             const range_image& image, const auto& told_by) {
        sighting about = sighting::unseen;
        for (std::size_t e = at.elevation - std::min(at.elevation, reach);
             e <= std::min(at.elevation + reach, image.height() - 1); ++e) {
            for (std::size_t a = at.azimuth + image.width() - reach;
                 a <= at.azimuth + image.width() + reach; ++a) {
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
    std::vector<range_image> images_;
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a sensor saw towards a place: a range image for each of its view points, be it one, one for
/// each of several scans, or one for each point of a sensor that moves. So places are asked for,
/// not pixels of one image, and gaps between points are walked in space. View points that are
/// nearer to each other than noise throws points share an image.
///
/// Klasing 2010, Sec. 4.3.5, with the depth of the line at each pixel's ray instead of an
/// interpolated one (specification of it, A19, F12).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
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
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/occlusion/detail/sensor_places.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/ray_spacing.hpp>

namespace gnomon {

/// How range images are made, and when a range differs.
struct sight_options {
    angle pixel = radians(0);  ///< of the images; 0 stands for the spacing of the rays
    std::optional<Eigen::Vector3d> pole = std::nullopt;  ///< as in `range_image_format`
    /// Standard deviation of ranges [m]; three of them are no difference, and view points in a cube
    /// of this size are one.
    double sigma = 0.015;
};

/// How often something was seen, by kind of sighting.
struct sighting_count {
    std::array<std::size_t, 4> of{};

    [[nodiscard]] std::size_t operator[](sighting s) const {
        return of[static_cast<std::size_t>(s)];
    }
    void add(sighting s) { ++of[static_cast<std::size_t>(s)]; }
    sighting_count& operator+=(const sighting_count& other) {
        for (std::size_t s = 0; s < of.size(); ++s) of[s] += other.of[s];
        return *this;
    }
    [[nodiscard]] std::size_t total() const { return of[0] + of[1] + of[2] + of[3]; }
};

/// Knows what was seen towards any place.
class lines_of_sight {
  public:
    /// What a whole cloud tells: also of points that belong to nothing, such as floor and ceiling
    /// that were left out before segmentation. The view points are those of the range, or else the
    /// origin. O(n log n), and a range image for each view point.
    /// @throws std::invalid_argument  for a sigma that is negative or not finite, an angle of
    ///                                a pixel that is neither 0 nor from a microradian to 90
    ///                                degrees, or a pole of no length
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    explicit lines_of_sight(const R& points, const sight_options& options = {},
                            Proj projection = {})
        : sigma_(options.sigma) {
        detail::require(options.sigma >= 0.0 && std::isfinite(options.sigma),
                        "lines_of_sight: sigma must be finite and not negative");
        constexpr double least = 1e-6, most = 0.5 * std::numbers::pi;  // [rad]
        const double given = options.pixel.radians();
        detail::require(given == 0.0 || (given >= least && given <= most),
                        "lines_of_sight: a pixel has between a microradian and 90 degrees");
        const viewpoint_table viewpoints = viewpoints_of(points);
        const position_view<R, Proj> p(points, projection);
        const angle pixel =
            given > 0.0 ? options.pixel : detail::rays_of_cloud(p, viewpoints).spacing();
        const auto height =
            static_cast<std::size_t>(std::max(1.0, std::round(std::numbers::pi / pixel.radians())));
        pixel_ = std::numbers::pi / static_cast<double>(height);
        const range_image_format format{2 * height, height, options.pole};

        for (const detail::sensor_place& place :
             detail::places_of_sensor(p, viewpoints, options.sigma))
            images_.emplace_back(points, place.seen, place.viewpoint(), format, projection);
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

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a sensor observed towards a place: a range image for each of its view points, whether one,
/// one for each of several scans, or one for each point of a sensor that moves. Therefore queries
/// are places, not pixels of one image, and gaps between points are sampled in space. View points
/// in a cube as wide as the typical noise share an image.
/// Klasing 2010, Sec. 4.3.5, with the depth of the line at the ray of each pixel instead of an
/// interpolated one (docs/thesis-notes.md, A19).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/occlusion/detail/image_axes.hpp>
#include <gnomon/occlusion/detail/sensor_places.hpp>
#include <gnomon/occlusion/detail/view_limits.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/ray_spacing.hpp>

namespace gnomon {

/// How range images are made, and when a range differs.
struct visibility_options {
    angle pixel = radians(0);  ///< of the images; 0 stands for the spacing of the rays
    std::optional<Eigen::Vector3d> pole = std::nullopt;  ///< as in `range_image_options`
    /// Along the rays: three standard deviations are no difference, and view points in a cube as
    /// wide as the typical one are one.
    noise_curve noise = constant_noise{};
};

namespace detail {

/// @throws std::invalid_argument  for an angle of a pixel that is neither 0 nor from a microradian
///                                to 90 degrees, or a pole that is not finite or of no length
inline void require_valid(const visibility_options& options) {
    constexpr double least = 1e-6;  // [rad]; the number of pixels does not overflow
    constexpr double most = 0.5 * std::numbers::pi;  // [rad]
    const double given = options.pixel.radians();
    require(given == 0.0 || (given >= least && given <= most),
            "visibility: a pixel has between a microradian and 90 degrees");
    require(!options.pole || is_direction(*options.pole),
            "visibility: the pole must be finite and have a length");
}

}  // namespace detail

/// Knows what was seen towards any place.
class visibility {
  public:
    /// The observations of a whole cloud: also of points that belong to no segment, such as floor
    /// and ceiling that were left out before segmentation. The view points are those of the range,
    /// or else the origin. O(n log n), and a range image for each view point.
    /// @throws std::invalid_argument  for an angle of a pixel that is neither 0 nor from a
    ///                                microradian to 90 degrees, for a pole that is not finite or
    ///                                has no length, or if the view points are for another number
    ///                                of points
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    explicit visibility(const R& points, const visibility_options& options = {}, const X& run = {},
                        Proj projection = {})
        : noise_(options.noise) {
        detail::require_valid(options);
        const position_view<R, Proj> p(points, projection);
        detail::with_table_of(points, [&](const viewpoint_table& viewpoints) {
            const double wanted = options.pixel.radians() > 0.0
                                      ? options.pixel.radians()
                                      : detail::ray_spacing(p, viewpoints).radians();
            const double height = std::max(1.0, std::round(std::numbers::pi / wanted));
            pixel_ = std::numbers::pi / height;
            const auto rows = static_cast<std::size_t>(height);
            const range_image_options format{2 * rows, rows, options.pole};
            const auto places =
                detail::places_of_sensor(p, viewpoints, typical_noise(p, viewpoints));
            detail::scratch<std::optional<range_image>> images(places.size());
            run(places.size(), [&](std::size_t i) {
                images[i].emplace(points, places[i].seen, places[i].viewpoint(), format,
                                  projection);
            });
            images_.reserve(images.size());
            for (std::optional<range_image>& image : images) images_.push_back(*std::move(image));
            find_limits(p, viewpoints, options.pole);
        });
    }

    /// The images, one for each cube of view points.
    [[nodiscard]] std::span<const range_image> images() const { return images_; }
    /// The angle of a pixel.
    [[nodiscard]] angle pixel() const { return radians(pixel_); }

    /// What was observed towards a place [m], by most view points that observed anything there; of
    /// equally many free space, then on surface, then occluded. Where there were none, it is out
    /// of view if it is so from most of them. Precondition: the place is finite. O(view points).
    template <class Place = Eigen::Vector3d>  // so that only its users compile it
    [[nodiscard]] observation towards(const Place& place) const {
        observation_count count;
        for (const range_image& image : images_) count.add(towards(place, image));
        auto most = observation::free_space;
        for (const auto other : {observation::on_surface, observation::occluded})
            if (count[other] > count[most]) most = other;
        if (count[most] > 0) return most;
        const auto blind =
            std::count_if(images_.begin(), images_.end(), [&](const range_image& image) {
                return limits_.exclude(detail::difference(place, image.viewpoint()));
            });
        return 2 * static_cast<std::size_t>(blind) > images_.size() ? observation::out_of_view
                                                                    : observation::unobserved;
    }

    /// What was seen along the straight line between two places, as `viewpoint` sees it, all [m]:
    /// at steps of a pixel, the ends left out; nothing if one of them is not finite. O(steps * view
    /// points).
    template <class Place = Eigen::Vector3d>  // so that only its users compile it
    [[nodiscard]] observation_count between(const Place& p, const Place& q,
                                            const Eigen::Vector3d& viewpoint) const {
        const Eigen::Vector3d to_p = detail::difference(p, viewpoint);
        const Eigen::Vector3d to_q = detail::difference(q, viewpoint);
        const double angle =
            std::atan2(detail::length(detail::cross(to_p, to_q)), detail::dot(to_p, to_q));
        const double nearby = detail::length(to_p), distant = detail::length(to_q);
        observation_count count;
        if (!std::isfinite(angle)) return count;
        const auto steps = static_cast<std::size_t>(std::ceil(angle / pixel_));
        for (std::size_t s = 1; s < steps; ++s) {
            const double turned = angle * static_cast<double>(s) / static_cast<double>(steps);
            // Where the ray that is turned by this angle meets the line, by the law of sines.
            const double a = nearby * std::sin(turned), b = distant * std::sin(angle - turned);
            count.add(towards(detail::combined(b / (a + b), p, a / (a + b), q)));
        }
        return count;
    }

  private:
    /// Finds the limits of the view about the given pole or the axis along which all rays vary
    /// least. The images have poles of their own, since the common axis may lie within the field of
    /// view of one of them.
    void find_limits(const auto& p, const viewpoint_table& viewpoints, const auto& pole) {
        detail::scratch<Eigen::Vector3d> ways;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (const Eigen::Vector3d way = detail::difference(p[i], viewpoints[i]);
                detail::has_length(way))
                ways.push_back(way);
        limits_.set(ways, pole ? *pole : detail::least_observed_axis(ways, std::identity()),
                    pixel_);
    }

    /// The median of the standard deviations of the ranges [m].
    [[nodiscard]] double typical_noise(const auto& p, const viewpoint_table& viewpoints) const {
        constexpr std::size_t enough = 1000;  // a sample (performance only)
        detail::scratch<double> deviations;
        for (std::size_t i = 0; i < p.size(); i += 1 + p.size() / enough) {
            const Eigen::Vector3d way = detail::difference(p[i], viewpoints[i]);
            if (!detail::all_finite(way)) continue;
            deviations.push_back(noise_.along(way));
        }
        if (deviations.empty()) return 0.0;
        const auto median = deviations.begin() + std::ssize(deviations) / 2;
        std::nth_element(deviations.begin(), median, deviations.end());
        return *median;
    }

    /// What one view point has seen there.
    [[nodiscard]] observation towards(const auto& place, const range_image& image) const {
        const double expected = image.distance_to(place);
        if (!std::isfinite(expected) || !image.may_show(place)) return observation::unobserved;
        constexpr double deviations = 3.0;  // 99.7 % of a normal distribution
        const double margin =
            deviations * noise_.along(detail::difference(place, image.viewpoint())) +
            expected * pixel_;
        const auto observation_in = [&](const range_image::pixel& other) {
            const double range = image.range(other);
            if (range < 0.0) return observation::unobserved;
            if (range < expected - margin) return observation::occluded;
            return range > expected + margin ? observation::free_space : observation::on_surface;
        };
        const range_image::pixel at = image.pixel_of(place);
        const observation here = observation_in(at);
        if (here != observation::unobserved) return here;
        // Rays are not spaced as evenly as pixels: the adjacent pixels count as well. Across the
        // lines of a scan the next ray may be two pixels away; beyond one pixel only occlusion
        // counts as evidence.
        const observation nearby = observation_around(at, 1, image, observation_in);
        const bool is_hidden =
            nearby == observation::unobserved &&
            observation_around(at, 2, image, observation_in) == observation::occluded;
        return is_hidden ? observation::occluded : nearby;
    }

    /// The observation of all pixels around one with a return. At an edge of an occluder some
    /// pixels show the occluder, and some the surface: the place is neither free nor certainly
    /// occluded.
    [[nodiscard]] static observation observation_around(const range_image::pixel& at,
                                                        std::size_t reach, const range_image& image,
                                                        const auto& observation_in) {
        observation_count about;
        for (std::size_t e = at.elevation - std::min(at.elevation, reach);
             e <= std::min(at.elevation + reach, image.height() - 1); ++e) {
            for (std::size_t a = at.azimuth + image.width() - reach;
                 a <= at.azimuth + image.width() + reach; ++a)
                about.add(observation_in({a % image.width(), e}));
        }
        const std::size_t free = about[observation::free_space];
        const std::size_t on = about[observation::on_surface];
        const std::size_t hidden = about[observation::occluded];
        if (free > 0) return on + hidden > 0 ? observation::unobserved : observation::free_space;
        if (on > 0) return observation::on_surface;
        return hidden > 0 ? observation::occluded : observation::unobserved;
    }

    noise_curve noise_;
    double pixel_ = 0.0;  // [rad]
    detail::view_limits limits_;
    detail::scratch<range_image> images_;
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The rays of a range image next to an object: those that hit it, and those that pass it. At its
/// silhouette a ray is a beam of some width, of which a share hits: for the sensor by the mean
/// range that it returns, and for a model at a pose by the surface that it has there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/perception/detail/image_of_surface.hpp>
#include <gnomon/perception/detail/surface_drawing.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/verification.hpp>

namespace gnomon::recognition::detail {

/// The points of which there are images.
struct imaged_points {
    /// As in perceive_views(): a point of none is of no object.
    std::span<const std::int32_t> groups;
    std::function<Eigen::Vector3d(point_index)> at;  ///< [m]
};

/// Sums over rays, of shares of beams.
struct silhouette_shares {
    double in_both = 0.0;  ///< that hit the object both in the scan and by the model
    double in_any = 0.0;   ///< that hit it in at least one of the two
    double passing = 0.0;  ///< the number of rays that pass the model
    double beyond = 0.0;   ///< of these, that hit in the scan what continues a face of the model
};

/// The rays of one image.
class silhouette_rays {
  public:
    /// @param points      that are in the image
    /// @param pixel       of the image [rad]
    /// @param noise       along the rays
    /// @param divergence  full angle of the beams [rad]
    /// @param pose        of the object, about: its faces are there, though they may slide on
    ///                    themselves
    silhouette_rays(const range_image& image, const imaged_points& points, double pixel,
                    const noise_curve& noise, double divergence, const surface_model& model,
                    const rigid_motion& pose)
        : plane_(image.viewpoint(),
                 pose.point_out(gnomon::detail::combined(0.5, model.low(), 0.5, model.high()))) {
        constexpr double widest = 6.0;  // pixels in half a beam; chosen: wider ones show no edge
        const double half = std::round(0.5 * divergence / pixel);
        if (half > widest) return;
        half_ = std::max<std::size_t>(1, static_cast<std::size_t>(half));
        const auto band = static_cast<std::ptrdiff_t>(half_ + 2);
        const image_of_surface expected(image, pixel, band, plane_, model, pose);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            if (const facing_sample* s = expected.sample(k))
                add(image, points, noise, expected.pixel(k), *s);
        }
        if (rays_.empty()) return;
        std::vector<Eigen::Vector2d> places;
        for (const silhouette_ray& r : rays_) places.push_back(r.at);
        constexpr double narrow = 1.0;  // pixels of the narrowest beam; chosen: no gap between rays
        drawing_.emplace(plane_, places, std::max(divergence, narrow * pixel), model, pose);
        if (drawing_->is_too_large()) rays_.clear();
    }

    [[nodiscard]] std::size_t size() const { return rays_.size(); }

    /// How far the silhouette at a pose is from that of the scan: the sum of squared differences of
    /// shares. What goes on beyond the object counts half: it may be something else.
    /// @param shares  gets that of each ray which hits the object at this pose
    [[nodiscard]] double misfit(const rigid_motion& pose, std::vector<double>& shares) {
        drawing_->draw(pose);
        shares.clear();
        double sum = 0.0;
        for (const silhouette_ray& r : rays_) {
            shares.push_back(drawing_->share(r.at));
            sum += weight(r, shares.back()) * (shares.back() - r.share) * (shares.back() - r.share);
        }
        return sum;
    }

    /// Adds the shares of the rays that hit the object at a pose.
    void add_shares(const rigid_motion& pose, silhouette_shares& sums) {
        drawing_->draw(pose);
        for (const silhouette_ray& r : rays_) {
            const double expected = drawing_->share(r.at), seen = r.share;
            sums.in_both += std::min(expected, seen);
            sums.in_any += std::max(expected, seen);
            if (expected > 0.0) continue;
            sums.passing += 1.0;
            sums.beyond += seen;
        }
    }

  private:
    struct silhouette_ray {
        Eigen::Vector2d at;  ///< on the image plane
        double share;        ///< of it, which hits the object
    };

    [[nodiscard]] static double weight(const silhouette_ray& r, double expected) {
        constexpr double beyond = 0.5;  // chosen on rooms of seeds 301 to 370, of .25 to 1
        return expected < r.share ? beyond : 1.0;
    }

    /// Adds the ray of a pixel, unless it is unknown what is on the face of a sample there.
    void add(const range_image& image, const imaged_points& points, const noise_curve& noise,
             const range_image::pixel& pixel, const facing_sample& face) {
        using gnomon::detail::difference, gnomon::detail::dot, gnomon::detail::scaled;
        constexpr double deviations = 3.0;  // of the noise: 99.7 % of a normal distribution
        constexpr double tolerance = verification_options{}.tolerance;
        constexpr double uneven = 0.005;  // [m]; chosen: of faces between samples
        const std::optional<point_index> index = image.index(pixel);
        if (!index) return;
        // Rays are not in the middle of their pixels: on a table that is seen at a low angle these
        // are centimeters apart.
        const Eigen::Vector3d way = difference(points.at(*index), plane_.viewpoint);
        const Eigen::Vector2d at = plane_.place_of(way);
        if (!(at.array() == at.array()).all()) return;
        const double range = gnomon::detail::length(way);
        const Eigen::Vector3d ray = scaled(1.0 / range, way);
        const double slope = dot(ray, face.normal);
        const double in_front =  // of the plane of the face
            range * slope + dot(face.normal, difference(plane_.viewpoint, face.at));
        const double on = uneven + std::max(tolerance, deviations * std::abs(slope) *
                                                           noise.along(scaled(range, ray)));
        if (in_front > on || is_next_to_occluder(image, pixel, face)) return;
        if (in_front >= -on) {
            if (points.groups[*index] >= 0) rays_.push_back({at, 1.0});
            return;
        }
        rays_.push_back(
            {at, share_behind(image, pixel, range, slope,
                              dot(face.normal, difference(face.at, plane_.viewpoint)))});
    }

    /// Whether something is in front of a face, next to a pixel.
    [[nodiscard]] bool is_next_to_occluder(const range_image& image,
                                           const range_image::pixel& pixel,
                                           const facing_sample& face) const {
        using gnomon::detail::difference, gnomon::detail::dot;
        constexpr double clearly = 0.04;  // [m]; chosen: noise, and unevenness
        const double off = dot(face.normal, difference(plane_.viewpoint, face.at));
        bool is_hidden = false;
        for_each_around(image, pixel, [&](const range_image::pixel& p, double range) {
            is_hidden =
                is_hidden || off + range * dot(face.normal, image.direction_of(p)) > clearly;
        });
        return is_hidden;
    }

    /// The share of a beam that hits a face, if its range is behind the face: the sensor returns
    /// the mean of two ranges, and the farther one is that of a pixel around it.
    /// @param slope     cosine between ray and normal
    /// @param distance  of the plane of the face from the view point, along its normal [m]
    [[nodiscard]] double share_behind(const range_image& image, const range_image::pixel& pixel,
                                      double range, double slope, double distance) const {
        constexpr double oblique = -0.02;  // chosen: cosine; faces meet the ray at a range
        constexpr double apart = 0.1;      // [m]; chosen: a step that noise does not hide
        double farthest = range;
        for_each_around(image, pixel, [&](const range_image::pixel&, double r) {
            farthest = std::max(farthest, r);
        });
        const double nearest = slope < oblique ? distance / slope : range;
        return nearest < range && farthest - nearest > apart
                   ? (farthest - range) / (farthest - nearest)
                   : 0.0;
    }

    /// Calls visit(pixel, range) for the pixels that a beam covers, at least those around its own,
    /// which are not empty.
    void for_each_around(const range_image& image, const range_image::pixel& at,
                         const auto& visit) const {
        for (std::size_t e = at.elevation - std::min(at.elevation, half_);
             e <= std::min(at.elevation + half_, image.height() - 1); ++e) {
            for (std::size_t a = at.azimuth + image.width() - half_;
                 a <= at.azimuth + image.width() + half_; ++a) {
                const range_image::pixel p{a % image.width(), e};
                if (const double range = image.range(p); range >= 0.0) visit(p, range);
            }
        }
    }

    image_plane plane_;
    std::vector<silhouette_ray> rays_;
    std::size_t half_ = 1;                    // pixels in half a beam, at least one
    std::optional<surface_drawing> drawing_;  // none without rays
};

}  // namespace gnomon::recognition::detail

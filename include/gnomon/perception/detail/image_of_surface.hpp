// SPDX-License-Identifier: BSL-1.0
/// @file
/// The samples of an object's surface that face a view point, at a pose, and which of them is next
/// to each pixel of a range image.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/verification.hpp>

namespace gnomon::recognition::detail {

/// A plane at unit distance from a view point: directions are places on it.
struct image_plane {
    Eigen::Vector3d viewpoint, ahead, right, up;

    image_plane(const Eigen::Vector3d& from, const Eigen::Vector3d& towards)
        : viewpoint(from),
          ahead(gnomon::detail::direction_of(gnomon::detail::difference(towards, from))),
          right(gnomon::detail::direction_of(gnomon::detail::orthogonal(ahead))),
          up(gnomon::detail::cross(ahead, right)) {}

    /// Where a ray meets the plane; NaN if it does so far off, or not.
    [[nodiscard]] Eigen::Vector2d place_of(const Eigen::Vector3d& way) const {
        constexpr double least = 0.3;  // chosen: cosine of 73 degrees
        const double depth = gnomon::detail::dot(ahead, way);
        if (!(depth > least * gnomon::detail::length(way)))
            return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
        return {gnomon::detail::dot(right, way) / depth, gnomon::detail::dot(up, way) / depth};
    }
};

/// A sample of a surface that faces a view point.
struct facing_sample {
    Eigen::Vector3d at, normal;  ///< in the frame of the scan [m]
    double range;                ///< from the view point [m]
};

/// Calls visit(facing_sample) for the samples above a height that face a view point.
/// @param lowest  in the frame of the object [m]
void for_each_facing_sample(const surface_model& model, const rigid_motion& pose,
                            const Eigen::Vector3d& viewpoint, double lowest, const auto& visit) {
    constexpr double most_oblique = 0.02;  // chosen: cosine of the most oblique face
    for (std::size_t i = 0; i < model.points().size(); ++i) {
        const Eigen::Vector3d x = model.points()[i];
        if (x.z() < lowest) continue;
        const Eigen::Vector3d at = pose.point_out(x);
        const Eigen::Vector3d normal = pose.direction_out(model.normals()[i].normal);
        const Eigen::Vector3d way = gnomon::detail::difference(at, viewpoint);
        const double range = gnomon::detail::length(way);
        if (-gnomon::detail::dot(way, normal) >= most_oblique * range)
            visit(facing_sample{at, normal, range});
    }
}

/// The part of a range image around an object.
class image_of_surface {
  public:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    /// Empty for an object that is all around the view point.
    /// @param spacing  of pixels [rad]
    /// @param band     pixels around the object
    image_of_surface(const range_image& image, double spacing, std::ptrdiff_t band,
                     const image_plane& plane, const surface_model& model, const rigid_motion& pose)
        : image_(image), plane_(plane), band_(band) {
        constexpr double lowest = verification_options{}.lowest;  // lower points are floor
        for_each_facing_sample(model, pose, plane.viewpoint, lowest, [&](const facing_sample& s) {
            samples_.push_back(s);
            pixels_.push_back(image.pixel_of(s.at));
        });
        if (samples_.empty() || !set_bounds()) return;
        places_.resize(width_ * height_);
        nearest_.assign(places_.size(), {});
        for (std::size_t k = 0; k < places_.size(); ++k)
            places_[k] = plane.place_of(image.direction_of(pixel(k)));
        for (std::size_t i = 0; i < samples_.size(); ++i) show(i, spacing, model.spacing());
    }

    [[nodiscard]] std::size_t size() const { return nearest_.size(); }  ///< in pixels
    /// Pixel k of the part in the image.
    [[nodiscard]] range_image::pixel pixel(std::size_t k) const {
        return {(first_ + k % width_) % image_.width(), low_ + k / width_};
    }
    /// The sample next to a pixel, or null.
    [[nodiscard]] const facing_sample* sample(std::size_t k) const {
        return nearest_[k].sample == none ? nullptr : &samples_[nearest_[k].sample];
    }

  private:
    /// A sample next to a pixel: of those on the ray the one of least range, or else the one of the
    /// nearest direction.
    struct next {
        std::size_t sample = none;
        bool is_on = false;
        /// The range [m], or the squared tangent of the angle.
        double off = std::numeric_limits<double>::infinity();
    };

    /// Columns from that of the first sample on, in [-w / 2, w / 2).
    [[nodiscard]] std::ptrdiff_t column(std::size_t i) const {
        const auto w = static_cast<std::ptrdiff_t>(image_.width());
        const auto d = static_cast<std::ptrdiff_t>(pixels_[i].azimuth) -
                       static_cast<std::ptrdiff_t>(pixels_.front().azimuth);
        return (d + w + w / 2) % w - w / 2;
    }

    /// @return whether the part is less than half of the image wide
    [[nodiscard]] bool set_bounds() {
        std::ptrdiff_t right = 0;
        low_ = pixels_.front().elevation;
        std::size_t high = low_;
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            left_ = std::min(left_, column(i));
            right = std::max(right, column(i));
            low_ = std::min(low_, pixels_[i].elevation);
            high = std::max(high, pixels_[i].elevation);
        }
        left_ -= band_;
        right += band_;
        low_ -= std::min(low_, static_cast<std::size_t>(band_));
        high = std::min(high + static_cast<std::size_t>(band_), image_.height() - 1);
        const auto w = static_cast<std::ptrdiff_t>(image_.width());
        if (2 * (right - left_) >= w) return false;
        first_ = static_cast<std::size_t>(
            (static_cast<std::ptrdiff_t>(pixels_.front().azimuth) + left_ + w) % w);
        width_ = static_cast<std::size_t>(right - left_ + 1);
        height_ = high - low_ + 1;
        return true;
    }

    /// Compares a sample with the pixels around it.
    void show(std::size_t i, double pixel, double spacing) {
        constexpr double spacings = 0.75;    // chosen: half of their diagonal
        constexpr double beyond_band = 0.6;  // pixels; chosen: a part of one
        const facing_sample& s = samples_[i];
        // Tangents of angles: from the sample to its rays, and to those next to it.
        const double on_sample = spacings * spacing / s.range;
        const double reach = (static_cast<double>(band_) + beyond_band) * pixel;
        const Eigen::Vector2d at =
            plane_.place_of(gnomon::detail::difference(s.at, plane_.viewpoint));
        const auto x = column(i) - left_;
        const auto y = static_cast<std::ptrdiff_t>(pixels_[i].elevation - low_);
        const auto rows = static_cast<std::ptrdiff_t>(height_);
        for (auto b = std::max<std::ptrdiff_t>(0, y - band_); b <= std::min(rows - 1, y + band_);
             ++b) {
            for (auto a = x - band_; a <= x + band_; ++a) {
                const auto k = static_cast<std::size_t>(b) * width_ + static_cast<std::size_t>(a);
                const double squared = (places_[k] - at).squaredNorm();
                const bool is_on = squared < on_sample * on_sample;
                if (!is_on && !(squared < reach * reach)) continue;
                next& n = nearest_[k];
                const double off = is_on ? s.range : squared;
                if (is_on == n.is_on ? off < n.off : is_on) n = {i, is_on, off};
            }
        }
    }

    const range_image& image_;
    const image_plane& plane_;
    std::vector<facing_sample> samples_;
    std::vector<range_image::pixel> pixels_;  // of the samples
    std::ptrdiff_t band_;
    std::ptrdiff_t left_ = 0;             // column, from the first sample on
    std::size_t first_ = 0, low_ = 0;     // column and row in the image
    std::size_t width_ = 0, height_ = 0;  // in pixels
    std::vector<Eigen::Vector2d> places_;
    std::vector<next> nearest_;
};

}  // namespace gnomon::recognition::detail

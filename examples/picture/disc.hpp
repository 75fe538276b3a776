// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where does a camera see a flat disc? For each row of pixels, the rays that meet it, and how
/// near.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Core>

namespace picture {

/// A disc in the frame of a camera, whose rays are (u, v, 1).
class disc {
  public:
    /// The rays of equal v. Where they meet the plane of the disc, the depth is offset / (a u + b);
    /// they meet the disc where |hit - center|^2 <= radius^2, which times (a u + b)^2 is quadratic
    /// in u.
    class row {
      public:
        row(const disc& d, double v)
            : offset_(d.offset_), a_(d.normal_.x()), b_(d.normal_.y() * v + d.normal_.z()) {
            const Eigen::Vector3d of_u = Eigen::Vector3d(offset_, 0.0, 0.0) - a_ * d.center_;
            const Eigen::Vector3d rest =
                Eigen::Vector3d(0.0, offset_ * v, offset_) - b_ * d.center_;
            const double r2 = d.radius_ * d.radius_;
            c2_ = of_u.squaredNorm() - r2 * a_ * a_;
            c1_ = 2.0 * (of_u.dot(rest) - r2 * a_ * b_);
            c0_ = rest.squaredNorm() - r2 * b_ * b_;
        }

        [[nodiscard]] bool is_met(double u) const { return (c2_ * u + c1_) * u + c0_ <= 0.0; }

        /// 1 / depth on the plane of the disc [1/m].
        [[nodiscard]] double nearness(double u) const { return (a_ * u + b_) / offset_; }

        /// The first and the last u that meet the disc, both its vertex if none does; nothing if
        /// the disc reaches behind the camera.
        [[nodiscard]] std::optional<std::array<double, 2>> ends() const {
            if (!(c2_ > 0.0)) return std::nullopt;
            const double vertex = -0.5 * c1_ / c2_;
            const double half = 0.5 * std::sqrt(std::max(0.0, c1_ * c1_ - 4.0 * c2_ * c0_)) / c2_;
            return std::array{vertex - half, vertex + half};
        }

      private:
        double offset_, a_, b_;
        double c2_, c1_, c0_;
    };

    /// @param normal  of unit length
    disc(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double radius)
        : center_(center), normal_(normal), radius_(radius), offset_(normal.dot(center)) {}

    /// The cosine of the angle between the normal and the ray to the center.
    [[nodiscard]] double cosine() const { return offset_ / center_.norm(); }

  private:
    Eigen::Vector3d center_, normal_;  ///< [m]
    double radius_;                    ///< [m]
    double offset_;                    ///< of its plane [m]
};

}  // namespace picture

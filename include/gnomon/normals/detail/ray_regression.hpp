// SPDX-License-Identifier: BSL-1.0
/// @file
/// The regression of `ray_ls` and `plane_eif`: the inverse depth of a plane is linear in the
/// tangents of the rays.
#pragma once

#include <array>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>

namespace gnomon::detail {

/// The regression of y = range / depth - 1 on the tangents (xi, eta) of rays near the ray of a
/// point p, where range is the distance of p from the view point, and depth the coordinate of a
/// neighbor along the ray of p. For the plane n . x = d in coordinates relative to the view point,
/// y = M1 xi + M2 eta + (M3 - 1) with M = (range / d) n. In this frame the system is well
/// conditioned for neighborhoods of any size. The point itself has y = xi = eta = 0 and the weight
/// 1.
class ray_regression {
  public:
    /// @param x  the point p relative to the view point [m]
    explicit ray_regression(const Eigen::Vector3d& x) : range_(length(x)) {
        status_ = std::isfinite(range_) ? trust::good : trust::not_finite;
        if (range_ == 0.0) status_ = trust::degenerate;
        if (!usable(status_)) return;
        e3_ = scaled(1.0 / range_, x);
        e1_ = orthogonal(e3_);
        e2_ = cross(e3_, e1_);
    }

    /// Adds a neighbor at the offset d [m] from the point.
    void add(const Eigen::Vector3d& d) {
        const double depth = 1.0 + dot(d, e3_) / range_;
        if (usable(status_) && !(depth > 0.0))  // not in front of the view point
            status_ = std::isnan(depth) ? trust::not_finite : trust::degenerate;
        const double xi = dot(d, e1_) / (range_ * depth);
        const double eta = dot(d, e2_) / (range_ * depth);
        const double y = 1.0 / depth - 1.0;
        // An error sigma of the range is an error sigma / (range sqrt(w)) of y.
        const double w = depth * depth * depth * depth * (1.0 + xi * xi + eta * eta);
        w_ += w;
        xi_ += w * xi;
        eta_ += w * eta;
        y_ += w * y;
        xx_ += w * xi * xi;
        xe_ += w * xi * eta;
        ee_ += w * eta * eta;
        xy_ += w * xi * y;
        ey_ += w * eta * y;
    }

    /// Solves the regression, if it is determined: see status().
    void solve() {
        if (!usable(status_)) return;
        const double a = xx_ - xi_ * xi_ / w_;
        const double b = xe_ - xi_ * eta_ / w_;
        const double c = ee_ - eta_ * eta_ / w_;
        const double f = xy_ - xi_ * y_ / w_;
        const double g = ey_ - eta_ * y_ / w_;
        if (!std::isfinite(a + c + f + g)) {
            status_ = trust::not_finite;
            return;
        }
        const double determinant = a * c - b * b;
        const double larger = 0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4.0 * b * b));
        constexpr double negligible = 1e-12;
        if (!(determinant > negligible * larger * larger)) {
            status_ = trust::degenerate;
            return;
        }
        aspect_ratio_ = std::sqrt(determinant) / larger;

        aa_ = c / determinant;
        ab_ = -b / determinant;
        bb_ = a / determinant;
        m_[0] = aa_ * f + ab_ * g;
        m_[1] = ab_ * f + bb_ * g;
        m_[2] = 1.0 + (y_ - m_[0] * xi_ - m_[1] * eta_) / w_;
    }

    /// `good`, or why there is no solution.
    [[nodiscard]] trust status() const { return status_; }

    /// The distance of the point [m].
    [[nodiscard]] double range() const { return range_; }

    /// The ratio of the standard deviations of the tangents along their principal directions, 0
    /// to 1. After solve().
    [[nodiscard]] double aspect_ratio() const { return aspect_ratio_; }

    /// M in the coordinates of the cloud. After solve().
    [[nodiscard]] Eigen::Vector3d solution() const {
        return combined(m_[0], e1_, m_[1], e2_, m_[2], e3_);
    }

    /// The covariance of a . M and b . M for ranges with standard deviation sigma [m]. After
    /// solve().
    [[nodiscard]] double covariance(double sigma, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b) const {
        // The slopes have the covariance s^2 [aa ab; ab bb], the mean s^2 / w, independent of them;
        // M3 is the mean less the slopes times the mean tangents.
        const auto slopes = [this](const Eigen::Vector3d& c) {
            const double along = dot(c, e3_) / w_;
            return std::array{dot(c, e1_) - along * xi_, dot(c, e2_) - along * eta_, along};
        };
        const auto [a1, a2, a3] = slopes(a);
        const auto [b1, b2, b3] = slopes(b);
        const double s = sigma / range_;
        return s * s * (a1 * (aa_ * b1 + ab_ * b2) + a2 * (ab_ * b1 + bb_ * b2) + a3 * b3 * w_);
    }

  private:
    double range_ = 0.0;
    trust status_ = trust::good;
    Eigen::Vector3d e1_{0.0, 0.0, 0.0};
    Eigen::Vector3d e2_{0.0, 0.0, 0.0};
    Eigen::Vector3d e3_{0.0, 0.0, 0.0};
    double w_ = 1.0, xi_ = 0.0, eta_ = 0.0, y_ = 0.0;
    double xx_ = 0.0, xe_ = 0.0, ee_ = 0.0, xy_ = 0.0, ey_ = 0.0;
    double aa_ = 0.0, ab_ = 0.0, bb_ = 0.0, aspect_ratio_ = 0.0;  // of the solution
    Eigen::Vector3d m_{0.0, 0.0, 0.0};
};

}  // namespace gnomon::detail

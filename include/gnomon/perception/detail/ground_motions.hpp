// SPDX-License-Identifier: BSL-1.0
/// @file
/// Small motions of an object on the ground: a turn about the vertical and two shifts, in lengths
/// along the principal axes of the covariance of an alignment.
#pragma once

#include <algorithm>
#include <numbers>

#include <Eigen/Core>

#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/features/detail/surface_alignment.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/vertical_symmetry.hpp>

namespace gnomon::recognition::detail {

/// Half of the mean of length and width of an object, at least a spacing of its samples [m]: a turn
/// by 1 about the vertical moves its sides by about this.
[[nodiscard]] inline double half_of_mean_side(const surface_model& model) {
    const Eigen::Vector3d size = gnomon::detail::difference(model.high(), model.low());
    return std::max(model.spacing(), 0.25 * (size.x() + size.y()));
}

/// Those of one object, from its alignment.
class ground_motions {
  public:
    using motion = Eigen::Vector3d;  ///< along each axis [m]

    /// @param up  the normal of the ground
    ground_motions(const alignment& found, const surface_model& model, const Eigen::Vector3d& up)
        : found_(found),
          up_(up),
          first_(gnomon::detail::direction_of(gnomon::detail::orthogonal(up))),
          second_(gnomon::detail::cross(up, first_)),
          half_(half_of_mean_side(model)) {
        Eigen::Matrix3d c;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) c(i, j) = covariance_of(i, j);
        if (model.symmetry().order == vertical_symmetry::any_turn) hold_turn(c, model.symmetry());
        const auto eigen = gnomon::detail::symmetric_eigen(c);
        axes_ = eigen.vectors;
        variances_ = eigen.values;
    }

    /// Of the motions along the axes [m^2], descending.
    [[nodiscard]] const Eigen::Vector3d& variances() const { return variances_; }

    [[nodiscard]] rigid_motion pose_after(const motion& m) const {
        using gnomon::detail::combined, gnomon::detail::product, gnomon::detail::scaled;
        const Eigen::Vector3d d = product(axes_, m);
        const Eigen::Matrix3d turn = gnomon::detail::rotation_of(scaled(d[0] / half_, up_));
        const rigid_motion about{turn, {0.0, 0.0, 0.0}};
        rigid_motion pose{
            (about * rigid_motion{found_.pose.rotation, {0.0, 0.0, 0.0}}).rotation,
            product(turn, gnomon::detail::difference(found_.pose.position, found_.center))};
        pose.position = combined(1.0, combined(1.0, pose.position, 1.0, found_.center), d[1],
                                 first_, d[2], second_);
        return pose;
    }

    /// The alignment after a motion.
    /// @param covariance  of motions along the axes [m^2]
    [[nodiscard]] alignment after(const motion& m, const Eigen::Matrix3d& covariance) const {
        alignment moved = found_;
        moved.pose = pose_after(m);
        const Eigen::Vector3d d = gnomon::detail::product(axes_, m);
        moved.center = gnomon::detail::combined(1.0, found_.center, d[1], first_, d[2], second_);
        const Eigen::Matrix3d c = axes_ * covariance * axes_.transpose() +
                                  turn_variance_ * about_axis_ * about_axis_.transpose();
        for (int i = 0; i < 6; ++i) {
            for (int j = 0; j < 6; ++j) {
                double sum = 0.0;
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b) sum += unit(a, i) * c(a, b) * unit(b, j);
                moved.covariance(i, j) = sum;
            }
        }
        return moved;
    }

    /// The alignment without a motion; of a surface of revolution with any heading.
    [[nodiscard]] alignment unmoved() const {
        const bool has_axis = about_axis_[0] > 0.0;
        return has_axis ? after({0.0, 0.0, 0.0}, variances_.asDiagonal()) : found_;
    }

  private:
    /// Leaves out turns: a surface of revolution is the same after any turn about its axis, and has
    /// any heading. Shifts are as certain as they are at one heading.
    void hold_turn(Eigen::Matrix3d& c, const vertical_symmetry& symmetry) {
        using std::numbers::pi;
        constexpr double any_heading = pi * pi / 3.0;  // [rad^2]; formula: of a uniform one
        turn_variance_ = std::min(c(0, 0), any_heading * half_ * half_);
        if (c(0, 0) > 0.0) {
            const Eigen::Vector3d with_turn = c.col(0);
            c -= with_turn * with_turn.transpose() / with_turn[0];
        }
        c.row(0).setZero();
        c.col(0).setZero();
        const Eigen::Vector3d axis = found_.pose.point_out({symmetry.x, symmetry.y, 0.0});
        const Eigen::Vector3d shift =
            gnomon::detail::cross(up_, gnomon::detail::difference(found_.center, axis));
        about_axis_ = {1.0, gnomon::detail::dot(first_, shift) / half_,
                       gnomon::detail::dot(second_, shift) / half_};
    }

    /// Component i of the change by a motion of one meter along axis a: of a turn, then a shift.
    [[nodiscard]] double unit(int a, int i) const {
        if (a == 0) return i < 3 ? up_[i] / half_ : 0.0;
        return i < 3 ? 0.0 : (a == 1 ? first_ : second_)[i - 3];
    }
    /// Of two of turn and shifts, in lengths [m^2].
    [[nodiscard]] double covariance_of(int a, int b) const {
        double sum = 0.0;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j) sum += unit(a, i) * found_.covariance(i, j) * unit(b, j);
        return sum * (a == 0 ? half_ * half_ : 1.0) * (b == 0 ? half_ * half_ : 1.0);
    }

    alignment found_;
    Eigen::Vector3d up_, first_, second_;
    double half_ = 1.0;           // of the mean side [m]: a turn by 1 is as long
    double turn_variance_ = 0.0;  // where a turn is no motion: its variance, as a length [m^2]
    Eigen::Vector3d about_axis_{0.0, 0.0, 0.0};  // the motion of the center then, by a unit of turn
    Eigen::Matrix3d axes_;
    Eigen::Vector3d variances_;
};

}  // namespace gnomon::recognition::detail

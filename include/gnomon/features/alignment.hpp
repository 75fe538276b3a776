// SPDX-License-Identifier: BSL-1.0
/// @file
/// The pose of points on a surface with its covariance: the result of `align_to_surface`, and its
/// options.
///
/// In no umbrella: include it by name.
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/features/surface_fit.hpp>

namespace gnomon {

/// Noise, what may move, and which points correspond.
struct alignment_options {
    /// Of the points, along their rays, or in all directions where view points are unknown.
    /// Unevenness of the surface, or of its samples, is stated as noise too: `noise.plus(0.002)`.
    noise_curve noise = constant_noise{};
    /// Of the samples of the surface, independent of each other; none for a model.
    noise_curve surface_noise = constant_noise{0.0};
    /// Of the normals of the surface: directions of the motion that only variations of this size
    /// determine are degenerate.
    angle normal_noise = degrees(1.0);
    /// Only turns about the z-axis of the surface's frame and shifts normal to it, as those of an
    /// object on the ground; else all six.
    bool on_ground = false;
    bool two_sided = false;           ///< normals of the surface have no sign: nothing faces away
    double max_distance = 0.10;       ///< between corresponding points at the start [m]
    double last_distance = 0.03;      ///< the same at the end [m]: above the spacing of the samples
    angle max_angle = degrees(45.0);  ///< between the normals of corresponding points
    int max_iterations = 50;          ///< on all points, and on a sample of them before

    /// @throws std::invalid_argument  unless 0 < last_distance <= max_distance, both finite, angles
    ///                                are from 0 to 90 degrees, and there is an iteration
    void require_valid() const {
        using detail::require;
        require(max_distance > 0.0 && std::isfinite(max_distance),
                "align_to_surface: max_distance must be positive and finite");
        require(last_distance > 0.0 && last_distance <= max_distance,
                "align_to_surface: last_distance must be positive, at most max_distance");
        const auto is_acute = [](angle a) { return a >= degrees(0.0) && a <= degrees(90.0); };
        require(is_acute(normal_noise),
                "align_to_surface: normal_noise must be from 0 to 90 degrees");
        require(is_acute(max_angle), "align_to_surface: max_angle must be from 0 to 90 degrees");
        require(max_iterations > 0, "align_to_surface: requires an iteration");
    }
};

/// The rigid motion from the frame of points to that of a surface, with its covariance.
struct alignment {
    /// What an alignment can come to.
    enum class outcome : std::uint8_t {
        converged,      ///< the points determine all that was free to move
        not_converged,  ///< the pose is that of the last iteration
        /// At the last iteration no more points were near the surface than there are parameters.
        /// The pose is that of the last step that had enough.
        too_few_points,
        /// The points do not determine some directions of the motion, such as a plane that slides
        /// on itself or a leg of a table that turns about its axis. Along these the pose is that of
        /// the start, and the covariance is large.
        degenerate
    };
    /// Of turns about three axes [rad], then of shifts along them [m].
    using covariance_matrix = detail::parameter_covariance<6>;
    /// Of directions that the points do not determine [m]; a turn has it over the root mean square
    /// distance from `center` of the points of which that is the centroid.
    static constexpr double unknown_deviation = 1e3;  // numerical: more than any scene [m]

    outcome status = outcome::too_few_points;  ///< of this alignment
    rigid_motion pose;                         ///< of the points' frame in that of the surface
    /// Of the turns: the centroid of the points that were near the surface at the start, in the
    /// frame of the surface [m].
    Eigen::Vector3d center{0.0, 0.0, 0.0};
    /// Of a small motion in the frame of the surface, which leads from the estimated pose to the
    /// true one: a turn about `center`, as a rotation vector, and a shift. Zero in the rows and
    /// columns of directions that were not free to move.
    covariance_matrix covariance = covariance_matrix::Zero();
    std::size_t determined = 0;  ///< directions of the motion that the points determine
    std::size_t points = 0;      ///< those that are finite
    std::size_t inliers = 0;     ///< points whose residual has a weight above 0
    double rms = 0.0;            ///< root mean square distance of inliers from the surface [m]
    int iterations = 0;          ///< on all points

    /// Whether all that was free to move is known. From a start that is far off, it may be the pose
    /// of a wrong minimum: see align_to_surface().
    [[nodiscard]] bool is_usable() const { return status == outcome::converged; }

    /// The same alignment seen from the other side: `pose` is that of the surface in the frame of
    /// the points, and center and covariance are expressed there. O(1).
    [[nodiscard]] alignment inverse() const {
        alignment other = *this;
        other.pose = pose.inverse();
        other.center = pose.point_in(center);
        // T^-1 D^-1 T is a turn by -R^T w about the other center, and a shift by -R^T s.
        detail::parameter_covariance<6> turned = covariance_matrix::Zero();
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j)
                turned(i, j) = turned(3 + i, 3 + j) = other.pose.rotation(i, j);
        }
        other.covariance = propagated(turned);
        return other;
    }

    /// The covariance if turns are about another place, in the frame of the surface [m]: that of
    /// the shift is then the covariance of this place. O(1).
    [[nodiscard]] covariance_matrix covariance_about(const Eigen::Vector3d& place) const {
        // w x d, for the offset d of the place from the center, is added to the shift.
        const Eigen::Vector3d d = detail::difference(place, center);
        covariance_matrix moved = covariance_matrix::Identity();
        moved(3, 1) = d.z();
        moved(3, 2) = -d.y();
        moved(4, 0) = -d.z();
        moved(4, 2) = d.x();
        moved(5, 0) = d.y();
        moved(5, 1) = -d.x();
        return propagated(moved);
    }

  private:
    /// A C A^T.
    [[nodiscard]] covariance_matrix propagated(const covariance_matrix& a) const {
        covariance_matrix left = covariance_matrix::Zero(), all = covariance_matrix::Zero();
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                for (int k = 0; k < 6; ++k) left(i, j) += a(i, k) * covariance(k, j);
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 6; ++j)
                for (int k = 0; k < 6; ++k) all(i, j) += left(i, k) * a(j, k);
        return all;
    }
};

/// The name of an outcome, for tables and messages.
[[nodiscard]] constexpr const char* to_string(alignment::outcome o) {
    switch (o) {
        case alignment::outcome::converged:
            return "converged";
        case alignment::outcome::not_converged:
            return "not_converged";
        case alignment::outcome::too_few_points:
            return "too_few_points";
        case alignment::outcome::degenerate:
            return "degenerate";
    }
    return "unknown";
}

}  // namespace gnomon

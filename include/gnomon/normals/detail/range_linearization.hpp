// SPDX-License-Identifier: BSL-1.0
/// @file
/// The state of the Kalman filters of planes, and two linearizations of the measured range about
/// it: by the derivative (extended filter) and by sigma points (unscented filter).
///
/// Klasing 2010, Sec. 3.2.7, Eqs. (3.17) and (3.18).
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/normals/detail/range_of_plane.hpp>
#include <gnomon/normals/detail/tangent_basis.hpp>

namespace gnomon::detail {

/// A plane near an anchor point, with the covariance of its three degrees of freedom: rotations
/// towards the two tangents [rad] and the distance along the normal [m].
struct plane_state {
    tangent_basis frame{Eigen::Vector3d(0.0, 0.0, 1.0)};
    double distance = 0.0;  ///< of the plane from the anchor [m]
    Eigen::Matrix3d covariance = diagonal(0.0, 0.0, 0.0);

    /// The state at the difference `delta` from this one, without a covariance.
    [[nodiscard]] plane_state moved(const Eigen::Vector3d& delta) const {
        return {tangent_basis(frame.moved(delta[0], delta[1]), frame), distance + delta[2]};
    }

    /// The range [m] at which the unit ray u from the view point meets the plane, Eq. (3.17).
    [[nodiscard]] double range(const Eigen::Vector3d& anchor, const Eigen::Vector3d& u) const {
        return range_of_plane(anchor, frame.normal, u, distance);
    }
};

/// A measurement linearized about a state: value + slope . delta + an error of this variance.
struct linear_range {
    double value;           ///< [m]
    Eigen::Vector3d slope;  ///< [m/rad], [m/rad], 1
    double variance = 0.0;  ///< of the error of linearization [m^2]
};

/// Constructed from a state and the anchor point of its plane, it linearizes the range along unit
/// rays.
template <class L>
concept range_linearization =
    std::constructible_from<L, const plane_state&, const Eigen::Vector3d&> &&
    requires(const L& linearize, const Eigen::Vector3d& u) {
        { linearize(u) } -> std::same_as<linear_range>;
    };

/// Linearizes by the derivative, Eq. (3.18).
class by_derivative {
  public:
    by_derivative(const plane_state& state, const Eigen::Vector3d& anchor)
        : state_(state), anchor_(anchor) {}

    /// The range along the unit ray u.
    [[nodiscard]] linear_range operator()(const Eigen::Vector3d& u) const {
        const auto& [n, b1, b2] = state_.frame;
        const Eigen::Vector3d gradient = range_gradient(anchor_, n, u, state_.distance);
        return {state_.range(anchor_, u), {dot(gradient, b1), dot(gradient, b2), 1.0 / dot(u, n)}};
    }

  private:
    const plane_state& state_;
    const Eigen::Vector3d& anchor_;
};

/// Linearizes by statistical linear regression over six sigma points of the state: the unscented
/// transform (Julier and Uhlmann 1997, kappa = 0). The variance of the residuals counts as noise.
class by_sigma_points {
  public:
    by_sigma_points(const plane_state& state, const Eigen::Vector3d& anchor)
        : anchor_(anchor), spread_(symmetric_eigen(state.covariance)) {
        for (int j = 0; j < 3; ++j) {
            const Eigen::Vector3d axis = column(spread_.vectors, j);
            const auto at = static_cast<std::size_t>(j);
            plus_[at] = state.moved(scaled(offset(j), axis));
            minus_[at] = state.moved(scaled(-offset(j), axis));
        }
    }

    /// The range along the unit ray u.
    [[nodiscard]] linear_range operator()(const Eigen::Vector3d& u) const {
        linear_range z{0.0, {0.0, 0.0, 0.0}};
        double squares = 0.0;
        double explained = 0.0;
        for (int j = 0; j < 3; ++j) {
            const auto at = static_cast<std::size_t>(j);
            const double plus = plus_[at].range(anchor_, u);
            const double minus = minus_[at].range(anchor_, u);
            const double slope = (plus - minus) / (2.0 * offset(j));
            z.value += (plus + minus) / 6.0;
            z.slope = combined(1.0, z.slope, slope, column(spread_.vectors, j));
            squares += (plus * plus + minus * minus) / 6.0;
            explained += slope * slope * spread_.values[j];
        }
        z.variance = std::max(0.0, squares - z.value * z.value - explained);
        return z;
    }

  private:
    [[nodiscard]] double offset(int j) const { return std::sqrt(3.0 * spread_.values[j]); }

    const Eigen::Vector3d& anchor_;
    eigen_decomposition spread_;
    std::array<plane_state, 3> plus_;
    std::array<plane_state, 3> minus_;
};

}  // namespace gnomon::detail

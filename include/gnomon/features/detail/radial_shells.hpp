// SPDX-License-Identifier: BSL-1.0
/// @file
/// Divisions of a ball into shells of equal ratios of their radii.
#pragma once

#include <algorithm>
#include <cstddef>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::detail {

/// R_s = r (R / r)^(s / S) for s = 0, ..., S. (A. Frome, D. Huber, R. Kolluri, T. Buelow and
/// J. Malik, Recognizing objects in range data using regional point descriptors, 2004, Eq. (1).)
class radial_shells {
  public:
    /// @param inner   r [m], 0 only for one shell
    /// @param radius  R [m]
    radial_shells(double inner, double radius, std::size_t shells)
        : inner_(inner),
          radius_(radius),
          shells_(shells),
          per_logarithm_(shells > 1 ? static_cast<double>(shells) / std::log(radius / inner)
                                    : 0.0) {}

    /// @throws std::invalid_argument  with `message` unless 0 <= inner < radius, both are finite,
    ///                                there are shells, and inner > 0 for more than one
    static void require_valid(double inner, double radius, std::size_t shells,
                              const char* message) {
        require(inner >= 0.0 && inner < radius && std::isfinite(radius) && shells > 0 &&
                    (shells == 1 || inner > 0.0),
                message);
    }

    /// Whether a distance [m] from the center is in one of the closed shells. The center is in
    /// none: it has no direction.
    [[nodiscard]] bool contains(double distance) const {
        return distance > 0.0 && distance >= inner_ && distance <= radius_;
    }
    /// The number of the shell. Precondition: contains(distance).
    [[nodiscard]] std::size_t shell_of(double distance) const {
        if (shells_ == 1) return 0;
        const double place = std::max(std::log(distance / inner_) * per_logarithm_, 0.0);
        return std::min(static_cast<std::size_t>(place), shells_ - 1);
    }
    /// R_s [m].
    [[nodiscard]] double boundary(std::size_t s) const {
        if (s == 0) return inner_;
        if (s == shells_) return radius_;
        return inner_ * std::exp(static_cast<double>(s) / per_logarithm_);
    }

  private:
    double inner_, radius_;
    std::size_t shells_;
    double per_logarithm_;
};

}  // namespace gnomon::detail

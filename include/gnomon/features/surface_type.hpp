// SPDX-License-Identifier: BSL-1.0
/// @file
/// Classification of a surface near a point into eight types, by the signs of Gaussian and mean
/// curvature. With normals that face the sensor, a peak points towards the sensor and a pit away
/// from it.
///
///              K > 0     K = 0     K < 0
///     H < 0    peak      ridge     saddle ridge
///     H = 0    -         flat      minimal
///     H > 0    pit       valley    saddle valley
///
/// Klasing 2010, Sec. 3.3.2, Figs. 3.13 and 3.14; P. Besl and R. Jain, Segmentation through
/// variable-order surface fitting, 1988.
#pragma once

#include <cstdint>

#include <gnomon/core/error.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/curvature.hpp>

namespace gnomon {

/// The surface types in the order of Fig. 3.13, and `unknown`.
enum class surface_type : std::uint8_t {
    peak,
    ridge,
    saddle_ridge,
    flat,
    minimal,
    saddle_valley,
    valley,
    pit,
    unknown  ///< the curvature is not usable, or K > 0 and H = 0
};

/// Returns the enumerator's name, for tables and messages.
[[nodiscard]] constexpr const char* to_string(surface_type t) {
    switch (t) {
        case surface_type::peak:
            return "peak";
        case surface_type::ridge:
            return "ridge";
        case surface_type::saddle_ridge:
            return "saddle_ridge";
        case surface_type::flat:
            return "flat";
        case surface_type::minimal:
            return "minimal";
        case surface_type::saddle_valley:
            return "saddle_valley";
        case surface_type::valley:
            return "valley";
        case surface_type::pit:
            return "pit";
        case surface_type::unknown:
            return "unknown";
    }
    return "unknown";
}

/// Classifies a curvature by the scheme of Besl and Jain: besl_jain{}(c). O(1).
///
/// The thesis gives no tolerances (docs/thesis-notes.md, A14). With the default, zero, every
/// nonzero sign counts, and only a noise-free plane parallel to two coordinate axes is `flat`. For
/// curvatures with an error of d [1/m] on surfaces of radius r [m], use a mean tolerance of d and a
/// Gaussian tolerance of d / r.
struct besl_jain {
    double gaussian_tolerance = 0.0;  ///< K counts as zero if |K| <= this [1/m^2]; at least 0
    double mean_tolerance = 0.0;      ///< H counts as zero if |H| <= this [1/m]; at least 0

    /// Classifies by the Gaussian curvature K [1/m^2] and the mean curvature H [1/m]. Since
    /// K <= H^2, K > 0 implies that H is not zero; its sign then decides even within the tolerance.
    /// @return the type; `unknown` if K > 0 and H = 0, or if either is NaN
    /// @throws std::invalid_argument  if a tolerance is negative or NaN
    [[nodiscard]] constexpr surface_type operator()(double K, double H) const {
        detail::require(gaussian_tolerance >= 0.0 && mean_tolerance >= 0.0,
                        "besl_jain: the tolerances must not be negative");
        if (K != K || H != H) return surface_type::unknown;
        if (K > gaussian_tolerance) {
            if (H == 0.0) return surface_type::unknown;
            return H < 0.0 ? surface_type::peak : surface_type::pit;
        }
        const bool saddle = K < -gaussian_tolerance;
        if (H < -mean_tolerance) return saddle ? surface_type::saddle_ridge : surface_type::ridge;
        if (H > mean_tolerance) return saddle ? surface_type::saddle_valley : surface_type::valley;
        return saddle ? surface_type::minimal : surface_type::flat;
    }

    /// Classifies a curvature.
    /// @return the type; `unknown` if the curvature is not usable
    /// @throws std::invalid_argument  if a tolerance is negative or NaN
    [[nodiscard]] surface_type operator()(const curvature& c) const {
        const surface_type type = (*this)(c.gaussian(), c.mean());
        return usable(c.trust) ? type : surface_type::unknown;
    }
};

}  // namespace gnomon

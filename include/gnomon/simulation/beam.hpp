// SPDX-License-Identifier: BSL-1.0
/// @file
/// The beam model of a range finder: noise, clutter, failed readings and the width of the beam.
///
/// Klasing 2010, Sec. 2.4.3, Fig. 2.13: the reading is Gaussian about the true range, or clutter
/// anywhere before the maximum, or the maximum range. The thesis names "skimmed points" (Sec. 5.8)
/// as the difference between its simulated and its real scans: a beam is about as wide as a finger,
/// and where it meets two surfaces at once, the instrument reports a range between them. The
/// footprint of the beam is modelled as a Gaussian, sampled by sub-rays of equal energy; the echo
/// rule says which of the echoes is reported.
#pragma once

#include <cstdint>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::simulation {

/// Which echo an instrument reports when its beam meets several surfaces.
enum class echo_rule : char {
    first,      ///< the nearest
    strongest,  ///< the echo with the most energy
    averaged    ///< the energy-weighted mean of all echoes
};

/// The width of a beam: w(r) = sqrt(waist^2 + (r tan(half divergence))^2) is the radius at which
/// the intensity has fallen to 1/e^2. Without waist and divergence, the default, the beam is a
/// line. Surfaces nearer to the sensor than the waist may be missed.
struct beam_footprint {
    double waist = 0.0;                 ///< w at the sensor [m]
    angle divergence = {};              ///< full angle of the far-field cone
    int sub_rays = 37;                  ///< number of samples; a line needs none
    echo_rule rule = echo_rule::first;  ///< which range is returned
    /// The instrument does not separate echoes nearer to each other than this, half the length of
    /// its pulse [m]: 0.45 to 0.75 for pulses of 3 to 5 ns.
    double echo_separation = 0.6;

    /// w(r) [m].
    [[nodiscard]] double radius(double range) const {
        return std::hypot(waist, range * std::tan(0.5 * divergence.radians()));
    }
    /// Whether it has no width.
    [[nodiscard]] bool is_line() const { return waist == 0.0 && divergence == radians(0); }
};

/// The errors of readings. By default there are none.
struct beam {
    double sigma = 0.0;  ///< standard deviation along the ray [m]
    /// Noise that grows with the range: adds (sigma_per_meter * range)^2 to the variance.
    double sigma_per_meter = 0.0;
    /// Noise that grows with the incidence: adds (grazing * w tan(incidence) / 2)^2 to the
    /// variance; 1 is the value that the geometry of the footprint gives.
    double grazing = 0.0;
    double clutter = 0.0;  ///< probability of a reading anywhere between 0 and the maximum range
    double failure = 0.0;  ///< probability of no reading at all
    beam_footprint footprint = {};  ///< its width
    bool keep_failed = false;       ///< failed readings become points at the maximum range
    std::uint64_t seed = 1;

    /// @throws std::invalid_argument  unless standard deviations and lengths are finite and not
    ///                                negative, probabilities add up to 1 at most, the divergence
    ///                                is less than 180 degrees, and there are 1 to 10,000 sub-rays
    void require_valid() const {
        using gnomon::detail::require;
        for (const double x :
             {sigma, sigma_per_meter, grazing, footprint.waist, footprint.echo_separation}) {
            require(x >= 0.0 && x < 1e6, "beam: lengths and factors must be from 0 to 1e6");
        }
        require(clutter >= 0.0 && failure >= 0.0 && clutter + failure <= 1.0,
                "beam: clutter and failure must be probabilities that add up to 1 at most");
        require(footprint.divergence >= radians(0) && footprint.divergence < degrees(180),
                "beam: the divergence must be from 0 to less than 180 degrees");
        require(footprint.sub_rays >= 1 && footprint.sub_rays <= 10'000,
                "beam: there must be 1 to 10,000 sub-rays");
    }
};

/// The origin of a reading.
enum class echo : std::uint8_t {
    surface,  ///< one surface, with noise
    mixed,    ///< a mean over several surfaces of the scene: a skimmed point
    clutter,  ///< no surface: uniform between 0 and the maximum range
    none      ///< no echo within the scanner's ranges; reported at the maximum range
};

}  // namespace gnomon::simulation

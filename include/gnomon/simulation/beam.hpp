// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a range finder makes of the truth: readings that scatter, fail, or lie.
///
/// Klasing 2010, Sec. 2.4.3, Fig. 2.13: the reading is Gaussian about the true range, or clutter
/// anywhere before the maximum, or the maximum range. That simulated scans were cleaner than real
/// ones the thesis puts down to "skimmed points" (Sec. 5.8), which hang in the air behind edges: a
/// beam is not a line but as wide as a finger, and where it meets two surfaces at once the
/// instrument reports something between. Here the footprint is a Gaussian sampled by sub-rays of
/// equal energy; which of its echoes counts is up to the instrument.
#pragma once

#include <cstdint>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// Which echo an instrument reports when its beam meets several surfaces.
enum class echo_rule : char {
    first,      ///< the nearest
    strongest,  ///< the one of most energy
    averaged    ///< the mean of all by energy, however far apart
};

/// The width of a beam: w(r) = sqrt(waist^2 + (r tan(half divergence))^2) is the radius at which
/// the intensity has fallen to 1/e^2. All zero, the default, is a line. Nothing is looked for
/// within the waist: walls are expected to be farther from the sensor than that.
struct beam_footprint {
    double waist = 0.0;     ///< w at the sensor [m]
    angle divergence = {};  ///< full angle of the cone, far away
    int sub_rays = 37;      ///< that sample it, where it is no line
    echo_rule rule = echo_rule::first;
    /// Echoes nearer to each other than this are one to the instrument, half the length of its
    /// pulse [m]: 0.45 to 0.75 for pulses of 3 to 5 ns.
    double echo_separation = 0.6;

    /// w(r) [m].
    [[nodiscard]] double radius(double range) const {
        return std::hypot(waist, range * std::tan(0.5 * divergence.radians()));
    }
    [[nodiscard]] bool is_line() const { return waist == 0.0 && divergence == radians(0); }
};

/// How readings deviate from the truth. The default does not.
struct beam {
    double sigma = 0.0;  ///< standard deviation along the ray [m]
    /// Grows with the range: adds (this times range)^2 to the variance.
    double sigma_per_meter = 0.0;
    /// Grazing beams scatter more: adds (this times w tan(incidence) / 2)^2 to the variance; 1 for
    /// what the geometry of the footprint says.
    double grazing = 0.0;
    double clutter = 0.0;  ///< probability of a reading anywhere between 0 and the maximum range
    double failure = 0.0;  ///< probability of no reading at all
    beam_footprint footprint = {};
    bool keep_failed = false;  ///< readings that failed are points at the maximum range
    std::uint64_t seed = 1;

    /// @throws std::invalid_argument  unless standard deviations and lengths are finite and not
    ///                                negative, probabilities add up to 1 at most, the divergence
    ///                                is less than 180 degrees, and there are 1 to 10,000 sub-rays
    void require_valid() const {
        using detail::require;
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

/// What became of a reading.
enum class echo : std::uint8_t {
    surface,  ///< of one surface, with noise
    mixed,    ///< a mean over several surfaces of the scene: a skimmed point. A mesh is one surface
    clutter,  ///< of nothing in particular
    none      ///< failed, or out of the scanner's ranges; stands at the maximum range
};

}  // namespace gnomon

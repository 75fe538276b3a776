// SPDX-License-Identifier: BSL-1.0
/// @file
/// How objects are found in a scan, and what is found: objects with their poses and the evidence
/// for them.
///
/// In no umbrella: include it by name.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/filters/remove_silhouettes.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/verification.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// How objects are found.
struct find_objects_options {
    /// Along the rays; else it is measured, and where it cannot be, that of constant_noise{}.
    std::optional<noise_curve> noise = std::nullopt;
    std::optional<plane> ground = std::nullopt;  ///< as in `perceive_views_options`
    Eigen::Vector3d up{0.0, 0.0, 1.0};           ///< as there
    /// Full angle of the beams; 0 for narrow ones. Wide beams return points that are behind edges
    /// by up to half of their width, and points between two surfaces: poses then rest on the
    /// others, where these determine them, and covariances include a shift of edges, by 3.5 % of
    /// the width of a beam, else 20 %.
    angle divergence = degrees(0.0);
    /// Of objects that are found, at least 0.05; formula: more probable than not.
    double min_probability = 0.5;

    /// @throws std::invalid_argument  unless the probability is from 0 to 1 and the divergence is
    ///                                from 0 to 90 degrees
    void require_valid() const {
        gnomon::detail::require(min_probability >= 0.0 && min_probability <= 1.0,
                                "find_objects: a probability is from 0 to 1");
        silhouette_options{.divergence = divergence}.require_valid();
    }
};

/// An object that was found.
struct found_object {
    std::size_t object = 0;  ///< its number
    alignment aligned;       ///< the pose of its frame in that of the scan, with covariance
    verification evidence;   ///< what the scan shows of it
    double votes = 0.0;      ///< for its pose: the sum over parts, each at most 1
    /// Natural logarithm of the probability that a recognizer gives the name of this object, by the
    /// parts of the points on its surface; 0 if it was not recognized.
    double log_recognized = 0.0;
    double probability = 0.0;  ///< that this object stands there
};

/// What was found in a scan of n points.
struct found_objects {
    std::vector<found_object> objects;  ///< the most probable one first
    segments points;                    ///< of the n points: those that each object explains
    perceived_views seen;               ///< groups of points and their parts, objects or not
};

}  // namespace gnomon::recognition

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
    /// As in `perceive_views_options`; where it is given, no ceiling is looked for.
    std::optional<plane> ground = std::nullopt;
    Eigen::Vector3d up{0.0, 0.0, 1.0};  ///< as there
    /// Full angle of the beams; 0 for narrow ones. Wide beams return points that are behind edges
    /// by up to half of their width, and points between two surfaces: the final poses of objects
    /// rest on the others, where these determine them, and covariances include a shift of
    /// edges, by 3.5 % of the width of a beam, else 20 %. Silhouettes are compared as beams of this
    /// width see them, so that probabilities depend on it, too.
    angle divergence = degrees(0.0);
    /// The probability of an object from which on it is found; 0.01 if it is less. Formula: more
    /// probable than not.
    double min_probability = 0.5;

    /// @throws std::invalid_argument  unless the probability is from 0 to 1, the divergence from 0
    ///                                to 90 degrees, and the directions are of unit length
    void require_valid() const {
        using gnomon::detail::require_hesse;
        gnomon::detail::require(min_probability >= 0.0 && min_probability <= 1.0,
                                "find_objects: min_probability must be from 0 to 1");
        require_hesse({up, 0.0}, "find_objects: up must be of unit length");
        if (ground)
            require_hesse(*ground, "find_objects: ground needs a unit normal and a finite offset");
        silhouette_options{.divergence = divergence}.require_valid();
    }
};

/// How the silhouette of an object at a pose agrees with the scan.
struct silhouette_match {
    /// On the object and around it, with nothing in front of it; 0 if it was not compared.
    std::size_t rays = 0;
    /// Intersection over union, from 0 to 1: the shares of beams that hit the object both by the
    /// model and in the scan, of those that hit it in at least one of the two.
    double overlap = 0.0;
    /// Of the rays that pass the model, the share that hits in the scan what continues one of its
    /// faces, from 0 to 1: large if the object is a part of something larger. It is shrunk towards
    /// this value, with the weight of 5 rays.
    double beyond = 0.25;
};

/// An object that was found.
struct found_object {
    std::size_t object = 0;  ///< its number
    /// The pose of its frame in that of the scan, where center and covariance are, too. Outcome,
    /// determined directions and inliers are those of its faces; where these leave it free to
    /// slide, pose and covariance come from its silhouette. A surface of revolution has any
    /// heading, with the variance of that, about its axis.
    alignment aligned;
    /// What the scan shows of it, before its pose was refined by whole beams and silhouette.
    verification evidence;
    silhouette_match silhouette;  ///< likewise before
    double votes = 0.0;           ///< for its pose: the sum over parts, each at most 1
    /// Natural logarithm of the probability that a recognizer gives the name of this object, by the
    /// parts of the points on its surface; 0 if it was not recognized.
    double log_recognized = 0.0;
    double probability = 0.0;  ///< that this object stands there
};

/// What was found in a scan of n points.
struct found_objects {
    std::vector<found_object> objects;  ///< the most probable one first
    segments points;       ///< of the n points: those on each object, at the pose before refinement
    perceived_views seen;  ///< groups of points and their parts, objects or not
};

}  // namespace gnomon::recognition

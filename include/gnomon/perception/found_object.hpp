// SPDX-License-Identifier: BSL-1.0
/// @file
/// An object that was found in a scan, with its pose and the evidence for it.
///
/// In no umbrella: include it by name.
#pragma once

#include <cstddef>

#include <gnomon/features/alignment.hpp>
#include <gnomon/recognition/verification.hpp>

namespace gnomon::recognition {

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

}  // namespace gnomon::recognition

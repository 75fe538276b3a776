// SPDX-License-Identifier: BSL-1.0
/// @file
/// Parts and views. A part is a segment of a scan, described by its shape; a view is what one scan
/// shows of one object: some parts, and the ground below them. Klasing 2010, Sec. 5.2.1.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <gnomon/core/plane.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/recognition/height_profile.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// A segment of a scan.
struct part {
    std::int32_t segment = unlabeled;  ///< its number among the segments
    segment_shape shape;               ///< its frame, normal and size
    /// Of the lowest and the highest point above the ground [m]; zero if the ground is unknown.
    double lowest = 0.0, highest = 0.0;
    height_profile profile;  ///< empty if the ground is unknown
};

/// The parts of one object in one scan.
struct view {
    std::vector<part> parts;      ///< that are surfaces; largest first
    std::optional<plane> ground;  ///< its normal is upwards
    height_profile rest;          ///< of points near the parts that belong to none
};

}  // namespace gnomon::recognition

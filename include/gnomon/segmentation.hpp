// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which points are one surface: pre-processing and the segmentations of Sec. 4.2.
#pragma once

#include <gnomon/segmentation/claim_strays.hpp>
#include <gnomon/segmentation/join_round.hpp>
#include <gnomon/segmentation/oriented_point_segmentation.hpp>
#include <gnomon/segmentation/plane_segmentation.hpp>
#include <gnomon/segmentation/point_segmentation.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/release_strays.hpp>
#include <gnomon/segmentation/segment_extension.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <gnomon/segmentation/surface_segmentation.hpp>

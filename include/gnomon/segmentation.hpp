// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which points are one surface: pre-processing and the segmentations of Sec. 4.2.
#pragma once

#include <gnomon/segmentation/assign_unlabeled.hpp>
#include <gnomon/segmentation/euclidean_clusters.hpp>
#include <gnomon/segmentation/leveling.hpp>
#include <gnomon/segmentation/plane_estimate.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/segment_oriented_points.hpp>
#include <gnomon/segmentation/segment_planes.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <gnomon/segmentation/split_outliers.hpp>

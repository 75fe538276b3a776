// SPDX-License-Identifier: BSL-1.0
/// @file
/// First steps of a pipeline: cropping, thinning, removal of outliers, of mixed points and of
/// points at silhouettes.
/// Not in gnomon.hpp.
#pragma once

#include <gnomon/filters/crop_box.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/filters/remove_mixed_points.hpp>
#include <gnomon/filters/remove_outliers.hpp>
#include <gnomon/filters/remove_silhouettes.hpp>
#include <gnomon/filters/subset.hpp>
#include <gnomon/filters/voxel_grid.hpp>

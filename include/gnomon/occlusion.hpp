// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which surfaces are one behind something: what was seen from where, the policies of merging, and
/// the merging itself.
#pragma once

#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/literal_merging.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/ray_spacing.hpp>
#include <gnomon/occlusion/visibility.hpp>

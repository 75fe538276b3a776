// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a point or a segment looks like, in a few numbers.
#pragma once

#include <gnomon/features/curvature.hpp>
#include <gnomon/features/estimate_curvature.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/features/surface_type.hpp>

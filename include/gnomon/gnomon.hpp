// SPDX-License-Identifier: BSL-1.0
/// @file
/// All floors of gnomon in their order: each header includes only headers of its own floor and of
/// the floors above it in this list; io includes only core. The chain of all steps,
/// <gnomon/perception.hpp>, the filters, <gnomon/filters.hpp>, between neighborhoods and normals,
/// and the simulator, <gnomon/simulation.hpp>, are included by name.
#pragma once

#include <gnomon/version.hpp>

// The order is that of the floors.
// clang-format off
#include <gnomon/core.hpp>
#include <gnomon/neighborhoods.hpp>
#include <gnomon/normals.hpp>
#include <gnomon/features.hpp>
#include <gnomon/segmentation.hpp>
#include <gnomon/occlusion.hpp>

#include <gnomon/io.hpp>
// clang-format on

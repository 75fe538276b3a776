// SPDX-License-Identifier: BSL-1.0
/// @file
/// gnomon: range scans into meaning. The table of contents, floor by floor: each header sees its
/// own floor and those above it in this list, except that io stands beside the tower and sees core
/// alone. So does the simulator, which robots do without: <gnomon/simulation.hpp>. The roof, all
/// floors in one call, is included by name: <gnomon/perception.hpp>.
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

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Beside the tower: scans of known scenes, with ground truth.
#pragma once

#include <gnomon/simulation/box_and_cylinder.hpp>

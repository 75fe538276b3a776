// SPDX-License-Identifier: BSL-1.0
/// @file
/// The chain of all steps, from points to surfaces: `perception` and its result.
#pragma once

#include <gnomon/perception/perception.hpp>
#include <gnomon/perception/perception_result.hpp>

// SPDX-License-Identifier: BSL-1.0
/// @file
/// All of the above, in one call.
#pragma once

#include <gnomon/perception/perception.hpp>
#include <gnomon/perception/perception_result.hpp>

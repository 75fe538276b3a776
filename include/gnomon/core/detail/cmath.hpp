// SPDX-License-Identifier: BSL-1.0
/// @file
/// Includes <cmath> exactly once per translation unit. The <cmath> of g++ 12 begins outside its
/// include guard, so each #include reads its two thousand lines again. This costs compile time in
/// every translation unit.
#pragma once

#include <cmath>

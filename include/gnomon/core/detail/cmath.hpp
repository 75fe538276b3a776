// SPDX-License-Identifier: BSL-1.0
/// @file
/// <cmath>, read once. That of g++ begins outside its include guard and so is read anew, all two
/// thousand lines, by every header that includes it. With hundreds of thousands of lines g++ also
/// runs out of short numbers for places in the source, and keeps a table of the others.
#pragma once

#include <cmath>

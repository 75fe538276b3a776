// SPDX-License-Identifier: BSL-1.0
/// @file
/// The version, in one place: CMake (and later Conan and vcpkg) read these three numbers.
#pragma once

#define GNOMON_VERSION_MAJOR 0
#define GNOMON_VERSION_MINOR 1
#define GNOMON_VERSION_PATCH 0

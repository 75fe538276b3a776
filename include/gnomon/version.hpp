// SPDX-License-Identifier: BSL-1.0
/// @file
/// The version, in one place: CMake reads these three numbers, and tools/packages.py writes them
/// into the files of packages.
#pragma once

#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 202002L
#error "gnomon needs C++20: -std=c++20, or target_compile_features(... cxx_std_20)"
#endif

/// The version of these headers, in three numbers: docs/versions.md.
#define GNOMON_VERSION_MAJOR 0
/// The second number.
#define GNOMON_VERSION_MINOR 2
/// The third number.
#define GNOMON_VERSION_PATCH 0

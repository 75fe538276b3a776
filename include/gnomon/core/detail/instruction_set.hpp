// SPDX-License-Identifier: BSL-1.0
/// @file
/// Selects the vector instructions of this translation unit: those that the compiler flags enable,
/// or none if GNOMON_PORTABLE_LANES is defined. If the flags enable only the SSE2 of every x86-64,
/// some loops are compiled for AVX2 as well and chosen at run time by the processor's features,
/// unless GNOMON_COMPILED_LANES is defined.
///
/// Code that depends on the selection is in the inline namespace GNOMON_LANES, so that translation
/// units with different flags can be linked into one program without violating the one-definition
/// rule. All other inline functions are shared between them: a program for an older processor must
/// be compiled as a whole for it.
#pragma once

#if defined(GNOMON_PORTABLE_LANES)
#define GNOMON_LANES portable
#define GNOMON_LANE_BITS 0
#elif defined(__AVX512F__)
#define GNOMON_LANES avx512
#define GNOMON_LANE_BITS 512
#elif defined(__AVX2__)
#define GNOMON_LANES avx2
#define GNOMON_LANE_BITS 256
#elif defined(__SSE2__) && defined(__x86_64__) && !defined(GNOMON_COMPILED_LANES)
#define GNOMON_LANES sse2_to_avx2
#define GNOMON_LANE_BITS 128
#define GNOMON_LANES_UP_TO_AVX2
#elif defined(__SSE2__)
#define GNOMON_LANES sse2
#define GNOMON_LANE_BITS 128
#else
#define GNOMON_LANES portable
#define GNOMON_LANE_BITS 0
#endif

/// The attribute of functions that are compiled for AVX2 and chosen at run time.
#if defined(GNOMON_LANES_UP_TO_AVX2)
#define GNOMON_WITH_AVX2 gnu::target("avx2,fma,bmi,popcnt")
#else
#define GNOMON_WITH_AVX2
#endif

#if GNOMON_LANE_BITS > 128
#include <immintrin.h>
#elif GNOMON_LANE_BITS == 128
#include <emmintrin.h>
#endif

namespace gnomon::detail {
inline namespace GNOMON_LANES {}
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which vector instructions there are to be used in this translation unit: as many as the compiler
/// was told of, none if GNOMON_PORTABLE_LANES is defined. Where it was told of none beyond those of
/// every x86-64, some loops are compiled for AVX2 too, and the processor is asked when they run,
/// unless GNOMON_COMPILED_LANES is defined. What depends on all that stands in the inline namespace
/// GNOMON_LANES, so that translation units for which it differs do not share it. (The rest they
/// share, as they share all inline functions: code for an older machine has its own program.)
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

/// The attribute of functions that use AVX2 and what comes with it.
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

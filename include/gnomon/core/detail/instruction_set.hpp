// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which vector instructions there are to be used in this translation unit: as many as the compiler
/// was told of, none if GNOMON_PORTABLE_LANES is defined. What depends on them stands in the inline
/// namespace GNOMON_LANES, which keeps translation units compiled for different machines from
/// sharing functions.
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
#elif defined(__SSE2__)
#define GNOMON_LANES sse2
#define GNOMON_LANE_BITS 128
#else
#define GNOMON_LANES portable
#define GNOMON_LANE_BITS 0
#endif

#if GNOMON_LANE_BITS > 128
#include <immintrin.h>
#elif GNOMON_LANE_BITS == 128
#include <emmintrin.h>
#endif

namespace gnomon::detail {
inline namespace GNOMON_LANES {}
}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Selects the vector instructions of this translation unit: those that the compiler flags enable,
/// or, if GNOMON_PORTABLE_LANES is defined, those that the compiler chooses for its built-in
/// vectors. Compilers without built-in vectors compute with single numbers, as all do if
/// GNOMON_SCALAR_LANES is defined. If the flags enable only the SSE2 of every x86-64, some loops
/// are compiled for AVX2 as well and chosen at run time by the processor's features, unless
/// GNOMON_COMPILED_LANES is defined.
///
/// Code that depends on the selection is in the inline namespace GNOMON_LANES, so that translation
/// units with different flags can be linked into one program without violating the one-definition
/// rule. All other inline functions are shared between them: a program for an older processor must
/// be compiled as a whole for it.
#pragma once

#include <gnomon/core/detail/attributes.hpp>

// Without SSE2, the x86 of 32 bits has another convention for vectors. On Windows, g++ does not
// align the stack for vectors of more than 16 bytes (its bug 54412).
#if !(defined(__GNUC__) || defined(__clang__)) || (defined(__i386__) && !defined(__SSE2__))
#define GNOMON_SCALAR_LANES
#elif defined(_WIN32) && !defined(__clang__)
#define GNOMON_NARROW_LANES
#endif

#if defined(GNOMON_SCALAR_LANES)
#define GNOMON_LANES scalar
#define GNOMON_LANE_BITS 0
#elif defined(GNOMON_PORTABLE_LANES)
#define GNOMON_LANES portable
#define GNOMON_LANE_BITS 0
#elif defined(__AVX512F__) && !defined(GNOMON_NARROW_LANES)
#define GNOMON_LANES avx512
#define GNOMON_LANE_BITS 512
#elif defined(__AVX2__) && !defined(GNOMON_NARROW_LANES)
#define GNOMON_LANES avx2
#define GNOMON_LANE_BITS 256
#elif defined(__SSE2__) && defined(__x86_64__) && defined(__GNUC__) && \
    !defined(GNOMON_NARROW_LANES) && !defined(GNOMON_COMPILED_LANES)
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

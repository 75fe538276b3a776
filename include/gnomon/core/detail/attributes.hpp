// SPDX-License-Identifier: BSL-1.0
/// @file
/// Attributes and pragmas that standard C++ does not have, for g++ and clang; nothing for other
/// compilers, which would warn. All are for performance or compile time only, but the one for a
/// sanitizer that the others do not have.
#pragma once

#if defined(__GNUC__) || defined(__clang__)
#define GNOMON_ALWAYS_INLINE gnu::always_inline
#define GNOMON_NOINLINE gnu::noinline
#define GNOMON_NO_SANITIZE_ADDRESS gnu::no_sanitize_address
#define GNOMON_PRAGMA(text) _Pragma(#text)
#define GNOMON_UNROLL(times) GNOMON_PRAGMA(GCC unroll times)
#else
#define GNOMON_ALWAYS_INLINE
#define GNOMON_NOINLINE
#define GNOMON_NO_SANITIZE_ADDRESS
#define GNOMON_UNROLL(times)
#endif

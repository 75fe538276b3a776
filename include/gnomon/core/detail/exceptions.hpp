// SPDX-License-Identifier: BSL-1.0
/// @file
/// Throwing and catching in one place, for programs compiled without exceptions (-fno-exceptions):
/// there, an error prints its message on stderr and aborts the program.
#pragma once

#if !defined(__cpp_exceptions) && !defined(_CPPUNWIND)
#define GNOMON_NO_EXCEPTIONS
#include <cstdio>
#include <cstdlib>
#endif

// try, catch (...), throw and throw; of the exception caught. (Macros for compile time only.)
#if defined(GNOMON_NO_EXCEPTIONS)
#define GNOMON_TRY if constexpr (true)
#define GNOMON_CATCH if constexpr (false)
#define GNOMON_THROW(...) ::gnomon::detail::end_with(__VA_ARGS__)
#define GNOMON_RETHROW static_cast<void>(0)
#else
#define GNOMON_TRY try
#define GNOMON_CATCH catch (...)
#define GNOMON_THROW(...) throw __VA_ARGS__
#define GNOMON_RETHROW throw
#endif

#if defined(GNOMON_NO_EXCEPTIONS)

namespace gnomon::detail {

template <class Problem>
[[noreturn]] void end_with(const Problem& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    std::abort();
}

}  // namespace gnomon::detail

#endif

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

/// Throws an exception. (A macro for compile time only.)
#if defined(GNOMON_NO_EXCEPTIONS)
#define GNOMON_THROW(...) ::gnomon::detail::end_with(__VA_ARGS__)
#else
#define GNOMON_THROW(...) throw __VA_ARGS__
#endif

namespace gnomon::detail {

#if defined(GNOMON_NO_EXCEPTIONS)
template <class Problem>
[[noreturn]] void end_with(const Problem& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    std::abort();
}
#endif

/// Calls work(). If it throws, calls otherwise(), where the exception is std::current_exception().
template <class Work, class Otherwise>
void attempt(const Work& work, [[maybe_unused]] const Otherwise& otherwise) {
#if defined(GNOMON_NO_EXCEPTIONS)
    work();
#else
    try {
        work();
    } catch (...) {
        otherwise();
    }
#endif
}

}  // namespace gnomon::detail

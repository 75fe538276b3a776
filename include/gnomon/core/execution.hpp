// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where the work runs: `sequential{}` or `threads{4}`, the last policy an algorithm takes. Work is
/// cut into the same chunks for every policy, so that results are the same bytes on any number of
/// threads.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <thread>

#include <gnomon/core/detail/thread_team.hpp>

namespace gnomon {

/// Everything on the calling thread.
struct sequential {
    /// Calls work(c) for c = 0, ..., chunks - 1.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        for (std::size_t c = 0; c < chunks; ++c) work(c);
    }
};

/// Up to n threads, the calling one among them.
struct threads {
    unsigned n = 0;  ///< 0 stands for all the hardware has

    /// The number of threads that will be asked for.
    [[nodiscard]] unsigned count() const {
        return n != 0 ? n : std::max(1u, std::thread::hardware_concurrency());
    }

    /// Calls work(c) once for each c in 0, ..., chunks - 1, in any order and concurrently. If calls
    /// throw, the exception of the smallest such c is thrown on, after all threads came to rest;
    /// chunks after it may have been left out. A machine that refuses threads gets fewer of them.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        detail::thread_team{count()}(chunks, work);
    }
};

/// Runs numbered chunks of work: x(chunks, work) calls work(c) once for each c < chunks and returns
/// when all are done. Models: `sequential`, `threads`.
template <class X>
concept execution = requires(const X& x, void (*work)(std::size_t)) { x(std::size_t{}, work); };

namespace detail {

/// The same execution for an algorithm of several steps: threads stay from the first to the last.
template <execution X>
[[nodiscard]] const X& staying(const X& run) {
    return run;
}
[[nodiscard]] inline staying_threads staying(const threads& run) {
    return staying_threads(run.count());
}

}  // namespace detail

/// Points per chunk of work: many enough to hide the handing out, few enough to balance it.
inline constexpr std::size_t chunk_size = 1024;

/// The number of chunks that n points make.
[[nodiscard]] constexpr std::size_t chunk_count(std::size_t n) {
    return (n + chunk_size - 1) / chunk_size;
}

/// Cuts {0, ..., n-1} into chunks of `chunk_size` consecutive numbers (the last one shorter) and
/// calls work(begin, end) on each.
template <execution X>
void for_each_chunk(const X& run, std::size_t n, auto&& work) {
    run(chunk_count(n),
        [&work, n](std::size_t c) { work(c * chunk_size, std::min(n, (c + 1) * chunk_size)); });
}

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where work runs: `sequential{}`, `threads{4}`, which start for each algorithm, or a `team(4)`,
/// which keeps its threads from one call to the next. An execution is the last argument of an
/// algorithm before the projection. Work is cut into the same chunks for every execution, so that
/// results are the same bytes on any number of threads.
///
/// A user's own execution, e.g. over a thread pool, is a callable: run(chunks, work) calls work(c)
/// once for each c < chunks, in any order and concurrently, and returns when all calls have ended.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <memory>

#include <gnomon/core/detail/thread_team.hpp>

namespace gnomon {

/// Everything on the calling thread.
struct sequential {
    /// Calls work(c) for c = 0, ..., chunks - 1.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        for (std::size_t c = 0; c < chunks; ++c) work(c);
    }
};

/// Up to n threads, the calling one among them, which end with the algorithm.
struct threads {
    unsigned n = 0;  ///< 0 stands for all the hardware has

    /// The number of threads that will be asked for.
    [[nodiscard]] unsigned count() const { return n != 0 ? n : detail::hardware_threads(); }

    /// Calls work(c) once for each c in 0, ..., chunks - 1, in any order and concurrently. If calls
    /// throw, the exception of the smallest such c is rethrown after all threads have finished;
    /// chunks after it may be left out. A machine that refuses threads gets fewer of them.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        detail::thread_team{count()}(chunks, work);
    }
};

/// Up to n threads, the calling one among them, that stay as long as the team and its copies, which
/// share them: for algorithms that are called again and again. The threads start with the first
/// call. A call from a second thread while the team is at work runs on that second thread alone.
class team {
  public:
    /// @param n  0 stands for all the hardware has
    explicit team(unsigned n = 0)
        : team_(std::make_shared<detail::thread_team>(threads{n}.count())) {}

    /// The same contract as that of `threads`.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        (*team_)(chunks, work);
    }

  private:
    std::shared_ptr<detail::thread_team> team_;
};

/// run(chunks, work) calls work(c) once for each c < chunks and returns when all calls have ended.
/// Models: `sequential`, `threads`, `team`, `supervised`, and a user's own.
template <class X>
concept execution = requires(const X& x, void (*work)(std::size_t)) {
    { x(std::size_t{}, work) } -> std::same_as<void>;
};

namespace detail {

/// The same execution for an algorithm of several steps: its threads stay from the first step to
/// the last.
[[nodiscard]] inline team staying(const threads& run) { return team(run.count()); }
template <execution X>
[[nodiscard]] decltype(auto) staying(const X& run) {
    if constexpr (requires { run.staying(); })
        return run.staying();
    else
        return (run);
}

/// Points per chunk of work (performance only): enough to hide the cost of handing out a chunk, few
/// enough to balance the load.
inline constexpr std::size_t chunk_size = 1024;

/// The number of chunks of n points.
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

}  // namespace detail
}  // namespace gnomon

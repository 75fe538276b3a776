// SPDX-License-Identifier: BSL-1.0
/// @file
/// All use of threads and of thread-local values in gnomon: the number of hardware threads, a
/// mutex, variables of each thread, and a team of threads that stays alive between the steps of an
/// algorithm. On platforms without threads, and where GNOMON_NO_THREADS is defined, the calling
/// thread does all work.
///
/// To start a thread, or to wake one, takes as long as many a step; so a thread without work polls
/// for a millisecond before it sleeps, and the caller does not wait for threads that have not yet
/// begun when the work is done.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <exception>

#if !defined(GNOMON_NO_THREADS) && (defined(__wasi__) || defined(_LIBCPP_HAS_NO_THREADS) || \
                                    (defined(__GLIBCXX__) && !defined(_GLIBCXX_HAS_GTHREADS)))
#define GNOMON_NO_THREADS
#endif

#if !defined(GNOMON_NO_THREADS)
#include <atomic>
#include <mutex>
#include <thread>  // has the clocks of <chrono> without its calendars, which take long to read
#include <vector>
#endif

#include <gnomon/core/detail/exceptions.hpp>

namespace gnomon::detail {

#if defined(GNOMON_NO_THREADS)

[[nodiscard]] inline unsigned hardware_threads() { return 1; }

/// Nothing to be guarded from.
struct mutex {};
struct guard_of {
    explicit guard_of(mutex&) {}
};

/// A variable of type T.
template <class T>
[[nodiscard]] T& thread_value() noexcept {
    static T value{};
    return value;
}

/// The calling thread alone.
class thread_team {
  public:
    explicit thread_team(std::size_t) {}

    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) {
        for (std::size_t c = 0; c < chunks; ++c) work(c);
    }
};

#else

/// At least 1.
[[nodiscard]] inline unsigned hardware_threads() {
    return std::max(1u, std::thread::hardware_concurrency());
}

using mutex = std::mutex;
using guard_of = std::lock_guard<std::mutex>;

/// A variable of type T that each thread has of its own.
template <class T>
[[nodiscard]] T& thread_value() noexcept {
    static thread_local T value{};
    return value;
}

/// The calling thread and helpers, which start with the first work.
class thread_team {
  public:
    /// A team of at most `size` threads, the calling one among them.
    explicit thread_team(std::size_t size) : size_(size) {}
    thread_team(const thread_team&) = delete;
    thread_team& operator=(const thread_team&) = delete;
    ~thread_team() {
        stopping_ = true;
        call();
        for (std::thread& helper : helpers_) helper.join();
    }

    /// Calls work(c) once for each c in 0, ..., chunks - 1, as `threads` does. While the team
    /// is at work, another call, also a nested one, runs on the thread that makes it.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) {
        std::atomic<std::size_t> next{0};
        std::atomic<std::size_t> failed{chunks};
        std::exception_ptr failure;
        mutex guard;
        const auto drain = [&]() noexcept {
            for (std::size_t c = next++; c < failed; c = next++) {
                GNOMON_TRY { work(c); }
                GNOMON_CATCH {
                    const guard_of locked(guard);
                    if (c < failed) {
                        failed = c;
                        failure = std::current_exception();
                    }
                }
            }
        };
        if (chunks > 1 && size_ > 1 && !busy_.exchange(true)) {
            grow_to(std::min(size_, chunks));
            share(drain);
            busy_ = false;
        } else {
            drain();
        }
        if (failure) std::rethrow_exception(failure);
    }

  private:
    /// Where the machine refuses threads or memory, the team stays as small as it is. (A template,
    /// so that only users of threads compile it.)
    void grow_to(std::integral auto size) noexcept {
        GNOMON_TRY {
            while (helpers_.size() + 1 < size)
                helpers_.emplace_back([this, heard = calls_.load()] { help(heard); });
        }
        GNOMON_CATCH {}
    }

    /// Opens the work to the helpers, does it with those that enter, closes it, and waits until all
    /// of them have left: from then on `work` may be destroyed.
    template <class Work>
    void share(const Work& work) noexcept {
        work_ = &work;
        do_ = [](const void* w) { (*static_cast<const Work*>(w))(); };
        inside_ -= closed;
        call();
        work();
        inside_ += closed;
        for (unsigned i = inside_; i != closed; i = inside_) wait_while(inside_, i);
    }

    /// The loop of a helper: waits for a call, joins the work if it is open, and leaves.
    void help(unsigned heard) {
        for (;;) {
            wait_while(calls_, heard);
            heard = calls_;
            if (stopping_) return;
            if (inside_++ < closed) do_(work_);
            if (--inside_ == closed) inside_.notify_one();
        }
    }

    void call() {
        ++calls_;
        calls_.notify_all();
    }

    static void wait_while(const std::atomic<unsigned>& value, unsigned old) {
        using clock = std::chrono::steady_clock;
        const auto end_of_patience = clock::now() + std::chrono::milliseconds(1);
        while (value == old) {
            if (clock::now() < end_of_patience)
                std::this_thread::yield();
            else
                value.wait(old);
        }
    }

    static constexpr unsigned closed = 1u << 31;

    std::size_t size_;
    std::atomic<bool> busy_{false};
    std::atomic<unsigned> calls_{0};
    std::atomic<unsigned> inside_{closed};  // helpers, plus `closed` while there is no work
    std::atomic<bool> stopping_{false};
    const void* work_ = nullptr;
    void (*do_)(const void*) = nullptr;
    std::vector<std::thread> helpers_;
};

#endif

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Threads that stay between one step of an algorithm and the next. To start a thread, or to wake
/// one, takes as long as many a step; so a thread without work looks out for some for a while
/// before it falls asleep, and nobody waits for one that comes when the work is done.
#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>  // has the clocks of <chrono> without its calendars, which take long to read
#include <vector>

namespace gnomon::detail {

/// The calling thread, and helpers, which are started when there first is work for them.
class thread_team {
  public:
    /// A team of at most `size` threads, the calling one among them.
    explicit thread_team(std::size_t size) : size_(size) {}
    thread_team(const thread_team&) = delete;
    thread_team& operator=(const thread_team&) = delete;
    ~thread_team() {
        stopping_ = true;
        call();
    }

    /// Calls work(c) once for each c in 0, ..., chunks - 1, as `threads` says. While the team is at
    /// work, another call, be it from within that work, is done by the thread that makes it.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) {
        std::atomic<std::size_t> next{0};
        std::atomic<std::size_t> failed{chunks};
        std::exception_ptr failure;
        std::mutex guard;
        const auto drain = [&]() noexcept {
            for (std::size_t c = next++; c < failed; c = next++) {
                try {
                    work(c);
                } catch (...) {
                    const std::lock_guard lock(guard);
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
    /// Where the machine refuses threads or memory, the team stays as small as it is.
    void grow_to(std::size_t size) noexcept {
        try {
            while (helpers_.size() + 1 < size)
                helpers_.emplace_back([this, heard = calls_.load()] { help(heard); });
        } catch (const std::exception&) {
        }
    }

    /// Opens the work to the helpers, does it with those that enter, closes it, and waits until all
    /// of them have left: from then on it may be gone.
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

    /// What a helper does; a work that it finds closed it does not touch.
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
    std::vector<std::jthread> helpers_;  // last: joined before what they use is gone
};

/// The execution by a team that stays as long as this and its copies do.
class staying_threads {
  public:
    explicit staying_threads(std::size_t size) : team_(std::make_shared<thread_team>(size)) {}

    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        (*team_)(chunks, work);
    }

  private:
    std::shared_ptr<thread_team> team_;
};

}  // namespace gnomon::detail

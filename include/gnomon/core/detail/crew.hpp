// SPDX-License-Identifier: BSL-1.0
/// @file
/// Threads that stay between one step of an algorithm and the next. To start a thread, or to wake
/// one, takes as long as many a step; so who has nothing to do looks out for work for a while
/// before falling asleep, and nobody waits for who comes when the work is done.
#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>  // has the clocks of <chrono> without its calendars, which take long to read
#include <vector>

namespace gnomon::detail {

/// The thread that calls, and helpers, who are started once there is work for them.
class crew {
  public:
    /// Of so many at most, the calling one among them.
    explicit crew(std::size_t size) : size_(size) {}
    crew(const crew&) = delete;
    crew& operator=(const crew&) = delete;
    ~crew() {
        dissolved_ = true;
        call();
    }

    /// Calls work(c) as `threads` does. Not to be called by two threads at a time.
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) {
        std::atomic<std::size_t> next{0};
        std::atomic<std::size_t> failed{chunks};
        std::exception_ptr failure;
        std::mutex guard;
        const auto drain = [&] {
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
        grow_to(std::min(size_, chunks));
        share(drain);
        if (failure) std::rethrow_exception(failure);
    }

  private:
    /// The chunks are drained by the threads that a machine does not refuse.
    void grow_to(std::size_t size) {
        try {
            while (helpers_.size() + 1 < size)
                helpers_.emplace_back([this, heard = calls_.load()] { help(heard); });
        } catch (const std::system_error&) {
            size_ = helpers_.size() + 1;
        }
    }

    /// Works together with the helpers that come before it is done.
    template <class Work>
    void share(const Work& work) {
        if (helpers_.empty()) return work();
        work_ = &work;
        do_ = [](const void* w) { (*static_cast<const Work*>(w))(); };
        inside_ -= closed;
        call();
        work();
        inside_ += closed;
        for (unsigned i = inside_; i != closed; i = inside_) wait_while(inside_, i);
    }

    void help(unsigned heard) {
        for (;;) {
            wait_while(calls_, heard);
            heard = calls_;
            if (dissolved_) return;
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
    std::atomic<unsigned> calls_{0};
    std::atomic<unsigned> inside_{closed};  // helpers, plus `closed` while there is no work
    std::atomic<bool> dissolved_{false};
    const void* work_ = nullptr;
    void (*do_)(const void*) = nullptr;
    std::vector<std::jthread> helpers_;  // last: joined before what they use is gone
};

/// The execution by a crew that stays as long as this does.
class staying_threads {
  public:
    explicit staying_threads(std::size_t size) : crew_(std::make_unique<crew>(size)) {}

    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        (*crew_)(chunks, work);
    }

  private:
    std::unique_ptr<crew> crew_;
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How much is done, and how long will the rest take? A bar on stderr, if that is a terminal.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>

#include "common/progress.hpp"
#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

/// Counts steps of about equal duration, on any thread.
class progress_bar {
  public:
    progress_bar(std::string what, std::size_t steps) : what_(std::move(what)), steps_(steps) {}
    progress_bar(const progress_bar&) = delete;
    progress_bar& operator=(const progress_bar&) = delete;
    ~progress_bar() {
        if (is_terminal_) std::fputs("\r\033[K", stderr);
    }

    /// One more step is done.
    void step() {
        const std::size_t done = ++done_;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!is_terminal_ || !lock) return;
        constexpr double pause = 0.1;  // between two drawings [s]
        const double seconds = watch_.seconds();
        if (seconds < drawn_ + pause) return;
        drawn_ = seconds;
        constexpr std::size_t width = 30;
        const std::size_t full = done * width / steps_;
        const double left =
            seconds * static_cast<double>(steps_ - done) / static_cast<double>(done);
        std::fprintf(stderr, "\r%s [%s%s] %zu of %zu, %.0f s left \033[K", what_.c_str(),
                     std::string(full, '#').c_str(), std::string(width - full, '.').c_str(), done,
                     steps_, left);
        std::fflush(stderr);
    }

  private:
    static bool stderr_is_terminal() {
#ifdef _WIN32
        return _isatty(_fileno(stderr)) != 0;
#else
        return isatty(fileno(stderr)) != 0;
#endif
    }

    std::string what_;
    std::size_t steps_;
    std::atomic<std::size_t> done_ = 0;
    bool is_terminal_ = stderr_is_terminal();
    std::mutex mutex_;
    double drawn_ = 0.0;
    stopwatch watch_;
};

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How long does it take? A stop watch, and a word on stderr for those who wait.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

/// Seconds since it was made.
class stopwatch {
  public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// While it lives, says on stderr what takes so long: after a second, then after 2, 4, 8 seconds.
/// (Without std::jthread, which libc++ 16 does not have.)
class progress {
  public:
    explicit progress(std::string what)
        : thread_([this, what = std::move(what)] {
              std::unique_lock lock(mutex_);
              for (int waited = 0;; waited = waited == 0 ? 1 : 2 * waited) {
                  const std::chrono::seconds pause(waited == 0 ? 1 : waited);
                  if (end_.wait_for(lock, pause, [this] { return is_over_; })) return;
                  std::fprintf(stderr, "%s ... %d s\n", what.c_str(), waited == 0 ? 1 : 2 * waited);
              }
          }) {}
    progress(const progress&) = delete;
    progress& operator=(const progress&) = delete;
    ~progress() {
        {
            const std::lock_guard lock(mutex_);
            is_over_ = true;
        }
        end_.notify_all();
        thread_.join();
    }

  private:
    std::mutex mutex_;
    std::condition_variable end_;
    bool is_over_ = false;
    std::thread thread_;
};

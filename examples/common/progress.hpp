// SPDX-License-Identifier: BSL-1.0
/// @file
/// How long does it take? A stop watch, and a word on stderr for those who wait.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

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
class progress {
  public:
    explicit progress(std::string what)
        : thread_([what = std::move(what)](const std::stop_token& stop) {
              std::mutex mutex;
              std::condition_variable_any alarm;
              std::unique_lock lock(mutex);
              for (int waited = 0;; waited = waited == 0 ? 1 : 2 * waited) {
                  const std::chrono::seconds pause(waited == 0 ? 1 : waited);
                  alarm.wait_for(lock, stop, pause, [] { return false; });
                  if (stop.stop_requested()) return;
                  std::fprintf(stderr, "%s ... %d s\n", what.c_str(), waited == 0 ? 1 : 2 * waited);
              }
          }) {}

  private:
    std::jthread thread_;
};

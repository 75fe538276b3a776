// SPDX-License-Identifier: BSL-1.0
/// @file
/// Measures elapsed time.
#pragma once

#include <gnomon/core/detail/thread_team.hpp>  // <thread> has the clocks of <chrono>, not its calendars

#if defined(GNOMON_NO_THREADS)
#include <chrono>
#endif

namespace gnomon::detail {

/// Starts at construction.
class stopwatch {
  public:
    /// The time since construction [s].
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(clock::now() - start_).count();
    }

  private:
    using clock = std::chrono::steady_clock;

    clock::time_point start_ = clock::now();
};

}  // namespace gnomon::detail

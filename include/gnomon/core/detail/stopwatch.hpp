// SPDX-License-Identifier: BSL-1.0
/// @file
/// How long a step takes.
#pragma once

#include <gnomon/core/detail/thread_team.hpp>  // <thread> has the clocks of <chrono>, not its calendars

#if defined(GNOMON_NO_THREADS)
#include <chrono>
#endif

namespace gnomon::detail {

/// Starts when it is made.
class stopwatch {
  public:
    /// Since then [s].
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(clock::now() - start_).count();
    }

  private:
    using clock = std::chrono::steady_clock;

    clock::time_point start_ = clock::now();
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How much memory did it take? What the kernel keeps of this process's resident set (Linux; zero
/// elsewhere).
#pragma once

#include <cstddef>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace peers {

namespace detail {

/// A size in /proc/self/status [bytes], e.g. "VmHWM:".
inline std::size_t status_bytes(std::string_view field) {
    std::ifstream status("/proc/self/status");
    std::string word;
    std::size_t kibibytes = 0;
    while (status >> word && word != field) {
        status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    status >> kibibytes;
    return 1024 * kibibytes;
}

}  // namespace detail

/// Watches the resident set from its construction on.
class peak_memory {
  public:
    peak_memory() {
        std::ofstream("/proc/self/clear_refs") << 5;  // the peak so far is forgotten
        before_ = detail::status_bytes("VmRSS:");
    }

    /// The highest resident set since then, less what there was [bytes].
    [[nodiscard]] std::size_t above() const { return total() > before_ ? total() - before_ : 0; }

    /// The highest resident set since then, of the whole process [bytes].
    [[nodiscard]] std::size_t total() const { return detail::status_bytes("VmHWM:"); }

  private:
    std::size_t before_;
};

}  // namespace peers

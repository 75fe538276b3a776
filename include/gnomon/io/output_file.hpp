// SPDX-License-Identifier: BSL-1.0
/// @file
/// A file that appears whole or not at all: what is written goes to a sibling, which takes the
/// file's name at the very end.
#pragma once

#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <gnomon/io/detail/file_target.hpp>
#include <gnomon/io/detail/os_error.hpp>

namespace gnomon::io {

/// Writes the file `path`, links followed. Until `commit` an older file of that name is untouched;
/// without it, nothing is left behind.
class output_file {
  public:
    /// @throws gnomon::error  if `path` leads to something else than a file, or with the system's
    ///                        reason, if none can be made beside it
    explicit output_file(const std::string& path) : path_(detail::file_target(path)) {
        // "x": neither a file of the user's nor that of another process is overwritten.
        constexpr int most_tries = 100;
        for (int i = 0; i < most_tries && file_ == nullptr; ++i) {
            sibling_ = path_ + ".part" + std::to_string(i);
            file_ = std::fopen(sibling_.c_str(), "wbx");
            if (file_ == nullptr && errno != EEXIST) break;
        }
        if (file_ == nullptr) throw detail::os_error(path_, errno);
    }

    output_file(const output_file&) = delete;
    output_file& operator=(const output_file&) = delete;

    ~output_file() {
        if (file_ != nullptr) std::fclose(file_);
        if (!sibling_.empty()) std::remove(sibling_.c_str());
    }

    /// Appends `bytes`. Precondition: not committed.
    /// @throws gnomon::error  with the system's reason, e.g. if the disk is full
    void write(std::string_view bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
            throw detail::os_error(path_, errno);
    }

    /// Gives the file its name; an older one is replaced.
    /// @throws gnomon::error  with the system's reason, if this or the last of writing fails
    void commit() {
        if (std::fclose(std::exchange(file_, nullptr)) != 0) throw detail::os_error(path_, errno);
#ifdef _WIN32
        std::remove(path_.c_str());  // there, rename does not replace
#endif
        if (std::rename(sibling_.c_str(), path_.c_str()) != 0) throw detail::os_error(path_, errno);
        sibling_.clear();
    }

  private:
    std::string path_;
    std::string sibling_;  // empty once it has taken the name
    std::FILE* file_ = nullptr;
};

/// Writes `bytes` to the file `path`, whole or not at all.
/// @throws gnomon::error  with the system's reason
inline void replace_file(const std::string& path, std::string_view bytes) {
    output_file file(path);
    file.write(bytes);
    file.commit();
}

}  // namespace gnomon::io

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Atomic writing of files: the bytes go to a temporary file in the same directory, which is
/// renamed to its final name when it is complete.
#pragma once

#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include <gnomon/io/detail/file_target.hpp>
#include <gnomon/io/detail/os_error.hpp>

namespace gnomon::io {

/// A file that is being written. An existing file of that name stays unchanged until `commit`; if
/// `commit` is not called, the destructor removes the temporary file. Symbolic links are followed.
class output_file {
  public:
    /// Creates the temporary file for the file `path`.
    /// @throws gnomon::error  if `path` is not a regular file, or, with the operating system's
    ///                        message, if no file can be created in its directory
    explicit output_file(const std::string& path) : path_(detail::file_target(path)) {
        // Mode "x" fails for existing files, so no file of the user or of another process is
        // overwritten.
        constexpr int max_attempts = 100;
        for (int i = 0; i < max_attempts && file_ == nullptr; ++i) {
            temporary_ = path_ + ".part" + std::to_string(i);
            file_ = std::fopen(temporary_.c_str(), "wbx");
            if (file_ == nullptr && errno != EEXIST) break;
        }
        if (file_ == nullptr) GNOMON_THROW(detail::os_error(path_, errno));
    }

    output_file(const output_file&) = delete;
    output_file& operator=(const output_file&) = delete;

    ~output_file() {
        if (file_ != nullptr) std::fclose(file_);
        if (!temporary_.empty()) std::remove(temporary_.c_str());
    }

    /// Appends `bytes`. Precondition: not committed.
    /// @throws gnomon::error  with the operating system's message, e.g. if the disk is full
    void write(std::string_view bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
            GNOMON_THROW(detail::os_error(path_, errno));
    }

    /// Renames the temporary file to its final name and replaces an existing file. Precondition:
    /// not committed.
    /// @throws gnomon::error  with the operating system's message, if writing or renaming fails
    void commit() {
        if (std::fclose(std::exchange(file_, nullptr)) != 0)
            GNOMON_THROW(detail::os_error(path_, errno));
#ifdef _WIN32
        std::remove(path_.c_str());  // rename does not replace files on Windows
#endif
        if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
            GNOMON_THROW(detail::os_error(path_, errno));
        temporary_.clear();
    }

  private:
    std::string path_;       // final name
    std::string temporary_;  // name of the temporary file; empty after commit
    std::FILE* file_ = nullptr;
};

/// Writes `bytes` to the file `path` atomically; an existing file is replaced or stays unchanged.
/// @throws gnomon::error  with the operating system's message
inline void replace_file(const std::string& path, std::string_view bytes) {
    output_file file(path);
    file.write(bytes);
    file.commit();
}

}  // namespace gnomon::io

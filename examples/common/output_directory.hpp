// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where do the results go? Into a directory that is there, and lets itself be written to, before
/// the work begins.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/io/output_file.hpp>

/// The directory that a program writes its files into.
class output_directory {
  public:
    /// Creates it if it is missing, and tests that each of the `files` can be written, so that a
    /// program fails before its computation and not after it. The test leaves no files.
    /// @throws gnomon::error  with the system's reason
    output_directory(std::string path, std::vector<std::string> files)
        : path_(std::move(path)), files_(std::move(files)) {
        std::error_code problem;
        std::filesystem::create_directories(path_, problem);
        if (problem) throw gnomon::error(path_, "", problem.message());
        for (const std::string& file : files_) const gnomon::io::output_file trial(*this / file);
    }

    friend std::string operator/(const output_directory& directory, const std::string& file) {
        return directory.path_ + "/" + file;
    }

    /// Says on stdout what was written.
    void report() const {
        std::string list;
        for (const std::string& file : files_) list += (list.empty() ? "" : ", ") + file;
        std::printf("\nwrote %s into %s\n", list.c_str(), path_.c_str());
    }

  private:
    std::string path_;
    std::vector<std::string> files_;
};

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How does a program end? With what it was asked for, with its usage, or with a word on stderr.
#pragma once

#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include <gnomon/core/error.hpp>

/// Does `work` with the options that `options_from` finds in the words of the command line; prints
/// `usage` if these ask for help.
/// @return the exit status: 0, 1 if the work failed, 2 if the command line makes no sense
template <class Options>
int run_program(const char* name, const char* usage,
                std::optional<Options> (*options_from)(const std::vector<std::string>& words),
                void (*work)(const Options& o), int argc, char** argv) {
    try {
        if (const auto o = options_from({argv + 1, argv + argc})) {
            work(*o);
        } else {
            std::fputs(usage, stdout);
        }
        if (std::fflush(stdout) != 0)
            throw gnomon::error("standard output", "", "cannot be written");
        return 0;
    } catch (const usage_error& problem) {
        std::fprintf(stderr, "%s: %s\n%s", name, problem.what(), usage);
        return 2;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s: %s\n", name, problem.what());
        return 1;
    }
}

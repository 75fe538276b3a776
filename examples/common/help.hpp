// SPDX-License-Identifier: BSL-1.0
/// @file
/// What does a program do, and with which arguments? Its usage, for --help.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

/// The usage of a program: its name, as it was called, and its arguments.
/// @param arguments  none, or with a space before
inline std::string usage_of(std::string_view program, std::string_view arguments) {
    program.remove_prefix(program.find_last_of('/') + 1);  // of npos + 1: nothing
    return "usage: " + std::string(program) + std::string(arguments) + "\n";
}

/// Prints the usage of a program, and what it does, if --help is among the words of its command
/// line.
/// @param what       "Prints ...", a sentence or some
/// @param arguments  none, or with a space before: " [SCAN]"
/// @return whether it did: then the program is to end, with 0
inline bool printed_help(int argc, char** argv, std::string_view what,
                         std::string_view arguments = "") {
    for (int i = 1; i < argc; ++i) {
        if (std::string_view(argv[i]) != "--help") continue;
        std::printf("%s\n%s\n", usage_of(argv[0], arguments).c_str(), std::string(what).c_str());
        return true;
    }
    return false;
}

// SPDX-License-Identifier: BSL-1.0
/// @file
/// How `read` finds the reader of LAS files, which is not compiled into every program: the header
/// of the reader enters it here.
#pragma once

#include <string>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io::detail {

/// `read_las`, in programs of which a file includes <gnomon/io/read_las.hpp>; else null. Set before
/// main.
inline scan (*las_reader)(const input& file, const std::vector<std::string>& fields) = nullptr;

}  // namespace gnomon::io::detail

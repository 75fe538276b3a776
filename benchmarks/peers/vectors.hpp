// SPDX-License-Identifier: BSL-1.0
/// @file
/// A list of vectors in a file: bare doubles, x y z after x y z, for other programs of this
/// machine.
#pragma once

#include <cstddef>
#include <fstream>
#include <ios>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace peers {

using vectors = std::vector<Eigen::Vector3d>;

static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));

/// @throws std::runtime_error  if the file cannot be written
inline void write_vectors(const std::string& path, const vectors& list) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(list.data()),
               static_cast<std::streamsize>(list.size() * sizeof(Eigen::Vector3d)));
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

/// @throws std::runtime_error  if the file cannot be read
inline vectors read_vectors(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw std::runtime_error("cannot read " + path);
    vectors list(static_cast<std::size_t>(file.tellg()) / sizeof(Eigen::Vector3d));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(list.data()),
              static_cast<std::streamsize>(list.size() * sizeof(Eigen::Vector3d)));
    if (!file) throw std::runtime_error("cannot read " + path);
    return list;
}

}  // namespace peers

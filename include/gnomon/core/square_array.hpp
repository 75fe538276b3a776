// SPDX-License-Identifier: BSL-1.0
/// @file
/// Small square matrices for the decompositions: plain arrays. As Eigen matrices of every size they
/// would cost all who include them much compile time.
#pragma once

#include <array>
#include <cstddef>

namespace gnomon {

/// N x N numbers, row by row: a[i][j].
template <std::size_t N>
using square_array = std::array<std::array<double, N>, N>;

}  // namespace gnomon

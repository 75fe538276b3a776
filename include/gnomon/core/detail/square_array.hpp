// SPDX-License-Identifier: BSL-1.0
/// @file
/// Small square matrices for the decompositions, as plain arrays. Eigen matrices of several sizes
/// would add their instantiations to the compile time of every including file.
#pragma once

#include <array>
#include <cstddef>

namespace gnomon::detail {

/// An N x N matrix, row by row: a[i][j] is the entry of row i and column j.
template <std::size_t N>
using square_array = std::array<std::array<double, N>, N>;

}  // namespace gnomon::detail

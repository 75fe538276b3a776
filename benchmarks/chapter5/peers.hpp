// SPDX-License-Identifier: BSL-1.0
/// @file
/// Descriptors of whole views by the Point Cloud Library, if it is installed.
#pragma once

#include <vector>

#include <gnomon/core/scan.hpp>

namespace peers {

/// Viewpoint feature histogram (Rusu et al. 2010), with normals of 20 neighbors; empty of a view
/// that has hardly points.
[[nodiscard]] std::vector<float> vfh(const gnomon::scan& view);

/// Ensemble of shape functions (Wohlkinger and Vincze 2011); empty of a view that has hardly
/// points.
[[nodiscard]] std::vector<float> esf(const gnomon::scan& view);

}  // namespace peers

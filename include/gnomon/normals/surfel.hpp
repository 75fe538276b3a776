// SPDX-License-Identifier: BSL-1.0
/// @file
/// A surface element: what `estimate_normals` returns for each point.
#pragma once

#include <gnomon/core/point.hpp>

namespace gnomon {

/// The estimator's own result, with its members `normal` and `trust`, and two figures of its
/// neighborhood (Klasing 2010, Sec. 4.2.5).
template <class Estimate>
struct surfel : Estimate {
    double mean_distance = 0.0;  ///< rho_bar, mean distance to the neighbors [m], Eq. (4.2)
    point_index neighbors = 0;   ///< the number of neighbors
};

}  // namespace gnomon

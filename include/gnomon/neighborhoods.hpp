// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighbor search: the index, the neighborhoods and their graphs.
#pragma once

#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/angularly_sorted.hpp>
#include <gnomon/neighborhoods/delaunay.hpp>
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/metric.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/neighborhoods_into.hpp>
#include <gnomon/neighborhoods/noise_knn.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/neighborhoods/ray_knn.hpp>
#include <gnomon/neighborhoods/search_options.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

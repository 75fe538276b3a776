// SPDX-License-Identifier: BSL-1.0
/// @file
/// Who is next to whom.
#pragma once

#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/delaunay.hpp>
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/neighborhoods/sorted_around.hpp>

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Who is next to whom: neighborhoods, graphs and the index beneath them.
#pragma once

#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/radius.hpp>

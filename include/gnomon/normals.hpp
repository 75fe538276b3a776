// SPDX-License-Identifier: BSL-1.0
/// @file
/// What the surface is at a point: normals, their repair, orientation and quality.
#pragma once

#include <gnomon/normals/anisotropy.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/gamma.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/propagate_orientation.hpp>

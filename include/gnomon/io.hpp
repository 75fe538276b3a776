// SPDX-License-Identifier: BSL-1.0
/// @file
/// Scans from files, and results to files.
#pragma once

#include <gnomon/io/input.hpp>
#include <gnomon/io/output_file.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/io/read_pcd.hpp>
#include <gnomon/io/read_ply.hpp>
#include <gnomon/io/read_vtk.hpp>
#include <gnomon/io/read_xyz.hpp>
#include <gnomon/io/write_ply.hpp>

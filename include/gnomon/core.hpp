// SPDX-License-Identifier: BSL-1.0
/// @file
/// Points, ranges of points, view points, executions, and the types that all other headers share.
#pragma once

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/spectrum.hpp>
#include <gnomon/core/strided_view.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/supervised.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/core/viewpoints.hpp>

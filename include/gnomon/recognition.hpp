// SPDX-License-Identifier: BSL-1.0
/// @file
/// Umbrella of the recognition floor: clusters of part features, the vocabulary of part words,
/// tests of normality. Included by name.
#pragma once

#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/greedy_means.hpp>
#include <gnomon/recognition/normality.hpp>
#include <gnomon/recognition/vocabulary.hpp>
#include <gnomon/recognition/weighted_distance.hpp>
#include <gnomon/recognition/x_means.hpp>

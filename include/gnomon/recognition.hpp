// SPDX-License-Identifier: BSL-1.0
/// @file
/// Umbrella of the recognition floor, namespace gnomon::recognition: from segments to views, their
/// features and relations, and what they show. Included by name: it needs Boost.Hana.
#pragma once

#include <gnomon/recognition/average_linkage.hpp>
#include <gnomon/recognition/calibration.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/greedy_means.hpp>
#include <gnomon/recognition/height_profile.hpp>
#include <gnomon/recognition/labeled_samples.hpp>
#include <gnomon/recognition/learned_views.hpp>
#include <gnomon/recognition/normality.hpp>
#include <gnomon/recognition/object_recognizer.hpp>
#include <gnomon/recognition/part_count.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_kernels.hpp>
#include <gnomon/recognition/part_relation.hpp>
#include <gnomon/recognition/posterior.hpp>
#include <gnomon/recognition/random_trees.hpp>
#include <gnomon/recognition/random_trees_options.hpp>
#include <gnomon/recognition/relation_words.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/view_augmentation.hpp>
#include <gnomon/recognition/view_descriptor.hpp>
#include <gnomon/recognition/view_novelty.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/recognition/vocabulary.hpp>
#include <gnomon/recognition/wall.hpp>
#include <gnomon/recognition/weighted_distance.hpp>
#include <gnomon/recognition/word_histograms.hpp>
#include <gnomon/recognition/x_means.hpp>

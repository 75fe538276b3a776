// SPDX-License-Identifier: BSL-1.0
/// @file
/// Estimation, repair, orientation and quality of normals. normals/registry.hpp stays outside, as
/// it needs Boost.Hana.
#pragma once

#include <gnomon/normals/averaging.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/feature_preserving.hpp>
#include <gnomon/normals/gamma.hpp>
#include <gnomon/normals/literal_plane_ekf.hpp>
#include <gnomon/normals/measure_noise.hpp>
#include <gnomon/normals/noise_level.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/normal_quality.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/performance_index.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/plane_filter.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/plane_svd.hpp>
#include <gnomon/normals/propagate_orientation.hpp>
#include <gnomon/normals/quad_svd.hpp>
#include <gnomon/normals/quad_trans_svd.hpp>
#include <gnomon/normals/ray_ls.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>
#include <gnomon/normals/robust_pca.hpp>
#include <gnomon/normals/robust_ray_ls.hpp>
#include <gnomon/normals/sample_consensus.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/normals/vector_pca.hpp>
#include <gnomon/normals/vector_svd.hpp>
#include <gnomon/normals/wanted_precision.hpp>
#include <gnomon/normals/weighted_pca.hpp>
#include <gnomon/normals/with_covariance.hpp>

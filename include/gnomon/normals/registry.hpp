// SPDX-License-Identifier: BSL-1.0
/// @file
/// All estimators and all graphs with their names, as tuples that tests and benchmarks unfold at
/// compile time: a new model is entered here, and everything is run on it.
///
/// Needs Boost.Hana, and is therefore not part of gnomon.hpp.
#pragma once

#include <boost/hana/concat.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>

#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/delaunay.hpp>
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/neighborhoods/sorted_around.hpp>
#include <gnomon/normals/averaging.hpp>
#include <gnomon/normals/literal_plane_ekf.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/plane_filter.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/plane_svd.hpp>
#include <gnomon/normals/quad_svd.hpp>
#include <gnomon/normals/quad_trans_svd.hpp>
#include <gnomon/normals/ray_ls.hpp>
#include <gnomon/normals/robust_pca.hpp>
#include <gnomon/normals/sample_consensus.hpp>
#include <gnomon/normals/vector_pca.hpp>
#include <gnomon/normals/vector_svd.hpp>
#include <gnomon/normals/weighted_pca.hpp>
#include <gnomon/normals/with_covariance.hpp>

namespace gnomon {

/// A policy and what it is called in tables.
template <class Policy>
struct named {
    const char* name;
    Policy policy;
};
template <class Policy>
named(const char*, Policy) -> named<Policy>;

/// The seven methods of Tabs. 3.1 and 3.2, in their order and as the thesis has them.
inline constexpr auto thesis_estimators = boost::hana::make_tuple(
    named{"plane_svd", plane_svd{}}, named{"plane_pca", plane_pca{}},
    named{"vector_svd", vector_svd{}}, named{"quad_svd", quad_svd{}},
    named{"quad_trans_svd", quad_trans_svd{}}, named{"area_weighted", area_weighted{}},
    named{"angle_weighted", angle_weighted{}});

/// The others that the thesis names or uses, variants of the seven, and what goes beyond it.
inline constexpr auto other_estimators = boost::hana::make_tuple(
    named{"vector_pca", vector_pca{}}, named{"plane_svd centred", plane_svd{.centred = true}},
    named{"quad_svd centred", quad_svd{.centred = true}},
    named{"quad_trans_svd rank 6", quad_trans_svd{.rank = 6}},
    named{"area_weighted to viewpoint", area_weighted{.sign = triangle_sign::to_viewpoint}},
    named{"angle_weighted to viewpoint", angle_weighted{.sign = triangle_sign::to_viewpoint}},
    named{"equally_weighted", equally_weighted{}}, named{"centroid_weighted", centroid_weighted{}},
    named{"gravitationally_weighted", gravitationally_weighted{}},
    named{"literal_plane_ekf", literal_plane_ekf{}}, named{"plane_ekf", plane_ekf{}},
    named{"plane_ukf", plane_ukf{}}, named{"plane_eif", plane_eif{}},
    named{"plane_pca with covariance", with_covariance<plane_pca>{}}, named{"ray_ls", ray_ls{}},
    named{"weighted_pca", weighted_pca{}}, named{"robust_pca", robust_pca{}},
    named{"ransac_plane", ransac_plane{}}, named{"mlesac_plane", mlesac_plane{}});

/// All estimators.
inline constexpr auto estimators = boost::hana::concat(thesis_estimators, other_estimators);

/// All kinds of neighborhood graphs.
inline constexpr auto graphs = boost::hana::make_tuple(
    named{"knn", knn{}}, named{"radius", radius{}}, named{"hybrid", hybrid{}},
    named{"delaunay", delaunay{}}, named{"sorted_around knn", sorted_around<knn>{}},
    named{"adaptive_knn isotropic", adaptive_knn<prefer_isotropic>{}},
    named{"adaptive_knn low entropy", adaptive_knn<prefer_low_entropy>{}},
    named{"adaptive_knn small error", adaptive_knn<prefer_small_error>{}});

}  // namespace gnomon

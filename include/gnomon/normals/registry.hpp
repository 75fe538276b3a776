// SPDX-License-Identifier: BSL-1.0
/// @file
/// All estimators and all neighborhoods with their names, as tuples that tests and benchmarks
/// iterate over at compile time. A new model is added here, and every test and benchmark runs on
/// it.
///
/// Needs Boost.Hana, and is therefore not part of gnomon.hpp.
#pragma once

#include <boost/hana/concat.hpp>
#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>

#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/angularly_sorted.hpp>
#include <gnomon/neighborhoods/delaunay.hpp>
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/radius.hpp>
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
#include <gnomon/normals/robust_ray_ls.hpp>
#include <gnomon/normals/sample_consensus.hpp>
#include <gnomon/normals/vector_pca.hpp>
#include <gnomon/normals/vector_svd.hpp>
#include <gnomon/normals/weighted_pca.hpp>
#include <gnomon/normals/with_covariance.hpp>

namespace gnomon {
namespace detail {

/// A policy and its name in tables.
template <class Policy>
struct named {
    const char* name;
    Policy policy;
};
template <class Policy>
named(const char*, Policy) -> named<Policy>;

/// Other methods of the thesis, variants of the seven, and methods beyond the thesis.
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
    named{"robust_ray_ls", robust_ray_ls{}},
    named{"plane_pca with covariance", with_covariance<plane_pca>{}}, named{"ray_ls", ray_ls{}},
    named{"weighted_pca", weighted_pca{}}, named{"robust_pca", robust_pca{}},
    named{"ransac_plane", ransac_plane{}}, named{"mlesac_plane", mlesac_plane{}});

}  // namespace detail

/// The seven methods of Tabs. 3.1 and 3.2, in their order and with the parameters of the thesis.
inline constexpr auto thesis_estimators = boost::hana::make_tuple(
    detail::named{"plane_svd", plane_svd{}}, detail::named{"plane_pca", plane_pca{}},
    detail::named{"vector_svd", vector_svd{}}, detail::named{"quad_svd", quad_svd{}},
    detail::named{"quad_trans_svd", quad_trans_svd{}},
    detail::named{"area_weighted", area_weighted{}},
    detail::named{"angle_weighted", angle_weighted{}});

/// All estimators.
inline constexpr auto estimators = boost::hana::concat(thesis_estimators, detail::other_estimators);

/// All neighborhoods.
inline constexpr auto graphs = boost::hana::make_tuple(
    detail::named{"knn", knn{}}, detail::named{"radius", radius{}},
    detail::named{"hybrid", hybrid{}}, detail::named{"delaunay", delaunay{}},
    detail::named{"angularly_sorted knn", angularly_sorted<knn>{}},
    detail::named{"adaptive_knn isotropic", adaptive_knn<prefer_isotropic>{}},
    detail::named{"adaptive_knn low entropy", adaptive_knn<prefer_low_entropy>{}},
    detail::named{"adaptive_knn small error", adaptive_knn<prefer_small_error>{}});

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
// A type that each concept refuses; docs/concepts quotes the messages of the compiler.
#include <cstddef>
#include <list>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/curvature.hpp>
#include <gnomon/features/descriptor.hpp>
#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/segmentation/segment_oriented_points.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>

using points = std::vector<Eigen::Vector3d>;

// expect: noise\(x\)
// [refused_range_noise]
struct of_a_class {
    double sigma(double range) const { return 0.01 * range; }
};
static_assert(gnomon::range_noise<of_a_class>);  // is not called as a function
// [refused_range_noise]

// expect: gnomon::point<by_name>
// [refused_point]
struct by_name {
    double east, north, up;
};
static_assert(gnomon::point<by_name>);  // no specialization of point_traits, no x, y, z
// [refused_point]

// expect: point_range<std::list
// [refused_point_range]
static_assert(gnomon::point_range<std::list<Eigen::Vector3d>>);  // no access by index
// [refused_point_range]

// expect: r\.viewpoints
// [refused_has_viewpoints]
static_assert(gnomon::has_viewpoints<points>);  // with_viewpoint(points, v) has them
// [refused_has_viewpoints]

// expect: surface\[i\]\.normal\b
// [refused_normal_range]
static_assert(gnomon::normal_range<points>);  // vectors, no structs with a member `normal`
// [refused_normal_range]

// expect: surface\[i\]\.mean_distance
// [refused_surfel_range]
struct only_normal {
    Eigen::Vector3d normal;
};
static_assert(gnomon::surfel_range<std::vector<only_normal>>);  // no mean distance
// [refused_surfel_range]

// expect: x\(std::size_t\{\}, work\)
// [refused_execution]
static_assert(gnomon::execution<int>);  // threads{4}, not 4
// [refused_execution]

// expect: begin\(graph\[i\]\)
// [refused_graph]
struct by_value {
    std::size_t size() const { return 100; }
    std::vector<gnomon::point_index> operator[](std::size_t) const { return {}; }
};
static_assert(gnomon::neighborhood_graph<by_value>);  // gives a container, no view or reference
// [refused_graph]

// expect: policy\(points, (gnomon::)?sequential\{\}, proj\)
// [refused_neighborhood]
static_assert(gnomon::neighborhood<int, points>);  // knn{.k = 20}, not 20
// [refused_neighborhood]

// expect: policy\.find\(index, i, found\)
// [refused_indexed_neighborhood]
struct graph_only {
    std::vector<std::vector<gnomon::point_index>> operator()(const auto&, const auto&, auto) const {
        return {};
    }
};
static_assert(gnomon::indexed_neighborhood<graph_only>);  // no find
// [refused_indexed_neighborhood]

// expect: preference\(shape\)
// [refused_size_preference]
struct by_number {
    double operator()(int* k) const { return 1.0 / *k; }
};
static_assert(gnomon::size_preference<by_number>);  // takes no neighborhood_shape
// [refused_size_preference]

// expect: gnomon::estimator<without_neighbors>
// [refused_estimator]
struct without_neighbors {
    Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return p; }
};
static_assert(gnomon::estimator<without_neighbors>);
// [refused_estimator]

// expect: gnomon::curvature_estimator<only_mean>
// [refused_curvature_estimator]
struct only_mean {
    double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&,
                      gnomon::neighborhood_view) const {
        return 0.0;
    }
};
static_assert(gnomon::curvature_estimator<only_mean>);  // gives a number, no curvature
// [refused_curvature_estimator]

// expect: d\.distance\(row, row\)
// [refused_descriptor]
struct without_distance {
    static double support_radius() { return 0.1; }
    static std::size_t dimension() { return 1; }
    gnomon::trust operator()(const Eigen::Vector3d&, const Eigen::Vector3d&,
                             gnomon::neighborhood_view, std::span<double> row) const {
        row[0] = 1.0;
        return gnomon::trust::good;
    }
};
static_assert(gnomon::descriptor<without_distance>);  // nothing compares two descriptors
// [refused_descriptor]

// expect: d\.criterion\(\)\(double\{\}, n, n\)
// [refused_dissimilarity]
struct without_criterion {
    double radius = 0.05;
};
static_assert(gnomon::oriented_dissimilarity<without_criterion>);
// [refused_dissimilarity]

// expect: policy\(seen\)
// [refused_merge_policy]
struct of_nothing {
    bool operator()() const { return true; }
};
static_assert(gnomon::merge_policy<of_nothing>);  // takes no observation
// [refused_merge_policy]

int main() {}

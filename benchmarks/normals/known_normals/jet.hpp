// SPDX-License-Identifier: BSL-1.0
/// @file
/// CGAL's jets of degree 2 (Cazals and Pouget 2005), computed as jet_estimate_normals() does, but
/// only for some points and from neighbors that are known.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "neighborhoods.hpp"
#include <CGAL/Eigen_svd.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/jet_estimate_normals.h>
#include <CGAL/property_map.h>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_quality.hpp>

namespace known_normals {

using cgal_kernel = CGAL::Simple_cartesian<double>;

inline cgal_kernel::Point_3 to_cgal(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
inline Eigen::Vector3d from_cgal(const cgal_kernel::Vector_3& v) { return {v.x(), v.y(), v.z()}; }

/// The jets of all test points, over each point and its k neighbors.
inline std::vector<gnomon::normal_fit> jets(const std::vector<Eigen::Vector3d>& points,
                                            const nearest_of_tests& nearest, std::size_t k) {
    CGAL::Monge_via_jet_fitting<cgal_kernel, cgal_kernel, CGAL::Eigen_svd> fit;
    std::vector<gnomon::normal_fit> result(nearest.tests());
    std::vector<cgal_kernel::Point_3> neighbors;
    for (std::size_t i = 0; i < result.size(); ++i) {
        neighbors.assign(1, to_cgal(points[i]));
        for (const auto j : nearest.neighbors(i, k)) neighbors.push_back(to_cgal(points[j]));
        result[i].normal =
            from_cgal(fit(neighbors.begin(), neighbors.end(), 2, 1).normal_direction());
    }
    return result;
}

/// The largest angle [rad] between jets() and CGAL::jet_estimate_normals() on all of some points.
inline double largest_deviation_of_jets(const std::vector<Eigen::Vector3d>& points, std::size_t k) {
    using point_with_normal = std::pair<cgal_kernel::Point_3, cgal_kernel::Vector_3>;
    std::vector<point_with_normal> theirs;
    for (const Eigen::Vector3d& p : points) theirs.emplace_back(to_cgal(p), CGAL::NULL_VECTOR);
    CGAL::jet_estimate_normals<CGAL::Sequential_tag>(
        theirs, static_cast<unsigned>(k),
        CGAL::parameters::point_map(CGAL::First_of_pair_property_map<point_with_normal>())
            .normal_map(CGAL::Second_of_pair_property_map<point_with_normal>())
            .degree_fitting(2));
    const auto ours = jets(points, nearest_of_tests(points, points.size(), k), k);
    double largest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const gnomon::angle a =
            gnomon::unoriented_angle(ours[i].normal, from_cgal(theirs[i].second));
        largest = std::max(largest, a.radians());
    }
    return largest;
}

}  // namespace known_normals

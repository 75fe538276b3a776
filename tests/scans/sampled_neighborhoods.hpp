// SPDX-License-Identifier: BSL-1.0
/// @file
/// The quality of an estimator on a large scan whose truth is known, at every n-th of its points:
/// the mean changes little, and a test need not wait for all of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/gamma.hpp>
#include <gnomon/simulation/true_scan.hpp>

namespace sampled {

/// A point of a scan with its neighbors, in the order of the policy that found them.
struct neighborhood {
    std::size_t point = 0;
    std::vector<gnomon::neighbor> neighbors;
    bool open = false;
};

/// Those of the points 0, every, 2 every, ...
std::vector<neighborhood> neighborhoods_of(const gnomon::scan& scan, const auto& policy,
                                           std::size_t every) {
    const gnomon::spatial_index index(scan);
    std::vector<neighborhood> neighborhoods;
    for (std::size_t i = 0; i < scan.size(); i += every) {
        neighborhood& r = neighborhoods.emplace_back();
        r.point = i;
        r.open = gnomon::detail::find_noted(policy, index, i, r.neighbors).open;
    }
    return neighborhoods;
}

/// The mean of gamma, Eq. (3.12), over the neighborhoods, of which an estimate sees the first k
/// neighbors.
template <gnomon::estimator E>
double mean_gamma(const E& estimate, const gnomon::simulation::true_scan& truth,
                  const std::vector<neighborhood>& neighborhoods,
                  std::size_t k = std::numeric_limits<std::size_t>::max()) {
    double sum = 0.0;
    std::vector<Eigen::Vector3d> positions;
    for (const neighborhood& r : neighborhoods) {
        positions.clear();
        for (std::size_t j = 0; j < std::min(k, r.neighbors.size()); ++j)
            positions.push_back(truth.scan.points[r.neighbors[j].index]);
        const Eigen::Vector3d& p = truth.scan.points[r.point];
        const gnomon::neighborhood_view view(positions, r.open);
        Eigen::Vector3d normal;
        if constexpr (gnomon::ray_estimator<E>) {
            normal = estimate(p, view, truth.scan.viewpoints[r.point]).normal;
        } else {
            normal = estimate(p, view).normal;
        }
        sum += gnomon::gamma(normal, truth.normals[r.point]);
    }
    return sum / static_cast<double>(neighborhoods.size());
}

}  // namespace sampled

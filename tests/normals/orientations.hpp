// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals whose signs are lost, and how well they are found again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "laws/clouds.hpp"
#include "laws/solids.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/propagate_orientation.hpp>

namespace orientations {

using surface_elements = std::vector<gnomon::surfel<gnomon::plane_fit>>;

void scramble_signs(auto& surface, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    for (auto& s : surface) {
        if (random.below(2) == 0) s.normal = -s.normal;
    }
}

/// Normals of k neighbors, of random sign.
inline surface_elements unoriented(const clouds::cloud& points, std::size_t k = 12) {
    // By a stored graph, whose sums do not depend on the order of the points.
    auto surface =
        gnomon::estimate_normals(points, gnomon::knn{.k = k}(points), gnomon::plane_pca{});
    scramble_signs(surface, 99);
    return surface;
}

/// The part of the points with normals for which is_right(i).
double part_right(const gnomon::orientation& o, auto&& is_right) {
    double right = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < o.component.size(); ++i) {
        if (o.component[i] < 0) continue;
        all += 1.0;
        if (is_right(i)) right += 1.0;
    }
    return right / all;
}

/// Whether a point's normal looks out of the solid.
inline auto outwards(const surface_elements& surface, const solids::solid& s) {
    return [&](std::size_t i) { return surface[i].normal.dot(s.outside[i]) > 0.0; };
}

/// The probability that a wrong point has less confidence than a right one (area under the ROC).
double area_under_curve(const gnomon::orientation& o, auto&& is_right) {
    std::vector<std::pair<double, bool>> sorted;
    for (std::size_t i = 0; i < o.component.size(); ++i) {
        if (o.component[i] >= 0) sorted.push_back({o.confidence[i], is_right(i)});
    }
    std::sort(sorted.begin(), sorted.end());
    double wrong = 0.0;
    double right = 0.0;
    double pairs = 0.0;
    for (const auto& [confidence, is] : sorted) {
        (is ? right : wrong) += 1.0;
        if (is) pairs += wrong;
    }
    return pairs / (wrong * right);
}

}  // namespace orientations

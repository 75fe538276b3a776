// SPDX-License-Identifier: BSL-1.0
/// @file
/// What `gnomon::perception` found in a scan, as a picture draws it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "picture.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/perception.hpp>

namespace picture {

/// The points as they are drawn: those that are finite and were not left out.
/// @param seen  of points, not of an index of them
template <class Estimate, gnomon::execution X = gnomon::sequential>
[[nodiscard]] std::vector<splat> splats_of(const gnomon::scan& scan,
                                           const gnomon::perception_result<Estimate>& seen,
                                           const X& run = {}) {
    // The surface elements of the result may be those of cells, whose distances are larger.
    const auto of_kept =
        gnomon::estimate_normals(seen.index, gnomon::knn{}, gnomon::plane_pca{}, run);
    std::vector<splat> splats;
    for (std::size_t i = 0; i < seen.kept.size(); ++i) {
        const gnomon::point_index p = seen.kept[i];
        if (!gnomon::is_finite(scan.points[p])) continue;
        // k points that fill a disc at the distance rho_bar on average are 1.5 rho_bar sqrt(pi / k)
        // apart; a little more than that closes the surface, for points that lie in rows too.
        const auto& s = of_kept[i];
        const double neighbors = std::max<double>(1.0, s.neighbors);
        const double spacing = 1.5 * s.mean_distance * std::sqrt(std::numbers::pi / neighbors);
        splats.push_back(
            {scan.points[p], seen.surface[p].normal, 1.35 * spacing, seen.surfaces.labels()[p]});
    }
    return splats;
}

/// Legend of segments: label and number of points.
[[nodiscard]] inline std::vector<std::string> sizes_of(const gnomon::segments& segments) {
    std::vector<std::string> sizes;
    for (std::size_t label = 0; label < segments.size(); ++label)
        sizes.push_back(std::to_string(label) + ": " + with_commas(segments[label].size()));
    return sizes;
}

/// The boundary pairs of the gaps that were closed, and of those that were not.
template <class Estimate>
[[nodiscard]] annotation gaps_of(const gnomon::scan& scan,
                                 const gnomon::perception_result<Estimate>& seen) {
    constexpr color closed{0, 0, 0}, open{235, 0, 235};  // not in the palette of segments
    annotation lines;
    std::size_t merged = 0;
    for (const gnomon::considered_gap& gap : seen.gaps) {
        merged += gap.merged ? 1 : 0;
        for (const auto& pair : gap.lines)
            lines.strokes.push_back(
                {scan.points[pair.first], scan.points[pair.second], gap.merged ? closed : open});
    }
    if (!seen.gaps.empty()) {
        lines.legend = {{closed, counted(merged, "gap") + " closed"},
                        {open, counted(seen.gaps.size() - merged, "gap") + " left open"}};
    }
    return lines;
}

}  // namespace picture

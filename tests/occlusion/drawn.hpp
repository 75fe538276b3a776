// SPDX-License-Identifier: BSL-1.0
/// @file
/// Small clouds drawn by hand, for the tests of merging.
#pragma once

#include <cstdint>
#include <vector>

#include "laws/clouds.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>

namespace looks {

/// Points by hand, with their labels.
struct drawn {
    clouds::cloud points;
    std::vector<std::int32_t> labels;

    /// A grid of points 2 cm apart about a place, `deep` layers of it along its normal, which is
    /// the x-axis turned about the z-axis.
    void add(const Eigen::Vector3d& center, int wide, int high, int deep = 1, double degrees = 0) {
        const std::int32_t label = labels.empty() ? 0 : labels.back() + 1;
        const gnomon::angle turned = gnomon::degrees(degrees);
        const Eigen::Vector3d along(-sin(turned), cos(turned), 0), out(cos(turned), sin(turned), 0);
        for (int i = 0; i < wide; ++i) {
            for (int j = 0; j < high; ++j) {
                for (int k = 0; k < deep; ++k) {
                    points.push_back(center + 0.02 * (i - 0.5 * (wide - 1)) * along +
                                     0.02 * (k - 0.5 * (deep - 1)) * out +
                                     Eigen::Vector3d(0, 0, 0.02 * (j - 0.5 * (high - 1))));
                    labels.push_back(label);
                }
            }
        }
    }

    [[nodiscard]] gnomon::merged_segments merged(
        const gnomon::merge_occluded_options& options = {}) const {
        return gnomon::merge_occluded(points, gnomon::segments(labels), gnomon::visibility(points),
                                      gnomon::conservative{}, options);
    }
};

}  // namespace looks

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Vectors, matrices and boxes as a report has them.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <gnomon/core/oriented_box.hpp>

using json = nlohmann::ordered_json;

inline json array_of(const Eigen::Vector3d& v) { return json::array({v.x(), v.y(), v.z()}); }

/// The columns of a matrix, one after the other.
inline json columns_of(const Eigen::Matrix3d& m) {
    return json::array({array_of(Eigen::Vector3d(m.col(0))), array_of(Eigen::Vector3d(m.col(1))),
                        array_of(Eigen::Vector3d(m.col(2)))});
}

inline json box_description(const gnomon::oriented_box& box) {
    return {{"center", array_of(box.center)},
            {"axes", columns_of(box.axes)},
            {"lengths", array_of(box.lengths)}};
}

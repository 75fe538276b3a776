// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where a part is on the ground, and how it is turned.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition::detail {

/// The frame of a ground plane: z is the height above it, and x is that of the scan, as far as it
/// can be.
/// @param above  a place near which its origin lies [m]
/// @throws std::invalid_argument  if the normal of the ground is not of unit length
[[nodiscard]] inline rigid_motion ground_motion(const plane& ground, const Eigen::Vector3d& above) {
    using namespace gnomon::detail;
    require_hesse(ground);
    const Eigen::Vector3d& z = ground.normal;
    const Eigen::Vector3d ahead =
        std::abs(z.x()) < 0.9 ? Eigen::Vector3d(1.0, 0.0, 0.0) : Eigen::Vector3d(0.0, 1.0, 0.0);
    const Eigen::Vector3d y = direction_of(cross(z, ahead)), x = cross(y, z);
    rigid_motion m;
    for (int i = 0; i < 3; ++i) {
        m.rotation(i, 0) = x[i];
        m.rotation(i, 1) = y[i];
        m.rotation(i, 2) = z[i];
    }
    m.position = combined(1.0, above, -ground.signed_distance(above), z);
    return m;
}

/// Where a part is on the ground, and how it is turned.
struct part_place {
    Eigen::Vector3d at;    ///< the middle of its box, in the frame of the ground [m]
    double heading = 0.0;  ///< [rad]
    int headings = 1;      ///< that many turns of a full one by equal angles are as good

    /// @throws std::invalid_argument  if the place or the normal of the part is not finite
    part_place(const part& p, const rigid_motion& ground)
        : at(ground.point_in(p.shape.frame.box_center)) {
        gnomon::detail::require(is_finite(at) && is_finite(p.shape.normal),
                                "part_votes: the place of a part is not finite");
        constexpr double upright = 0.5;  // chosen: cosine; the normal has a heading
        constexpr double square = 1.25;  // chosen: ratio of sides of which the longer one is known
        const Eigen::Vector3d n = ground.direction_in(p.shape.normal);
        if (std::abs(n.z()) < upright) {
            heading = std::atan2(n.y(), n.x());
            return;
        }
        const Eigen::Vector3d a =
            ground.direction_in(gnomon::detail::column(p.shape.frame.axes, 0));
        heading = std::atan2(a.y(), a.x());
        const double ratio = p.shape.frame.box_size[0] / std::max(p.shape.frame.box_size[1], 1e-9);
        headings = ratio < square ? 4 : 2;
    }
};

}  // namespace gnomon::recognition::detail

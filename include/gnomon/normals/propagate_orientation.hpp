// SPDX-License-Identifier: BSL-1.0
/// @file
/// Consistent signs for the normals of a cloud whose view points are unknown: the sign goes from
/// neighbor to neighbor, over the most reliable links first, so that every point gets it along the
/// strongest chain of links there is (Klasing 2010, Sec. 3.2.10, "voting and propagation schemes").
///
/// Hoppe et al. 1992 follow the spanning tree of least 1 - |<n_i, n_j>|; it mistakes the sign where
/// two sides of a board, with parallel normals, come close. Xie et al. reflect n_j through the
/// plane that halves the link before they compare, which is right across sharp edges but not for
/// noise (both reviewed by Koenig and Gumhold 2009). What the two dispute are the parts of the
/// normals along the link; here only the components on which both agree are compared: the
/// projections of the normals onto that plane. A link that leaves the tangent planes, such as one
/// through a board, is then weak. The tree decides alone: a vote of all links between growing
/// clusters, after Jakob et al. 2019, was tried and helps with much noise, but links through thin
/// boards then outvote the few around their rims.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/detail/component_facing.hpp>
#include <gnomon/normals/detail/signed_forest.hpp>

namespace gnomon {

/// How far signs are carried.
struct propagate_orientation_options {
    /// Links of this strength |c| or less, from 0 to 1, carry no sign: larger values give more
    /// components with fewer wrong signs in each, good where view points decide for each component.
    double min_link = 0.0;
};

/// How the signs of a cloud came about, point by point.
struct orientation {
    /// The strength of the weakest link between the point and the core of its component, along the
    /// strongest path: 1 if the surface is smooth all the way, about 1/2 beyond a sharp right
    /// angle, 0 if the sign is a guess, as for points without links or normals. For the core, where
    /// all paths end, that of its own strongest link. It refers to the sign relative to the
    /// core, not to the orientation of the component as a whole.
    std::vector<double> confidence;
    /// Points of one component are oriented alike: numbers from 0, the largest component first, and
    /// -1 for points without normal. `segments(component)` lists the points of each.
    std::vector<std::int32_t> component;
    std::size_t components = 0;  ///< how many there are
};

namespace detail {

/// c = <n_i, n_j> - <n_i, e> <n_j, e> for the unit vector e from p_i to p_j, from -1 to 1: the
/// inner product of the projections onto the plane across the link, and the mean of the criteria of
/// Hoppe et al. and Xie et al. It is positive if the normals agree; its absolute value is the
/// strength of the link.
/// The same bytes for (j, i).
[[nodiscard]] inline double sign_relation(const Eigen::Vector3d& p_i, const Eigen::Vector3d& n_i,
                                          const Eigen::Vector3d& p_j, const Eigen::Vector3d& n_j) {
    Eigen::Vector3d e = difference(p_j, p_i);
    const double scale = std::max({std::abs(e.x()), std::abs(e.y()), std::abs(e.z())});
    double along = 0.0;  // there is no direction between duplicates
    if (scale > 0.0) {
        for (int a = 0; a < 3; ++a) e[a] /= scale;  // squares of tiny numbers would be zero
        along = dot(n_i, e) * dot(n_j, e) / dot(e, e);
    }
    return std::clamp(dot(n_i, n_j) - along, -1.0, 1.0);
}

}  // namespace detail

/// Gives the normals of each connected component of a neighbor graph consistent signs.
///
/// A component as a whole faces its view points by majority (weighted by the cosine of incidence)
/// if the points know them; else outwards: the sum of <n, d> |d|^2, for the way d from its centroid
/// to a point, is positive. That is the outside of a closed surface; for an open one it is a
/// convention, and upwards for a plane. Pass `scan.points` to have a scan face outwards.
///
/// Two sides of a board stay apart as long as the neighbors of most points are on their own side:
/// choose k such that neighborhoods are narrower than the board; where they are wider, signs
/// are unreliable and the confidence does not indicate it. Surfaces that touch are one component.
///
/// @param points   any point range of n points [m]
/// @param graph    the neighbors of each point; i and j are linked if either lists the other
/// @param surface  n normals; those that should look the other way are negated in place
/// @param run      `sequential{}` or `threads{n}`; the result is the same bytes
/// @return confidence and component of each point. A normal that is zero or not finite, and that of
///         a point that is not finite, stays as it is, with confidence 0 and component -1.
/// @throws std::invalid_argument  if points, graph and surface differ in size, the graph lists a
///                                neighbor out of range, min_link is not from 0 to 1, or a view
///                                point is not finite; `surface` then is as it was
/// Neither the signs that the normals had nor the order of the points matter, but for ties.
/// Complexity: O(n k log(n k)) for k neighbors per point; 16 bytes per neighbor.
template <class R, neighborhood_graph G, normal_range Surface, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj> && (!std::is_const_v<Surface>)
orientation propagate_orientation(const R& points, const G& graph, Surface& surface,
                                  const propagate_orientation_options& options = {},
                                  const X& run = {}, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    const std::size_t n = p.size();
    detail::require(graph.size() == n, "propagate_orientation: graph and points differ in size");
    detail::require(std::ranges::size(surface) == n,
                    "propagate_orientation: surface and points differ in size");
    detail::require(options.min_link >= 0.0 && options.min_link <= 1.0,
                    "propagate_orientation: min_link must be from 0 to 1");
    const auto usable = [&](std::size_t i) {
        const Eigen::Vector3d& normal = surface[i].normal;
        return is_finite(normal) && !is_missing(normal) && is_finite(p[i]);
    };

    std::vector<std::size_t> first(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) first[i + 1] = first[i] + std::ranges::size(graph[i]);
    std::vector<detail::sign_link> links(first[n]);
    detail::for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            detail::sign_link* link = links.data() + first[i];
            for (const point_index j : graph[i]) {
                detail::require(j < n, "propagate_orientation: a neighbor index is out of range");
                if (usable(i) && usable(j)) {  // a link to itself joins nothing
                    link->relation =
                        detail::sign_relation(p[i], surface[i].normal, p[j], surface[j].normal);
                }
                link->a = std::min(static_cast<point_index>(i), j);
                link->b = std::max(static_cast<point_index>(i), j);
                ++link;
            }
        }
    });
    std::erase_if(links, [&](const auto& l) { return !(l.strength() > options.min_link); });
    detail::signed_forest forest(n, std::move(links));

    orientation result{std::vector<double>(n, 0.0), std::vector<std::int32_t>(n, -1), 0};
    result.components = forest.number_trees(usable, result.component);
    const auto normal_of = [&](std::size_t i) -> Eigen::Vector3d {
        return detail::scaled(forest.way(i).sign, surface[i].normal);
    };
    const auto vote = detail::component_facing(p, detail::viewpoints_of(points), normal_of,
                                               result.component, result.components);
    for (std::size_t i = 0; i < n; ++i) {
        if (result.component[i] < 0) continue;
        const auto way = forest.way(i);
        const bool turned = vote[static_cast<std::size_t>(result.component[i])] < 0.0;
        if ((way.sign < 0.0) != turned) surface[i].normal = -surface[i].normal;
        result.confidence[i] = way.weakest;
    }
    return result;
}

/// The same from a neighborhood policy, e.g. knn{.k = 12}.
/// @throws std::invalid_argument  also if the policy's parameters are out of range, e.g. k = 0
template <class R, class N, normal_range Surface, execution X = sequential,
          class Proj = std::identity>
    requires neighborhood<N, R, Proj> && (!std::is_const_v<Surface>)
orientation propagate_orientation(const R& points, const N& policy, Surface& surface,
                                  const propagate_orientation_options& options = {},
                                  const X& run = {}, Proj projection = {}) {
    return propagate_orientation(points, policy(points, run, projection), surface, options, run,
                                 projection);
}

}  // namespace gnomon

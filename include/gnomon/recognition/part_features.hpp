// SPDX-License-Identifier: BSL-1.0
/// @file
/// The features of parts: the five of Klasing 2010, Sec. 5.2.2, others that separate objects
/// better, and those that do not depend on the ground.
#pragma once

#include <algorithm>
#include <numbers>
#include <string_view>

#include <boost/hana/tuple.hpp>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition {

/// Height of the centroid above the ground [m].
struct mean_height {
    static constexpr std::string_view name = "mean height";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view& v) const {
        return detail::ground_of(v, name).signed_distance(p.shape.frame.centroid);
    }
};

/// Height of the lowest point above the ground [m].
struct lowest_height {
    static constexpr std::string_view name = "lowest height";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view& v) const {
        static_cast<void>(detail::ground_of(v, name));
        return p.lowest;
    }
};

/// Height of the highest point above the ground [m].
struct highest_height {
    static constexpr std::string_view name = "highest height";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view& v) const {
        static_cast<void>(detail::ground_of(v, name));
        return p.highest;
    }
};

/// The angle between normal and vertical, of a right angle: 0 of a level part, 1 of an upright one.
struct inclination {
    static constexpr std::string_view name = "inclination";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view& v) const {
        const double c =
            gnomon::detail::dot(detail::ground_of(v, name).normal, p.shape.frame.normal());
        return std::acos(std::min(1.0, std::abs(c))) / (0.5 * std::numbers::pi);
    }
};

/// The surface variation of all points, Eq. (3.28).
struct variation {
    static constexpr std::string_view name = "surface variation";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view&) const {
        return p.shape.surface_variation();
    }
};

/// The aspect ratio of all points, Eq. (3.19).
struct elongation {
    static constexpr std::string_view name = "aspect ratio";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view&) const {
        return p.shape.aspect_ratio();
    }
};

/// The volume of the principal box [m^3], V_oo.
struct box_volume {
    static constexpr std::string_view name = "box volume";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view&) const {
        return p.shape.frame.box().volume();
    }
};

/// An edge of the principal box [m]: 0 is the longest one, 2 the shortest.
template <int Rank>
    requires(Rank >= 0 && Rank < 3)
struct box_edge {
    static constexpr std::string_view name = Rank == 0   ? "longest edge"
                                             : Rank == 1 ? "middle edge"
                                                         : "shortest edge";
    double scale = 1.0, weight = 1.0;
    [[nodiscard]] double operator()(const part& p, const view&) const {
        Eigen::Vector3d edges = p.shape.frame.box_size;
        std::sort(&edges[0], &edges[0] + 3);
        return edges[2 - Rank];
    }
};

/// The five features of Sec. 5.2.2 with the weights of Sec. 5.6.1, of which the sum is 0.99. The
/// scales of height and volume are the largest values of the training set, Eq. (5.1): see
/// scaled_by_largest().
inline constexpr auto thesis_features = boost::hana::make_tuple(
    mean_height{.weight = 0.30}, inclination{.weight = 0.30}, variation{.weight = 0.13},
    elongation{.weight = 0.13}, box_volume{.weight = 0.13});

/// Heights, inclination, and the edges of the box in place of its volume: one large object makes
/// all other volumes equal. Scales are differences that matter, as the prototype of this method
/// had them (chosen on simulated furniture, seed 1).
inline constexpr auto default_features = boost::hana::make_tuple(
    mean_height{.scale = 0.06}, inclination{.scale = 0.12}, box_edge<0>{.scale = 0.12},
    box_edge<1>{.scale = 0.10}, box_edge<2>{.scale = 0.10}, variation{.scale = 0.12},
    lowest_height{.scale = 0.10}, highest_height{.scale = 0.05});

/// Features that do not need the ground, for objects in any pose.
inline constexpr auto invariant_features = boost::hana::make_tuple(
    box_edge<0>{.scale = 0.12}, box_edge<1>{.scale = 0.10}, box_edge<2>{.scale = 0.10},
    variation{.scale = 0.12}, elongation{.scale = 0.12});

}  // namespace gnomon::recognition

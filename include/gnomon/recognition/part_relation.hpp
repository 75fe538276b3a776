// SPDX-License-Identifier: BSL-1.0
/// @file
/// Relations of two parts of a view: angle of their normals, and distance of their centroids.
/// Klasing 2010, Sec. 5.2.4. A relation is a policy, like a feature; relations are used as a
/// Boost.Hana tuple.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <boost/hana/size.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition {

/// r(a, b) is a value that does not depend on the order of the parts. Its histogram has bins of
/// r.bin [its unit]; pairs of words are related if the fullest bin holds more than the share r.mass
/// of their values, and the deviation of a related pair is at least r.min_deviation.
template <class R>
concept part_relation = requires(const R& r, const part& a, const part& b) {
    { r(a, b) } -> std::convertible_to<double>;
    { R::name } -> std::convertible_to<std::string_view>;
    { r.bin } -> std::convertible_to<double>;
    { r.mass } -> std::convertible_to<double>;
    { r.min_deviation } -> std::convertible_to<double>;
};

/// The angle between the normals [rad], r_1.
struct normal_angle {
    static constexpr std::string_view name = "angle";
    double bin = std::numbers::pi / 36.0;
    double mass = 0.10;  ///< Sec. 5.6.2
    double min_deviation = 0.03;
    /// Angles above a right angle count as those of the opposite normal: a board is seen from
    /// either side.
    bool is_folded = false;
    [[nodiscard]] double operator()(const part& a, const part& b) const {
        const double c = gnomon::detail::dot(a.shape.normal, b.shape.normal);
        return std::acos(std::clamp(is_folded ? std::abs(c) : c, -1.0, 1.0));
    }
};

/// The distance of the centroids [m], r_2.
struct centroid_distance {
    static constexpr std::string_view name = "distance";
    double bin = 0.05;
    double mass = 0.05;  ///< Sec. 5.6.2
    double min_deviation = 0.02;
    [[nodiscard]] double operator()(const part& a, const part& b) const {
        return gnomon::detail::length(
            gnomon::detail::difference(a.shape.frame.centroid, b.shape.frame.centroid));
    }
};

/// How far the centroids are apart in height [m]. Zero if their view has no ground: heights of the
/// parts are then unknown.
struct height_difference {
    static constexpr std::string_view name = "height difference";
    double bin = 0.05;
    double mass = 0.10;
    double min_deviation = 0.02;
    [[nodiscard]] double operator()(const part& a, const part& b) const {
        return 0.5 * std::abs(a.lowest + a.highest - b.lowest - b.highest);
    }
};

/// The distance [m] of the centroid of one part from the plane of the other through its centroid,
/// the smaller of both: how far a back stands from the middle of its seat.
struct plane_offset {
    static constexpr std::string_view name = "distance from the plane";
    double bin = 0.05;
    double mass = 0.10;
    double min_deviation = 0.02;
    [[nodiscard]] double operator()(const part& a, const part& b) const {
        const Eigen::Vector3d way =
            gnomon::detail::difference(a.shape.frame.centroid, b.shape.frame.centroid);
        const double of_a = std::abs(gnomon::detail::dot(a.shape.normal, way));
        const double of_b = std::abs(gnomon::detail::dot(b.shape.normal, way));
        return std::min(of_a, of_b);
    }
};

/// The two relations of Sec. 5.2.4.
inline constexpr auto thesis_relations =
    boost::hana::make_tuple(normal_angle{}, centroid_distance{});

/// The same, for boards that are seen from either side, and where one part is, seen from the other.
inline constexpr auto default_relations = boost::hana::make_tuple(
    normal_angle{.is_folded = true}, centroid_distance{}, height_difference{}, plane_offset{});

/// No relations.
inline constexpr auto no_relations = boost::hana::make_tuple();

/// The number of relations of a tuple.
template <class Relations>
inline constexpr std::size_t relation_count =
    decltype(boost::hana::size(std::declval<const Relations&>()))::value;

/// The values of all relations of two parts.
/// @throws std::invalid_argument  if a value is not finite
template <class Relations>
[[nodiscard]] std::array<double, relation_count<Relations>> relation_vector(
    const Relations& relations, const part& a, const part& b) {
    const auto value = [&]<part_relation R>(const R& r) {
        const double x = r(a, b);
        if (!std::isfinite(x))
            GNOMON_THROW(std::invalid_argument("the relation " + std::string(R::name) +
                                               " of two parts is not finite"));
        return x;
    };
    return boost::hana::unpack(relations, [&](const auto&... r) {
        return std::array<double, relation_count<Relations>>{value(r)...};
    });
}

}  // namespace gnomon::recognition

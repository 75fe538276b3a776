// SPDX-License-Identifier: BSL-1.0
/// @file
/// Features of parts: what a part is like, as numbers. A feature is a policy: a name, a scale by
/// which its values are divided, a weight, and a function of a part and its view. Features are used
/// as a Boost.Hana tuple, to which a user appends a feature of his own:
///
///     struct color { ... };
///     const auto mine = boost::hana::append(gnomon::recognition::thesis_features, color{});
///
/// Scales are fixed values, stored in the model: a new object does not change what was learned.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include <boost/hana/integral_constant.hpp>
#include <boost/hana/size.hpp>
#include <boost/hana/unpack.hpp>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/view.hpp>

namespace gnomon::recognition {

/// f(part, view) is the value of the feature; f.scale is the difference [its unit] that counts as
/// 1, and f.weight its share in the distance of parts, Eq. (5.2).
template <class F>
concept part_feature = requires(const F& f, const part& p, const view& v) {
    { f(p, v) } -> std::convertible_to<double>;
    { F::name } -> std::convertible_to<std::string_view>;
    { f.scale } -> std::convertible_to<double>;
    { f.weight } -> std::convertible_to<double>;
};

/// The number of features of a tuple.
template <class Features>
inline constexpr std::size_t feature_count =
    decltype(boost::hana::size(std::declval<const Features&>()))::value;

/// The feature vector of a part: values divided by their scales.
/// @throws std::invalid_argument  if a feature needs the ground and the view has none, or a value
///                                is not finite
template <class Features>
[[nodiscard]] std::array<double, feature_count<Features>> feature_vector(const Features& features,
                                                                         const part& p,
                                                                         const view& v) {
    const auto value = [&]<part_feature F>(const F& f) {
        const double x = f(p, v) / f.scale;
        if (!std::isfinite(x))
            GNOMON_THROW(std::invalid_argument("the feature " + std::string(F::name) +
                                               " of a part is not finite"));
        return x;
    };
    return boost::hana::unpack(features, [&](const auto&... f) {
        return std::array<double, feature_count<Features>>{value(f)...};
    });
}

/// The weights of a tuple of features.
template <class Features>
[[nodiscard]] std::array<double, feature_count<Features>> feature_weights(
    const Features& features) {
    return boost::hana::unpack(features, [](const auto&... f) {
        return std::array<double, feature_count<Features>>{f.weight...};
    });
}

namespace detail {

/// @throws std::invalid_argument  without ground, or if its normal is not of unit length
[[nodiscard]] inline const plane& ground_of(const view& v, std::string_view feature) {
    if (!v.ground)
        GNOMON_THROW(std::invalid_argument("the feature " + std::string(feature) +
                                           " needs the ground of the view, which is not known"));
    gnomon::detail::require_hesse(*v.ground);
    return *v.ground;
}

}  // namespace detail
}  // namespace gnomon::recognition

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a file can hold of a point beside its position: named columns of numbers, computed when
/// they are written. Several are put together with braces:
///
///     write_ply("surface.ply", scan, {normal_properties(surface),
///                                     scalar_property("label", segments.labels())});
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/io/ply_format.hpp>

namespace gnomon::io {

/// One column.
struct property {
    std::string name;
    field_type type = field_type::float64;
    std::size_t size = 0;                      ///< for so many points
    std::function<double(std::size_t)> value;  ///< of point i
};

/// Columns in their order.
class properties {
  public:
    properties() = default;
    explicit(false) properties(property single) { columns_.push_back(std::move(single)); }

    /// All the columns of `groups`.
    properties(std::initializer_list<properties> groups) {
        for (const properties& group : groups)
            columns_.insert(columns_.end(), group.begin(), group.end());
    }

    [[nodiscard]] std::vector<property>::const_iterator begin() const { return columns_.begin(); }
    [[nodiscard]] std::vector<property>::const_iterator end() const { return columns_.end(); }
    [[nodiscard]] std::size_t size() const { return columns_.size(); }

  private:
    std::vector<property> columns_;
};

namespace detail {

/// A number, a truth value or an enumerator.
template <class T>
concept scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// The type of a file that holds every T; 64-bit integers, which PLY has not, become float64 and
/// are exact up to 2^53.
template <scalar T>
[[nodiscard]] constexpr field_type field_type_for() {
    if constexpr (std::is_enum_v<T>)
        return field_type_for<std::underlying_type_t<T>>();
    else if constexpr (std::same_as<T, float>)
        return field_type::float32;
    else if constexpr (std::floating_point<T> || sizeof(T) > 4)
        return field_type::float64;
    else if constexpr (sizeof(T) == 4)
        return std::is_signed_v<T> ? field_type::int32 : field_type::uint32;
    else if constexpr (sizeof(T) == 2)
        return std::is_signed_v<T> ? field_type::int16 : field_type::uint16;
    else
        return std::is_signed_v<T> ? field_type::int8 : field_type::uint8;
}

/// By index, what `convert` makes of the projected elements of a range that we refer to.
template <indexed_range R, class Proj, class Convert>
[[nodiscard]] auto converted(const R& range, Proj projection, Convert convert) {
    return [&range, projection = std::move(projection), convert](std::size_t i) {
        const auto first = std::ranges::begin(range);
        using difference = std::iter_difference_t<decltype(std::ranges::begin(range))>;
        return convert(std::invoke(projection, first[static_cast<difference>(i)]));
    };
}

/// Three columns, of the components of what `vector` gives by index.
template <class Vector>
[[nodiscard]] properties three_properties(const std::array<const char*, 3>& names, field_type type,
                                          std::size_t size, const Vector& vector) {
    const auto column = [&](auto k) -> properties {
        return property{names[k], type, size,
                        [vector, k](std::size_t i) { return static_cast<double>(vector(i)[k]); }};
    };
    return {column(0U), column(1U), column(2U)};
}

}  // namespace detail

/// One number for each element of `range`, in a type that holds it; refers to the range.
template <indexed_range R, class Proj = std::identity>
    requires detail::scalar<projected_element_t<R, Proj>>
[[nodiscard]] property scalar_property(std::string name, const R& range, Proj projection = {}) {
    using number = projected_element_t<R, Proj>;
    return {std::move(name), detail::field_type_for<number>(),
            static_cast<std::size_t>(std::ranges::size(range)),
            detail::converted(range, std::move(projection),
                              [](number n) { return static_cast<double>(n); })};
}

/// nx, ny, nz as float32 from 3-vectors; refers to the range.
template <indexed_range R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] properties normal_properties(const R& range, Proj projection = {}) {
    return detail::three_properties(
        {"nx", "ny", "nz"}, field_type::float32, static_cast<std::size_t>(std::ranges::size(range)),
        detail::converted(range, std::move(projection), [](const auto& n) { return position(n); }));
}

/// nx, ny, nz as float32 of the normals of a surface; refers to it.
template <normal_range S>
[[nodiscard]] properties normal_properties(const S& surface) {
    return detail::three_properties(
        {"nx", "ny", "nz"}, field_type::float32,
        static_cast<std::size_t>(std::ranges::size(surface)),
        [&surface](std::size_t i) -> Eigen::Vector3d { return surface[i].normal; });
}

/// red, green, blue from arrays of three bytes; refers to the range.
template <indexed_range R, class Proj = std::identity>
    requires std::same_as<projected_element_t<R, Proj>, std::array<std::uint8_t, 3>>
[[nodiscard]] properties color_properties(const R& range, Proj projection = {}) {
    return detail::three_properties(
        {"red", "green", "blue"}, field_type::uint8,
        static_cast<std::size_t>(std::ranges::size(range)),
        detail::converted(range, std::move(projection), [](const auto& color) { return color; }));
}

template <indexed_range R, class Proj = std::identity>
    requires detail::scalar<projected_element_t<R, Proj>>
void scalar_property(std::string name, const R&& range, Proj projection = {}) = delete;
template <indexed_range R, class Proj = std::identity>
    requires point_range<R, Proj>
void normal_properties(const R&& range, Proj projection = {}) = delete;
template <normal_range S>
void normal_properties(const S&& surface) = delete;
template <indexed_range R, class Proj = std::identity>
    requires std::same_as<projected_element_t<R, Proj>, std::array<std::uint8_t, 3>>
void color_properties(const R&& range, Proj projection = {}) = delete;

}  // namespace gnomon::io

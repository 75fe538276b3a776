// SPDX-License-Identifier: BSL-1.0
/// @file
/// Properties of points in a PLY file in addition to their positions: named columns of numbers,
/// computed when they are written. Braces combine several:
///
///     write_ply("surface.ply", scan, {normal_properties(surface),
///                                     scalar_property("label", segments.labels())});
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/ply_format.hpp>

namespace gnomon::io {

/// One column: a number for each point.
struct property {
    std::string name;                          ///< one word, unique in the file
    field_type type = field_type::float64;     ///< type in the file
    std::size_t size = 0;                      ///< number of points
    std::function<double(std::size_t)> value;  ///< the number of point i
};

/// A list of columns, in the order of the file.
class properties {
  public:
    /// No columns.
    properties() = default;
    /// One column.
    explicit(false) properties(property single) { columns_.push_back(std::move(single)); }

    /// These columns.
    explicit properties(std::vector<property> columns) : columns_(std::move(columns)) {}

    /// The columns of all `groups`, in their order.
    properties(std::initializer_list<properties> groups) {
        for (const properties& group : groups)
            for (const property& column : group) columns_.push_back(property(column));
    }

    /// The first column.
    [[nodiscard]] std::vector<property>::const_iterator begin() const { return columns_.begin(); }
    /// The end of the columns.
    [[nodiscard]] std::vector<property>::const_iterator end() const { return columns_.end(); }
    [[nodiscard]] std::size_t size() const { return columns_.size(); }

  private:
    std::vector<property> columns_;
};

namespace detail {

/// An arithmetic type, bool or an enumeration.
template <class T>
concept scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// The type of the numbers of a range: bool, where a std::vector<bool> has a proxy for it.
template <class R, class Proj, class T = gnomon::detail::projected_element_t<R, Proj>>
using number_t = std::conditional_t<
    !scalar<T> &&
        std::same_as<std::iter_value_t<decltype(std::ranges::begin(std::declval<const R&>()))>,
                     bool>,
    bool, T>;

/// The type in the file for values of type T. PLY has no 64-bit integers: they become float64,
/// which is exact up to 2^53.
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

/// The function from index i to convert(projection(range[i])). Refers to the range.
template <gnomon::detail::indexed_range R, class Proj, class Convert>
[[nodiscard]] auto converted(const R& range, Proj projection, Convert convert) {
    return [&range, projection = std::move(projection), convert](std::size_t i) {
        const auto first = std::ranges::begin(range);
        using difference = std::iter_difference_t<decltype(std::ranges::begin(range))>;
        return convert(std::invoke(projection, first[static_cast<difference>(i)]));
    };
}

/// The characters that separate words in the header of a file.
inline constexpr std::string_view blanks = " \t\v\f\r\n";

/// The name with "_" for each blank.
[[nodiscard]] inline std::string one_word(std::string name) {
    for (char& c : name)
        if (blanks.find(c) != std::string_view::npos) c = '_';
    return name.empty() ? "_" : name;
}

/// Three columns: the components of vector(i).
template <class Vector>
[[nodiscard]] properties three_properties(const std::array<const char*, 3>& names, field_type type,
                                          std::size_t size, const Vector& vector) {
    // A constant suits the index of every vector type, signed or not.
    const auto column = [&]<std::size_t K>(std::index_sequence<K>) -> properties {
        return property{names[K], type, size,
                        [vector](std::size_t i) { return static_cast<double>(vector(i)[K]); }};
    };
    return {column(std::index_sequence<0>{}), column(std::index_sequence<1>{}),
            column(std::index_sequence<2>{})};
}

}  // namespace detail

/// One number for each element of `range`.
/// @param name        of the column, one word
/// @param range       any random-access range; must outlive the result
/// @param projection  maps an element to an arithmetic value, bool or enumerator
/// @return a column whose type holds all values; 64-bit integers become float64
template <gnomon::detail::indexed_range R, class Proj = std::identity>
    requires detail::scalar<detail::number_t<R, Proj>>
[[nodiscard]] property scalar_property(std::string name, const R& range, Proj projection = {}) {
    using number = detail::number_t<R, Proj>;
    return {std::move(name), detail::field_type_for<number>(),
            static_cast<std::size_t>(std::ranges::size(range)),
            detail::converted(range, std::move(projection),
                              [](number n) { return static_cast<double>(n); })};
}

/// The columns nx, ny, nz (float32) from 3-vectors.
/// @param range       any range of points, taken as vectors; must outlive the result
/// @param projection  maps an element to a 3-vector
template <gnomon::detail::indexed_range R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] properties normal_properties(const R& range, Proj projection = {}) {
    return detail::three_properties(
        {"nx", "ny", "nz"}, field_type::float32, static_cast<std::size_t>(std::ranges::size(range)),
        detail::converted(range, std::move(projection), [](const auto& n) { return position(n); }));
}

/// The columns nx, ny, nz (float32) from the normals of a surface, which must outlive the result.
template <normal_range S>
[[nodiscard]] properties normal_properties(const S& surface) {
    return detail::three_properties(
        {"nx", "ny", "nz"}, field_type::float32,
        static_cast<std::size_t>(std::ranges::size(surface)),
        [&surface](std::size_t i) -> Eigen::Vector3d { return surface[i].normal; });
}

/// The columns red, green, blue (uint8) from arrays of three bytes.
/// @param range       any random-access range; must outlive the result
/// @param projection  maps an element to std::array<std::uint8_t, 3>
template <gnomon::detail::indexed_range R, class Proj = std::identity>
    requires std::same_as<gnomon::detail::projected_element_t<R, Proj>, std::array<std::uint8_t, 3>>
[[nodiscard]] properties color_properties(const R& range, Proj projection = {}) {
    return detail::three_properties(
        {"red", "green", "blue"}, field_type::uint8,
        static_cast<std::size_t>(std::ranges::size(range)),
        detail::converted(range, std::move(projection), [](const auto& color) { return color; }));
}

/// The fields of a scan, in the types that they had in their file, as `read` gives them for "*":
///
///     const auto scan = read("colored.ply", {"*"});
///     const properties normals = normal_properties(surface);
///     write_ply("normals.ply", scan, {normals, field_properties(scan, normals)});
///
/// Every number is written as it was read, bit for bit in binary files (a signaling NaN as a quiet
/// one). Only 64-bit integers of PCD files, for which PLY has no type, become float64: exact up to
/// 2^53.
/// @param points  must outlive the result
/// @param others  fields that have the name of one of these columns are left out
/// @return columns; blanks in their names are replaced by "_"
template <class = void>  // a template, so that unused writers cost no compile time
[[nodiscard]] properties field_properties(const scan& points, const properties& others = {}) {
    std::vector<property> columns;
    const auto is_taken = [&](const std::string& name) {
        const auto has_name = [&](const property& column) { return column.name == name; };
        return std::any_of(others.begin(), others.end(), has_name) ||
               std::any_of(columns.begin(), columns.end(), has_name);
    };
    for (const scan::scalar_field& field : points.fields) {
        std::string name = detail::one_word(field.name);
        if (is_taken(name)) continue;
        columns.push_back({std::move(name), field.type, field.values.size(),
                           [&field](std::size_t i) { return field.values[i]; }});
    }
    return properties(std::move(columns));
}
template <class = void>
void field_properties(const scan&& points, const properties& others = {}) = delete;

// The columns refer to the range, so a temporary range is an error.
template <gnomon::detail::indexed_range R, class Proj = std::identity>
    requires detail::scalar<detail::number_t<R, Proj>>
void scalar_property(std::string name, const R&& range, Proj projection = {}) = delete;
template <gnomon::detail::indexed_range R, class Proj = std::identity>
    requires point_range<R, Proj>
void normal_properties(const R&& range, Proj projection = {}) = delete;
template <normal_range S>
void normal_properties(const S&& surface) = delete;
template <gnomon::detail::indexed_range R, class Proj = std::identity>
    requires std::same_as<gnomon::detail::projected_element_t<R, Proj>, std::array<std::uint8_t, 3>>
void color_properties(const R&& range, Proj projection = {}) = delete;

}  // namespace gnomon::io

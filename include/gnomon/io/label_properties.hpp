// SPDX-License-Identifier: BSL-1.0
/// @file
/// Labels in files: as a column, as colors that viewers show, and read back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/exceptions.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::io {

/// The color of a label, as red, green, blue: twenty colors, ordered so that the first ones, those
/// of the largest segments, differ most; for labels from 20 and 40 on the same ones lighter, then
/// from the start. Grey for labels below 0, which are unlabeled.
[[nodiscard]] inline std::array<std::uint8_t, 3> label_color(std::int32_t label) {
    using color = std::array<std::uint8_t, 3>;
    constexpr color unlabeled{150, 152, 156};
    constexpr std::array<color, 20> palette{{
        {66, 133, 200},  {240, 140, 45},  {70, 165, 90},   {214, 65, 70},   {145, 105, 190},
        {64, 190, 200},  {225, 105, 175}, {190, 185, 50},  {155, 100, 70},  {95, 95, 215},
        {245, 195, 60},  {25, 130, 130},  {250, 130, 115}, {135, 200, 75},  {165, 45, 115},
        {120, 180, 240}, {200, 130, 20},  {110, 125, 50},  {205, 140, 225}, {70, 85, 130},
    }};
    if (label < 0) return unlabeled;
    const auto number = static_cast<std::size_t>(label);
    const double white = 0.25 * static_cast<double>((number / palette.size()) % 3);  // its share
    color result = palette[number % palette.size()];
    for (std::uint8_t& channel : result)
        channel = static_cast<std::uint8_t>((1.0 - white) * channel + white * 255.0 + 0.5);
    return result;
}

/// The columns red, green, blue and label (int32), for `write_ply`, `write_pcd` and `write_las`:
///
///     write_ply("surfaces.ply", scan, label_properties(segments.labels()));
///
/// @param labels  any random-access range of integers of at most 32 bits; must outlive the result
template <gnomon::detail::indexed_range R>
    requires detail::scalar<gnomon::detail::projected_element_t<R, std::identity>>
[[nodiscard]] properties label_properties(const R& labels) {
    const auto number = [](auto label) { return static_cast<std::int32_t>(label); };
    return {color_properties(labels, [=](auto label) { return label_color(number(label)); }),
            scalar_property("label", labels, number)};
}
template <gnomon::detail::indexed_range R>
    requires detail::scalar<gnomon::detail::projected_element_t<R, std::identity>>
void label_properties(const R&& labels) = delete;

/// The labels of a scan that was read with the field `name`, as the constructor of `segments` takes
/// them: -1 for unlabeled points, which are 4294967295 in the files and messages of PCL.
/// @throws gnomon::error  if there is no such field, or if a value is not a label
/// Complexity: O(points).
template <class = void>  // a template, so that unused readers cost no compile time
[[nodiscard]] std::vector<std::int32_t> labels_of(const scan& points,
                                                  const std::string& name = "label") {
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    constexpr double unsigned_unlabeled = std::numeric_limits<std::uint32_t>::max();
    for (const scan::scalar_field& field : points.fields) {
        if (field.name != name) continue;
        std::vector<std::int32_t> result;
        result.reserve(field.values.size());
        for (const double value : field.values) {
            if (!((value >= -1.0 && value <= most && value == std::trunc(value)) ||
                  value == unsigned_unlabeled))
                GNOMON_THROW(
                    error("scan", "point " + std::to_string(result.size()),
                          "field \"" + name + "\" is not a label: " + std::to_string(value)));
            result.push_back(value > most ? -1 : static_cast<std::int32_t>(value));
        }
        return result;
    }
    GNOMON_THROW(error(
        "scan", "",
        "there is no field \"" + name + "\": read the file with {\"" + name + "\"} or {\"*\"}"));
}

}  // namespace gnomon::io

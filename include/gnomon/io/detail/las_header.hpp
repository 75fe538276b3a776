// SPDX-License-Identifier: BSL-1.0
/// @file
/// The public header block of a LAS file and its variable length records (ASPRS, LAS Specification
/// 1.4 - R15, 2019; versions 1.0 to 1.3 are beginnings of it).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/io/detail/byte_cursor.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io::detail {

/// A variable length record, of either length of its header.
struct las_record {
    std::string_view user;  // without the zeros that fill it
    std::uint16_t id;
    std::string_view data;
};

/// What of the header is used, with the records. Refers to the input.
struct las_header {
    unsigned minor = 0;  // of version 1.minor
    std::uint16_t encoding = 0;
    unsigned format = 0;  // of the points
    std::size_t stride = 0;
    std::size_t points_at = 0;  // byte of the first point
    std::uint64_t points = 0;
    std::array<double, 3> scale{}, offset{};
    std::vector<las_record> records;
};

/// The records in which writers of this library keep a single viewpoint: x, y, z as doubles.
inline constexpr std::string_view las_own_user = "gnomon";
inline constexpr std::uint16_t las_viewpoint_id = 1;

/// The sizes of the header by minor version, of the headers of the two kinds of records, and of a
/// point by its format; without extra bytes.
inline constexpr std::array<std::size_t, 5> las_header_sizes = {227, 227, 227, 235, 375};
inline constexpr std::size_t las_record_header = 54, las_long_record_header = 60;
inline constexpr std::array<std::size_t, 11> las_point_sizes = {20, 28, 26, 34, 57, 63,
                                                                30, 36, 38, 59, 67};

/// Reads little-endian numbers at given places. Refers to the input.
class las_bytes {
  public:
    explicit las_bytes(const input& file) : file_(&file) {}

    /// The number at byte `at`.
    /// @throws gnomon::error  if the file ends before
    template <class T>
    [[nodiscard]] T number(std::size_t at) const {
        T value{};
        const std::string_view bytes = text(at, sizeof value);
        std::array<char, sizeof value> copy;
        for (std::size_t k = 0; k < copy.size(); ++k)
            copy[std::endian::native == std::endian::little ? k : copy.size() - 1 - k] = bytes[k];
        return std::bit_cast<T>(copy);
    }

    /// The bytes from `at` on.
    /// @throws gnomon::error  if the file ends before
    [[nodiscard]] std::string_view text(std::uint64_t at, std::uint64_t size) const {
        const std::string_view all = file_->bytes;
        if (at > all.size() || size > all.size() - at) fail(all.size(), "the file ends too early");
        return all.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
    }

    [[noreturn]] void fail(std::size_t at, const std::string& message) const {
        byte_cursor(*file_, at).fail(message);
    }

  private:
    const input* file_;
};

/// Appends `count` records from byte `at` on.
/// @param is_long  whether they are extended ones, whose length has eight bytes
/// @throws gnomon::error  if one of them ends after byte `end`
template <class = void>  // templates, so that unused readers cost no compile time
void read_las_records(const las_bytes& bytes, std::uint64_t at, std::uint64_t end,
                      std::uint64_t count, bool is_long, std::vector<las_record>& records) {
    const std::size_t header = is_long ? las_long_record_header : las_record_header;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (at > end || end - at < header)
            bytes.fail(static_cast<std::size_t>(end),
                       std::to_string(count) + " variable length records are declared, but only " +
                           std::to_string(i) + " are there");
        const auto place = static_cast<std::size_t>(at);
        const std::string_view user = bytes.text(place + 2, 16);
        const std::uint64_t size = is_long ? bytes.number<std::uint64_t>(place + 20)
                                           : bytes.number<std::uint16_t>(place + 20);
        if (size > end - at - header)
            bytes.fail(place, "a variable length record is longer than its place");
        records.push_back({user.substr(0, user.find('\0')), bytes.number<std::uint16_t>(place + 18),
                           bytes.text(place + header, size)});
        at += header + size;
    }
}

/// Refuses compressed points and unknown point formats.
template <class = void>
void require_plain_las(const las_bytes& bytes, const las_header& header, unsigned format) {
    bool compressed = (format & 0xC0U) != 0;  // the bits that LASzip sets
    for (const las_record& record : header.records)
        compressed = compressed || (record.user == "laszip encoded" && record.id == 22204);
    if (compressed)
        bytes.fail(104,
                   "the points are compressed (LAZ), which is not read: convert the file, e.g. by "
                   "\"laszip -i a.laz -o a.las\" or \"pdal translate a.laz a.las\"");
    if (format >= las_point_sizes.size())
        bytes.fail(104, "there is no point format " + std::to_string(format));
    if (header.stride < las_point_sizes[format])
        bytes.fail(105, "points of " + std::to_string(header.stride) + " bytes, but format " +
                            std::to_string(format) + " needs " +
                            std::to_string(las_point_sizes[format]));
}

/// Reads the header and the records, and checks that the file holds the points.
/// @throws gnomon::error  if the header is damaged, or if the file is compressed or of a later
///                        version
template <class = void>
[[nodiscard]] las_header read_las_header(const input& file) {
    const las_bytes bytes(file);
    if (bytes.text(0, 4) != "LASF") bytes.fail(0, "not a LAS file");
    las_header header;
    header.minor = bytes.number<std::uint8_t>(25);
    if (bytes.number<std::uint8_t>(24) != 1 || header.minor >= las_header_sizes.size())
        bytes.fail(24, "versions 1.0 to 1.4 of LAS are read");
    const std::size_t size = bytes.number<std::uint16_t>(94);
    if (size < las_header_sizes[header.minor]) bytes.fail(94, "the header is too short");
    static_cast<void>(bytes.text(0, size));
    header.encoding = bytes.number<std::uint16_t>(6);
    header.points_at = bytes.number<std::uint32_t>(96);
    header.stride = bytes.number<std::uint16_t>(105);
    header.points = bytes.number<std::uint32_t>(107);
    if (header.points_at < size || header.points_at > file.bytes.size())
        bytes.fail(96, "the points begin at byte " + std::to_string(header.points_at) +
                           ", outside the file or in its header");
    read_las_records(bytes, size, header.points_at, bytes.number<std::uint32_t>(100), false,
                     header.records);
    const unsigned format = bytes.number<std::uint8_t>(104);
    require_plain_las(bytes, header, format);
    header.format = format;
    if (header.minor >= 4) {
        // Writers of old formats may fill the old count only.
        const auto points = bytes.number<std::uint64_t>(247);
        if (points != 0) header.points = points;
        const auto records = bytes.number<std::uint32_t>(243);
        if (records != 0)
            read_las_records(bytes, bytes.number<std::uint64_t>(235), file.bytes.size(), records,
                             true, header.records);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        header.scale[k] = bytes.number<double>(131 + 8 * k);
        header.offset[k] = bytes.number<double>(155 + 8 * k);
        if (!std::isfinite(header.scale[k]) || header.scale[k] == 0.0)
            bytes.fail(131 + 8 * k, "the scale is 0 or not finite");
        if (!std::isfinite(header.offset[k])) bytes.fail(155 + 8 * k, "the offset is not finite");
    }
    byte_cursor(file, header.points_at).require_rows(header.points, header.stride);
    return header;
}

}  // namespace gnomon::io::detail

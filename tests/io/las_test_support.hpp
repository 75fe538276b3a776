// SPDX-License-Identifier: BSL-1.0
/// @file
/// LAS files of any version and point format, written byte by byte for tests, independently of
/// `write_las`.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace io_test {

/// Numbers at given bytes, little-endian.
class las_buffer {
  public:
    explicit las_buffer(std::size_t size) : bytes_(size, '\0') {}

    template <class T>
    void put(std::size_t at, T value) {
        auto copy = std::bit_cast<std::array<char, sizeof(T)>>(value);
        for (std::size_t k = 0; k < copy.size(); ++k)
            bytes_.at(at + k) =
                copy[std::endian::native == std::endian::little ? k : copy.size() - 1 - k];
    }
    void put_text(std::size_t at, const std::string& text) {
        bytes_.replace(at, text.size(), text);
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// The attributes of a point as the specification lists them.
struct las_point {
    std::int32_t x = 0, y = 0, z = 0;
    std::uint16_t intensity = 0;
    unsigned return_number = 1, returns = 1, direction = 0, edge = 0;
    unsigned classification = 0, synthetic = 0, key_point = 0, withheld = 0, overlap = 0;
    unsigned channel = 0;
    int angle = 0;  // as stored
    std::uint8_t user_data = 0;
    std::uint16_t source = 0;
    double time = 0.0;
    std::uint16_t red = 0, green = 0, blue = 0, infrared = 0;
};

/// What varies between files.
struct las_file {
    unsigned minor = 2, format = 0;
    std::vector<las_point> points = {};
    std::array<double, 3> scale{0.01, 0.001, 0.5}, offset{400000, 5e6, -3};
    std::size_t longer_header = 0, gap = 0;  // bytes after the header, and before the points
    std::vector<std::string> records = {}, long_records = {};
    std::vector<std::string> extra = {};  // bytes of each point
    std::size_t extra_size = 0;
};

/// A record, with its header.
[[nodiscard]] inline std::string las_record_bytes(const std::string& user, std::uint16_t id,
                                                  const std::string& data, bool is_long = false) {
    las_buffer header(is_long ? 60 : 54);
    header.put_text(2, user);
    header.put(18, id);
    if (is_long)
        header.put(20, std::uint64_t{data.size()});
    else
        header.put(20, static_cast<std::uint16_t>(data.size()));
    return header.bytes() + data;
}

/// A description of extra bytes.
[[nodiscard]] inline std::string las_extra_description(unsigned type, unsigned options,
                                                       const std::string& name,
                                                       const std::vector<double>& scale = {},
                                                       const std::vector<double>& offset = {}) {
    las_buffer d(192);
    d.put(2, static_cast<std::uint8_t>(type));
    d.put(3, static_cast<std::uint8_t>(options));
    d.put_text(4, name);
    for (std::size_t k = 0; k < scale.size(); ++k) d.put(112 + 8 * k, scale[k]);
    for (std::size_t k = 0; k < offset.size(); ++k) d.put(136 + 8 * k, offset[k]);
    return d.bytes();
}

/// The bytes of a point, without its extra bytes (LAS 1.4 R15, tables 7 to 17).
[[nodiscard]] inline std::string las_point_bytes(unsigned format, const las_point& p) {
    constexpr std::array<std::size_t, 11> sizes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
    const auto byte = [](unsigned n) { return static_cast<std::uint8_t>(n); };
    las_buffer b(sizes.at(format));
    b.put(0, p.x);
    b.put(4, p.y);
    b.put(8, p.z);
    b.put(12, p.intensity);
    std::size_t next = 0;
    if (format < 6) {
        b.put(14, byte(p.return_number | p.returns << 3 | p.direction << 6 | p.edge << 7));
        b.put(15, byte(p.classification | p.synthetic << 5 | p.key_point << 6 | p.withheld << 7));
        b.put(16, static_cast<std::int8_t>(p.angle));
        b.put(17, p.user_data);
        b.put(18, p.source);
        next = 20;
    } else {
        b.put(14, byte(p.return_number | p.returns << 4));
        b.put(15, byte(p.synthetic | p.key_point << 1 | p.withheld << 2 | p.overlap << 3 |
                       p.channel << 4 | p.direction << 6 | p.edge << 7));
        b.put(16, byte(p.classification));
        b.put(17, p.user_data);
        b.put(18, static_cast<std::int16_t>(p.angle));
        b.put(20, p.source);
        next = 22;
    }
    if (format != 0 && format != 2) {
        b.put(next, p.time);
        next += 8;
    }
    const bool has_color =
        format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
    if (has_color) {
        b.put(next, p.red);
        b.put(next + 2, p.green);
        b.put(next + 4, p.blue);
        next += 6;
    }
    if (format == 8 || format == 10) b.put(next, p.infrared);
    return b.bytes();
}

/// The bytes of a file.
[[nodiscard]] inline std::string las_bytes(const las_file& f) {
    const std::size_t header_size = (f.minor < 3    ? 227U
                                     : f.minor == 3 ? 235U
                                                    : 375U) +
                                    f.longer_header;
    std::string records, points, long_records;
    for (const std::string& r : f.records) records += r;
    for (const std::string& r : f.long_records) long_records += r;
    for (std::size_t i = 0; i < f.points.size(); ++i) {
        points += las_point_bytes(f.format, f.points[i]);
        points += i < f.extra.size() ? f.extra[i] : std::string(f.extra_size, '\0');
    }
    const std::size_t start = header_size + records.size() + f.gap;
    las_buffer h(header_size);
    h.put_text(0, "LASF");
    h.put(24, std::uint8_t{1});
    h.put(25, static_cast<std::uint8_t>(f.minor));
    h.put(94, static_cast<std::uint16_t>(header_size));
    h.put(96, static_cast<std::uint32_t>(start));
    h.put(100, static_cast<std::uint32_t>(f.records.size()));
    h.put(104, static_cast<std::uint8_t>(f.format));
    h.put(105, static_cast<std::uint16_t>(las_point_bytes(f.format, {}).size() + f.extra_size));
    if (f.format < 6) h.put(107, static_cast<std::uint32_t>(f.points.size()));
    for (std::size_t k = 0; k < 3; ++k) {
        h.put(131 + 8 * k, f.scale[k]);
        h.put(155 + 8 * k, f.offset[k]);
    }
    if (f.minor >= 4) {
        h.put(247, std::uint64_t{f.points.size()});
        h.put(243, static_cast<std::uint32_t>(f.long_records.size()));
        h.put(235, std::uint64_t{start + points.size()});
    }
    return h.bytes() + records + std::string(f.gap, '\x5a') + points + long_records;
}

}  // namespace io_test

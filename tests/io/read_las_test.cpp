// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include "las_test_support.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/io/read_las.hpp>

namespace {

namespace io = gnomon::io;
using io_test::las_file;
using io_test::las_point;

const auto las_parser = [](const io::input& file) { return io::read_las(file, {"*"}); };

gnomon::scan parse_las(const std::string& bytes, const std::vector<std::string>& fields = {"*"}) {
    return io::read_las({"some.file", bytes}, fields);
}

/// A random point whose attributes fit a point format.
las_point random_las_point(gnomon::random_stream& random, unsigned format) {
    const auto below = [&random](std::size_t n) { return static_cast<unsigned>(random.below(n)); };
    const bool old = format < 6;
    las_point p;
    p.x = static_cast<std::int32_t>(random.bits());
    p.y = static_cast<std::int32_t>(random.bits());
    p.z = static_cast<std::int32_t>(random.bits());
    p.intensity = static_cast<std::uint16_t>(below(65536));
    p.return_number = below(old ? 8 : 16);
    p.returns = below(old ? 8 : 16);
    p.direction = below(2);
    p.edge = below(2);
    p.classification = below(old ? 32 : 256);
    p.synthetic = below(2);
    p.key_point = below(2);
    p.withheld = below(2);
    p.overlap = below(2);
    p.channel = below(4);
    p.angle = old ? static_cast<int>(below(181)) - 90 : static_cast<int>(below(60001)) - 30000;
    p.user_data = static_cast<std::uint8_t>(below(256));
    p.source = static_cast<std::uint16_t>(below(65536));
    p.time = 1e9 * random.uniform() - 5e8;
    p.red = static_cast<std::uint16_t>(below(65536));
    p.green = static_cast<std::uint16_t>(below(65536));
    p.blue = static_cast<std::uint16_t>(below(65536));
    p.infrared = static_cast<std::uint16_t>(below(65536));
    return p;
}

las_file random_las_file(unsigned minor, unsigned format, std::size_t points) {
    gnomon::random_stream random(1000 + 16 * minor + format);
    las_file file{.minor = minor, .format = format};
    for (std::size_t i = 0; i < points; ++i)
        file.points.push_back(random_las_point(random, format));
    return file;
}

/// The values that a reader has to find, by name.
std::map<std::string, double> values_of(unsigned format, const las_point& p) {
    std::map<std::string, double> all{
        {"intensity", p.intensity},       {"return_number", p.return_number},
        {"number_of_returns", p.returns}, {"scan_direction_flag", p.direction},
        {"edge_of_flight_line", p.edge},  {"classification", p.classification},
        {"synthetic", p.synthetic},       {"key_point", p.key_point},
        {"withheld", p.withheld},         {"scan_angle", format < 6 ? p.angle : 0.006 * p.angle},
        {"user_data", p.user_data},       {"point_source_id", p.source}};
    if (format >= 6) {
        all["overlap"] = p.overlap;
        all["scanner_channel"] = p.channel;
    }
    if (format != 0 && format != 2) all["gps_time"] = p.time;
    for (const unsigned with_color : {2U, 3U, 5U, 7U, 8U, 10U}) {
        if (format != with_color) continue;
        all["red"] = p.red;
        all["green"] = p.green;
        all["blue"] = p.blue;
    }
    if (format == 8 || format == 10) all["nir"] = p.infrared;
    return all;
}

void expect_points_of(const las_file& file, const gnomon::scan& s) {
    ASSERT_EQ(s.size(), file.points.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        const las_point& p = file.points[i];
        EXPECT_EQ(s.points[i], Eigen::Vector3d(file.scale[0] * p.x + file.offset[0],
                                               file.scale[1] * p.y + file.offset[1],
                                               file.scale[2] * p.z + file.offset[2]));
    }
}

TEST(io_read_las, reads_every_point_format_of_every_version) {
    for (unsigned minor = 0; minor <= 4; ++minor) {
        const unsigned last = minor < 2 ? 1 : minor == 2 ? 3 : minor == 3 ? 5 : 10;
        for (unsigned format = 0; format <= last; ++format) {
            SCOPED_TRACE("LAS 1." + std::to_string(minor) + ", format " + std::to_string(format));
            const las_file file = random_las_file(minor, format, 50);
            const gnomon::scan s = parse_las(las_bytes(file));
            expect_points_of(file, s);
            EXPECT_TRUE(s.viewpoints.empty());
            ASSERT_EQ(s.fields.size(), values_of(format, {}).size());
            for (const gnomon::scan::scalar_field& field : s.fields) {
                for (std::size_t i = 0; i < s.size(); ++i)
                    ASSERT_EQ(field.values[i], values_of(format, file.points[i]).at(field.name))
                        << field.name;
            }
        }
    }
}

TEST(io_read_las, keeps_the_types_of_the_file) {
    using type = gnomon::scan::field_type;
    const std::map<std::string, type> expected{{"intensity", type::uint16},
                                               {"classification", type::uint8},
                                               {"scan_angle", type::float64},
                                               {"gps_time", type::float64},
                                               {"nir", type::uint16}};
    const gnomon::scan s =
        parse_las(las_bytes(random_las_file(4, 8, 1)),
                  {"intensity", "classification", "scan_angle", "gps_time", "nir"});
    for (const auto& field : s.fields) EXPECT_EQ(field.type, expected.at(field.name)) << field.name;
}

TEST(io_read_las, reads_fields_by_name_and_none_without) {
    const las_file file = random_las_file(2, 3, 5);
    const gnomon::scan some = parse_las(las_bytes(file), {"green", "intensity"});
    ASSERT_EQ(some.fields.size(), 2U);
    EXPECT_EQ(some.fields[0].values[4], file.points[4].green);
    EXPECT_EQ(some.fields[1].values[4], file.points[4].intensity);
    const gnomon::scan none = parse_las(las_bytes(file), {});
    EXPECT_TRUE(none.fields.empty());
    expect_points_of(file, none);
    io_test::expect_error([](const auto& f) { return io::read_las(f, {"label"}); }, las_bytes(file),
                          "byte 227", "there is no field \"label\"; there are: x, y, z, intensity");
}

TEST(io_read_las, finds_points_after_longer_headers_records_and_gaps) {
    las_file file = random_las_file(4, 6, 20);
    file.longer_header = 13;
    file.gap = 7;
    file.extra_size = 5;  // without a description
    file.records = {io_test::las_record_bytes("LASF_Projection", 2112, "GEOGCS"),
                    io_test::las_record_bytes("someone", 4, "")};
    file.long_records = {io_test::las_record_bytes("someone", 7, "1234567890", true)};
    const gnomon::scan s = parse_las(las_bytes(file));
    expect_points_of(file, s);
    EXPECT_EQ(s.fields.size(), 15U);
}

TEST(io_read_las, reads_the_old_count_where_the_new_one_is_empty) {
    const las_file file = random_las_file(4, 1, 3);
    io_test::las_buffer count(8);
    std::string bytes = las_bytes(file);
    EXPECT_EQ(parse_las(bytes.replace(247, 8, count.bytes())).size(), 3U);
    count.put(0, std::uint64_t{2});
    EXPECT_EQ(parse_las(bytes.replace(247, 8, count.bytes())).size(), 2U);
}

/// Extra bytes of all types, an array, and scaled ones.
las_file file_of_extra_bytes(bool in_long_record) {
    las_file file = random_las_file(4, 6, 2);
    std::string descriptions;
    const char* const names[] = {"u8",  "i8",  "u16", "i16", "u32",
                                 "i32", "u64", "i64", "f32", "f64"};
    const std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    for (unsigned k = 0; k < 10; ++k)
        descriptions += io_test::las_extra_description(k + 1, 0, names[k]);
    descriptions += io_test::las_extra_description(0, 3, "undocumented");
    descriptions += io_test::las_extra_description(24, 0, "normal");  // three int16
    descriptions += io_test::las_extra_description(4, 8 + 16, "height above ground", {0.01}, {100});
    descriptions += io_test::las_extra_description(1, 16, "moved", {7}, {-1});
    file.extra_size = 3 + 6 + 2 + 1;
    for (const std::size_t size : sizes) file.extra_size += size;
    for (std::size_t i = 0; i < 2; ++i) {
        io_test::las_buffer b(file.extra_size);
        const double sign = i == 0 ? 1 : -1;
        b.put(0, std::uint8_t{200});
        b.put(1, static_cast<std::int8_t>(-100));
        b.put(2, std::uint16_t{65535});
        b.put(4, static_cast<std::int16_t>(-32768));
        b.put(6, std::uint32_t{4294967295U});
        b.put(10, static_cast<std::int32_t>(sign * 2147483647.0));
        b.put(14, std::uint64_t{1} << 53U);
        b.put(22, static_cast<std::int64_t>(sign * 4e15));
        b.put(30, static_cast<float>(sign * 0.1));
        b.put(34, sign * 0.1);
        for (std::size_t k = 0; k < 3; ++k)
            b.put(45 + 2 * k, static_cast<std::int16_t>(sign * static_cast<double>(k + 1)));
        b.put(51, static_cast<std::int16_t>(sign * 250.0));
        b.put(53, std::uint8_t{5});
        file.extra.push_back(b.bytes());
    }
    auto& records = in_long_record ? file.long_records : file.records;
    records.push_back(io_test::las_record_bytes("LASF_Spec", 4, descriptions, in_long_record));
    return file;
}

TEST(io_read_las, reads_extra_bytes) {
    for (const bool in_long_record : {false, true}) {
        const gnomon::scan s = parse_las(las_bytes(file_of_extra_bytes(in_long_record)));
        const std::vector<std::pair<std::string, std::vector<double>>> expected = {
            {"u8", {200, 200}},
            {"i8", {-100, -100}},
            {"u16", {65535, 65535}},
            {"i16", {-32768, -32768}},
            {"u32", {4294967295, 4294967295}},
            {"i32", {2147483647, -2147483647}},
            {"u64", {9007199254740992, 9007199254740992}},
            {"i64", {4e15, -4e15}},
            {"f32", {0.1F, -0.1F}},
            {"f64", {0.1, -0.1}},
            {"normal[0]", {1, -1}},
            {"normal[1]", {2, -2}},
            {"normal[2]", {3, -3}},
            {"height above ground", {102.5, 97.5}},
            {"moved", {4, 4}}};
        ASSERT_EQ(s.fields.size(), 15 + expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) {
            EXPECT_EQ(s.fields[15 + k].name, expected[k].first);
            EXPECT_EQ(s.fields[15 + k].values, expected[k].second) << expected[k].first;
        }
    }
}

/// The bytes of a file with a number replaced.
template <class T>
std::string with_number(std::string bytes, std::size_t at, T value) {
    io_test::las_buffer number(sizeof value);
    number.put(0, value);
    return bytes.replace(at, sizeof value, number.bytes());
}

TEST(io_read_las, refuses_a_damaged_header) {
    las_file file = random_las_file(4, 6, 2);
    file.records = {io_test::las_record_bytes("someone", 1, "data")};
    const std::string good = las_bytes(file);
    const auto refuse = [&](std::size_t at, auto value, const std::string& position,
                            const std::string& why) {
        io_test::expect_error(las_parser, with_number(good, at, value), position, why);
    };
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();
    const std::string end = "byte " + std::to_string(good.size());
    refuse(0, 'l', "byte 0", "not a LAS file");
    refuse(24, std::uint8_t{2}, "byte 24", "1.0 to 1.4");
    refuse(25, std::uint8_t{5}, "byte 24", "1.0 to 1.4");
    refuse(94, std::uint16_t{374}, "byte 94", "too short");
    refuse(94, std::uint16_t{65535}, end, "ends too early");
    refuse(96, std::uint32_t{374}, "byte 96", "byte 374, outside");
    refuse(96, std::uint32_t{4294967295U}, "byte 96", "outside the file");
    refuse(100, std::uint32_t{2}, "byte 433", "2 variable length records are declared");
    refuse(100, std::uint32_t{4294967295U}, "byte 433", "but only 1 are there");
    refuse(395, std::uint16_t{5}, "byte 375", "longer than its place");
    refuse(104, std::uint8_t{11}, "byte 104", "no point format 11");
    refuse(105, std::uint16_t{29}, "byte 105", "points of 29 bytes, but format 6 needs 30");
    refuse(105, std::uint16_t{0}, "byte 105", "points of 0 bytes");
    refuse(131, 0.0, "byte 131", "scale");
    refuse(147, not_a_number, "byte 147", "scale");
    refuse(163, std::numeric_limits<double>::infinity(), "byte 163", "offset");
    refuse(243, std::uint32_t{1}, end, "1 variable length records are declared");
    refuse(247, std::uint64_t{3}, "byte 433", "3 points or elements are declared");
    for (const std::uint64_t many : {std::uint64_t{1} << 40U, ~std::uint64_t{0}})
        refuse(247, many, "byte 433", "bytes are left");
}

TEST(io_read_las, refuses_damaged_descriptions_of_extra_bytes) {
    las_file file = random_las_file(4, 6, 1);
    file.extra_size = 4;
    for (const unsigned type : {31U, 255U}) {
        file.records = {io_test::las_record_bytes("LASF_Spec", 4,
                                                  io_test::las_extra_description(type, 0, "a"))};
        io_test::expect_error(las_parser, las_bytes(file), "byte 431", "of extra bytes");
    }
    for (const unsigned type : {10U, 15U}) {  // of eight bytes
        file.records = {io_test::las_record_bytes("LASF_Spec", 4,
                                                  io_test::las_extra_description(type, 0, "a"))};
        io_test::expect_error(las_parser, las_bytes(file), "byte 429", "longer than a point");
    }
}

/// By the bits that LASzip sets in the point format, or by its record.
TEST(io_read_las, refuses_compressed_files_and_names_a_tool) {
    const las_file file = random_las_file(2, 1, 2);
    for (const unsigned bit : {0x80U, 0x40U})
        io_test::expect_error(las_parser,
                              with_number(las_bytes(file), 104, static_cast<std::uint8_t>(1 | bit)),
                              "byte 104", "laszip");
    las_file recorded = file;
    recorded.records = {io_test::las_record_bytes("laszip encoded", 22204, "1234")};
    io_test::expect_error(las_parser, las_bytes(recorded), "byte 104", "pdal translate");
}

TEST(io_read_las, survives_truncation_and_damage) {
    for (const bool in_long_record : {false, true}) {
        const std::string bytes = las_bytes(file_of_extra_bytes(in_long_record));
        io_test::check_truncation(las_parser, bytes, true);
        io_test::check_mutation(las_parser, bytes);
    }
    for (const unsigned format : {0U, 3U, 5U, 10U}) {
        const std::string bytes = las_bytes(random_las_file(4, format, 3));
        io_test::check_truncation(las_parser, bytes, true);
        io_test::check_mutation(las_parser, bytes, 1000);
        gnomon::random_stream random(format);
        for (int round = 0; round < 2000; ++round) {  // single bits
            std::string damaged = bytes;
            char& c = damaged[random.below(damaged.size())];
            c = static_cast<char>(static_cast<unsigned char>(c) ^ (1U << (random.below(8))));
            io_test::survives(las_parser, damaged);
        }
    }
}

TEST(io_read_las, reads_files_without_points) {
    const gnomon::scan s = parse_las(io_test::las_bytes({.minor = 2, .format = 1}));
    EXPECT_EQ(s.size(), 0U);
    EXPECT_EQ(s.fields.size(), 13U);
}

}  // namespace

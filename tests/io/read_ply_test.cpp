// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/scan.hpp>
#include <gnomon/io/read_ply.hpp>

namespace {

const auto ply_parser = [](const gnomon::io::input& file) { return gnomon::io::read_ply(file); };

gnomon::scan parse_ply(const std::string& bytes, const std::vector<std::string>& fields = {}) {
    return gnomon::io::read_ply({"some.file", bytes}, fields);
}

/// A file of a header with the given declarations, and a body.
std::string ply_of(const std::string& format, const std::string& declarations,
                   const std::string& body) {
    return "ply\nformat " + format + " 1.0\n" + declarations + "end_header\n" + body;
}

const std::string xyz_bytes = "property char x\nproperty char y\nproperty char z\n";

TEST(io_read_ply, reads_ascii_with_every_liberty_it_has) {
    const gnomon::scan s = parse_ply(
        "ply\r\n"
        "format ascii 1.0\r\n"
        "comment viewpoint of the camera\r\n"
        "comment viewpoint 1 -2.5 3e2\r\n"
        "obj_info whatever\r\n"
        "element face 2\r\n"
        "property list uchar int vertex_indices\r\n"
        "property float area\r\n"
        "element nothing 9223372036854775808\r\n"
        "element vertex 3\r\n"
        "property double z\r\n"
        "property list uint8 float32 weights\r\n"
        "property float x\r\n"
        "property float32 y\r\n"
        "property uchar red\r\n"
        "element edge 1\r\n"
        "property int a\r\n"
        "end_header\r\n"
        "3 0 1 2 0.5\r\n"
        "0 0.5\r\n"
        "  +3 0 1\t2 255  \r\n"
        "\r\n"
        "5691234.123456789 2 7 8 nan -nan 1\r\n"
        "-inf 0 INF 1e-3 0\r\n"
        "99",
        {"red", "z"});
    ASSERT_EQ(s.size(), 3U);
    EXPECT_EQ(s.points[0], Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(std::isnan(s.points[1].x()));
    EXPECT_TRUE(std::isnan(s.points[1].y()));
    EXPECT_EQ(s.points[1].z(), 5691234.123456789);
    EXPECT_TRUE(std::isinf(s.points[2].x()));
    EXPECT_EQ(s.points[2].y(), 1e-3);
    ASSERT_EQ(s.fields.size(), 2U);
    EXPECT_EQ(s.fields[0].name, "red");
    EXPECT_EQ(s.fields[0].values, (std::vector<double>{255, 1, 0}));
    EXPECT_EQ(s.fields[1].values[0], 3);
    ASSERT_EQ(s.viewpoints.positions().size(), 1U);
    EXPECT_EQ(s.viewpoints[0], Eigen::Vector3d(1, -2.5, 300));
}

TEST(io_read_ply, reads_every_type_in_both_byte_orders_and_spellings) {
    const std::string little = io_test::bytes_of(
        "\x80\xff\x01\x80\xfe\xff\xff\xff\xff\x7f\x00\x00\x00\x80\xff\xff\xff\xff"
        "\x00\x00\xc0\x3f\x00\x00\x00\x00\x00\x00\xf8\xbf");
    const std::string big = io_test::bytes_of(
        "\x80\xff\x80\x01\xff\xfe\x7f\xff\xff\xff\x80\x00\x00\x00\xff\xff\xff\xff"
        "\x3f\xc0\x00\x00\xbf\xf8\x00\x00\x00\x00\x00\x00");
    const std::string old_names =
        "element vertex 1\nproperty char a\nproperty uchar b\nproperty short c\nproperty ushort d\n"
        "property int e\nproperty int x\nproperty uint y\nproperty float z\nproperty double f\n";
    const std::string new_names =
        "element vertex 1\nproperty int8 a\nproperty uint8 b\nproperty int16 c\nproperty uint16 "
        "d\nproperty int32 e\nproperty int32 x\nproperty uint32 y\nproperty float32 z\nproperty "
        "float64 f\n";
    for (const std::string& names : {old_names, new_names}) {
        for (const bool is_big : {false, true}) {
            const gnomon::scan s =
                parse_ply(ply_of(is_big ? "binary_big_endian" : "binary_little_endian", names,
                                 is_big ? big : little),
                          {"a", "b", "c", "d", "e", "f"});
            ASSERT_EQ(s.size(), 1U);
            EXPECT_EQ(s.points[0], Eigen::Vector3d(-2147483648.0, 4294967295.0, 1.5));
            EXPECT_EQ(s.fields[0].values[0], -128);
            EXPECT_EQ(s.fields[1].values[0], 255);
            EXPECT_EQ(s.fields[2].values[0], -32767);
            EXPECT_EQ(s.fields[3].values[0], 65534);
            EXPECT_EQ(s.fields[4].values[0], 2147483647);
            EXPECT_EQ(s.fields[5].values[0], -1.5);
        }
    }
}

const std::string ply_with_lists =
    ply_of("binary_big_endian",
           "element face 2\nproperty list ushort int i\nproperty char flag\n"
           "element vertex 2\nproperty char x\nproperty char y\nproperty list char char w\n"
           "property char z\n",
           io_test::bytes_of("\0\2\0\0\0\0\0\0\0\1\7\0\0\7\1\2\0\3\4\5\2\7\7\6"));

TEST(io_read_ply, skips_elements_and_lists_in_binary) {
    const gnomon::scan s = parse_ply(ply_with_lists + "and more");
    ASSERT_EQ(s.size(), 2U);
    EXPECT_EQ(s.points[0], Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(s.points[1], Eigen::Vector3d(4, 5, 6));
    EXPECT_TRUE(s.viewpoints.empty());
}

TEST(io_read_ply, reads_a_cloud_of_no_points) {
    EXPECT_EQ(parse_ply(ply_of("ascii", "element vertex 0\n" + xyz_bytes, "")).size(), 0U);
}

TEST(io_read_ply, rejects_files_shorter_than_their_header_declares) {
    for (const std::string count : {"3", "2000000000", "9223372036854775808"}) {
        const std::string declarations = "element vertex " + count + "\n" + xyz_bytes;
        const std::string header = ply_of("binary_little_endian", declarations, "");
        io_test::expect_error(ply_parser, header + "12345678",
                              "byte " + std::to_string(header.size()), "bytes are left");
        io_test::expect_error(ply_parser, ply_of("ascii", declarations, "1 2 3\n4 5 6\n"), "line 7",
                              "bytes are left");
    }
    io_test::expect_error(ply_parser,
                          ply_of("ascii", "element vertex 2\n" + xyz_bytes, "1 2 3\n\n\n\n\n\n"),
                          "line 14", "ends too early");
    io_test::expect_error(
        ply_parser,
        ply_of("binary_little_endian",
               "element f 1\nproperty list uint double i\nelement vertex 1\n" + xyz_bytes,
               io_test::bytes_of("\xff\xff\xff\xff\0\0\0\0\0\0\0\0")),
        "byte 164", "ends too early");
}

TEST(io_read_ply, refuses_a_damaged_header) {
    const std::string vertex = "element vertex 1\n";
    const auto refuse = [](const std::string& bytes, const std::string& at,
                           const std::string& why) {
        io_test::expect_error(ply_parser, bytes, at, why);
    };
    refuse("", "line 1", "ends too early");
    refuse("plx\n", "line 1", "not a PLY");
    refuse("ply\nformat ascii 1.0\nelement vertex 1\n", "line 4", "ends too early");
    refuse("ply\nformat utf8 1.0\n", "line 2", "\"utf8\" is not a PLY format");
    refuse("ply\nelement vertex 1\n" + xyz_bytes + "end_header\n1 2 3", "line 6", "no format");
    refuse(ply_of("ascii", "elemental\n", ""), "line 3", "\"elemental\" is not a keyword");
    refuse(ply_of("ascii", "\x01\x02\xff\n", ""), "line 3", "\"???\"");
    refuse(ply_of("ascii", "element vertex -1\n", ""), "line 3", "\"-1\" is not a count");
    refuse(ply_of("ascii", "element vertex\n", ""), "line 3", "missing");
    refuse(ply_of("ascii", "element vertex 99999999999999999999\n", ""), "line 3", "out of range");
    refuse(ply_of("ascii", "property char x\n", ""), "line 3", "no element");
    refuse(ply_of("ascii", vertex + "property half x\n", ""), "line 4", "\"half\" is not a type");
    refuse(ply_of("ascii", vertex + "property list float int x\n", ""), "line 4", "integers");
    refuse(ply_of("ascii", vertex + "property char\n", ""), "line 4", "no name");
    refuse(ply_of("ascii", vertex + "property char x\nproperty char z\n", "1 2"), "line 6",
           "no field \"y\"; there are: x, z");
    refuse(ply_of("ascii", "element face 0\n", ""), "line 4", "no field \"x\"");
}

TEST(io_read_ply, refuses_damaged_rows) {
    const std::string three = "element vertex 1\n" + xyz_bytes;
    const auto refuse = [&](const std::string& row, const std::string& why) {
        io_test::expect_error(ply_parser, ply_of("ascii", three, row), "line 8", why);
    };
    refuse("1 2    ", "missing");
    refuse("1 2 3 4", "more values");
    refuse("1 2 3x ", "\"3x\" is not a number");
    refuse("1 2 +-3", "not a number");
    refuse("1 2 0x3", "not a number");
    refuse("1 2 1e999", "\"1e999\" is out of range");
    io_test::expect_error(
        ply_parser,
        ply_of("ascii", "element f 1\nproperty list char char i\n" + three, "-1\n1 2 3\n"),
        "line 10", "impossible length");
}

TEST(io_read_ply, lists_the_fields_there_are) {
    const std::string bytes = ply_of("ascii", "element vertex 1\n" + xyz_bytes, "1 2 3");
    io_test::expect_error([](const auto& file) { return gnomon::io::read_ply(file, {"nx"}); },
                          bytes, "line 7", "no field \"nx\"; there are: x, y, z");
}

TEST(io_read_ply, gives_all_properties_in_their_types) {
    const std::string bytes =
        ply_of("ascii",
               "element vertex 1\nproperty uchar red\nproperty float x\nproperty list uchar int i\n"
               "property double y\nproperty float z\nproperty short red\nproperty int viewpoint_x\n"
               "property double time\n",
               "200 1 2 8 9 3 4 -7 5 6.5\n");
    const gnomon::scan s = parse_ply(bytes, {"*"});
    using enum gnomon::scan::field_type;
    const std::vector<std::string> names{"red", "viewpoint_x", "time"};  // of equals the first
    const std::vector<gnomon::scan::field_type> types{uint8, int32, float64};
    const std::vector<double> values{200, 5, 6.5};
    ASSERT_EQ(s.fields.size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
        EXPECT_EQ(s.fields[k].name, names[k]);
        EXPECT_EQ(s.fields[k].type, types[k]);
        EXPECT_EQ(s.fields[k].values, std::vector<double>{values[k]});
    }
    EXPECT_EQ(parse_ply(bytes, {"time"}).fields[0].type, float64);
    EXPECT_TRUE(parse_ply(bytes).fields.empty());
}

TEST(io_read_ply, survives_truncation_and_damage) {
    const auto all_fields = [](const gnomon::io::input& file) {
        return gnomon::io::read_ply(file, {"*"});
    };
    io_test::check_truncation(all_fields, ply_with_lists, true);
    io_test::check_mutation(all_fields, ply_with_lists);

    io_test::check_truncation(ply_parser, ply_with_lists, true);
    io_test::check_mutation(ply_parser, ply_with_lists);
    const std::string text =
        ply_of("ascii", "element f 1\nproperty list char int i\nelement vertex 2\n" + xyz_bytes,
               "2 7 7\n1 2 3\n4 5 nan\n");
    io_test::check_truncation(ply_parser, text, false);
    io_test::check_mutation(ply_parser, text);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/scan.hpp>
#include <gnomon/io/read_pcd.hpp>

namespace {

const auto pcd_parser = [](const gnomon::io::input& file) { return gnomon::io::read_pcd(file); };

gnomon::scan parse_pcd(const std::string& bytes, const std::vector<std::string>& fields = {}) {
    return gnomon::io::read_pcd({"some.file", bytes}, fields);
}

/// Four bytes, little-endian.
std::string pcd_word(std::size_t n) {
    std::string result;
    for (int k = 0; k < 4; ++k, n /= 256) result += static_cast<char>(n % 256);
    return result;
}

/// LZF data of literal runs only, without compression.
std::string pcd_pack(const std::string& bytes) {
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); i += 32) {
        const std::string run = bytes.substr(i, 32);
        result += static_cast<char>(run.size() - 1);
        result += run;
    }
    return result;
}

const std::string pcd_xyz =
    "VERSION 0.7\nFIELDS x y z\nSIZE 1 1 1\nTYPE I I I\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";

const std::string pcd_mixed =
    "# .PCD v.7\nVERSION .7\n#inside\nFIELDS _ x y z h a b c\nSIZE 1 4 4 8 2 8 8 1\n"
    "TYPE U F F F I I U U\nCOUNT 3 1 1 1 2 1 1 1\nWIDTH 1\nHEIGHT 2\n"
    "VIEWPOINT 1 2.5 -3 0 1 0 0\nPOINTS 2\n";

const std::vector<std::string> pcd_mixed_fields = {"h[1]", "h[0]", "a", "b", "c"};

void expect_mixed(const gnomon::scan& s) {
    ASSERT_EQ(s.size(), 2U);
    EXPECT_EQ(s.points[0], Eigen::Vector3d(1.5, -1.5, 2));
    EXPECT_TRUE(std::isnan(s.points[1].x()));
    EXPECT_EQ(s.points[1].y(), 2);
    EXPECT_EQ(s.points[1].z(), 0);
    EXPECT_EQ(s.fields[0].values, (std::vector<double>{-2, 258}));
    EXPECT_EQ(s.fields[1].values, (std::vector<double>{1, 3}));
    EXPECT_EQ(s.fields[2].values, (std::vector<double>{-1, 2}));
    EXPECT_EQ(s.fields[3].values, (std::vector<double>{18446744073709551615.0, 3}));
    EXPECT_EQ(s.fields[4].values, (std::vector<double>{200, 4}));
    ASSERT_EQ(s.viewpoints.positions().size(), 1U);
    EXPECT_EQ(s.viewpoints[1], Eigen::Vector3d(1, 2.5, -3));
}

TEST(io_read_pcd, keeps_the_width_of_organized_images) {
    const auto width_of = [](const char* size) {
        return parse_pcd(std::string("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n") + size +
                         "DATA ascii\n0 0 1\n1 0 1\nnan nan nan\n1 1 1\n")
            .width;
    };
    EXPECT_EQ(width_of("WIDTH 2\nHEIGHT 2\n"), 2u);
    EXPECT_EQ(width_of("WIDTH 1\nHEIGHT 4\n"), 1u);
    EXPECT_EQ(width_of("WIDTH 4\nHEIGHT 1\n"), 0u);  // a list of points
    EXPECT_EQ(width_of("POINTS 4\n"), 0u);
}

TEST(io_read_pcd, reads_ascii) {
    expect_mixed(parse_pcd(pcd_mixed +
                               "DATA ascii\n0 0 0 1.5 -1.5 2 1 -2 -1 18446744073709551615 200\n"
                               "9 9 9 nan +2 0 3 258 2 3 4",
                           pcd_mixed_fields));
}

const std::string pcd_mixed_binary = io_test::bytes_of(
    "\1\1\1"
    "\0\0\xc0\x3f"
    "\0\0\xc0\xbf"
    "\0\0\0\0\0\0\0\x40"
    "\1\0\xfe\xff"
    "\xff\xff\xff\xff\xff\xff\xff\xff"
    "\xff\xff\xff\xff\xff\xff\xff\xff"
    "\xc8"
    "\1\1\1"
    "\0\0\xc0\x7f"
    "\0\0\0\x40"
    "\0\0\0\0\0\0\0\0"
    "\3\0\2\1"
    "\2\0\0\0\0\0\0\0"
    "\3\0\0\0\0\0\0\0"
    "\4");

const std::string pcd_mixed_planes = io_test::bytes_of(
    "\1\1\1\1\1\1"
    "\0\0\xc0\x3f\0\0\xc0\x7f"
    "\0\0\xc0\xbf\0\0\0\x40"
    "\0\0\0\0\0\0\0\x40\0\0\0\0\0\0\0\0"
    "\1\0\xfe\xff\3\0\2\1"
    "\xff\xff\xff\xff\xff\xff\xff\xff\2\0\0\0\0\0\0\0"
    "\xff\xff\xff\xff\xff\xff\xff\xff\3\0\0\0\0\0\0\0"
    "\xc8\4");

std::string pcd_compressed() {
    const std::string packed = pcd_pack(pcd_mixed_planes);
    return pcd_mixed + "DATA binary_compressed\n" + pcd_word(packed.size()) +
           pcd_word(pcd_mixed_planes.size()) + packed;
}

TEST(io_read_pcd, reads_binary) {
    expect_mixed(parse_pcd(pcd_mixed + "DATA binary\n" + pcd_mixed_binary, pcd_mixed_fields));
    expect_mixed(
        parse_pcd(pcd_mixed + "DATA binary\r\n" + pcd_mixed_binary + "tail", pcd_mixed_fields));
}

TEST(io_read_pcd, reads_binary_compressed) {
    expect_mixed(parse_pcd(pcd_compressed(), pcd_mixed_fields));
    expect_mixed(parse_pcd(pcd_compressed() + "tail", pcd_mixed_fields));
}

TEST(io_read_pcd, reads_sloppy_headers) {
    const std::string rest = "DATA ascii\n1 2 3\n4 5 6\n";
    for (const std::string header : {
             "FIELDS x y z\nPOINTS 2\n",
             "VERSION .5\nCOLUMNS x y z\nPOINTS 2\n",
             "# made by\n some tool\nVERSION 0.6\nFIELDS x y z\nWIDTH 2\n",
             "\n\nVERSION\nFIELDS x y z\nWIDTH 1\nHEIGHT 2\n# here too\nPOINTS 2\n",
             "FIELDS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nWIDTH 2\r\nHEIGHT 1\r\n",
         }) {
        const gnomon::scan s = parse_pcd(header + rest);
        ASSERT_EQ(s.size(), 2U) << header;
        EXPECT_EQ(s.points[1], Eigen::Vector3d(4, 5, 6));
        EXPECT_TRUE(s.viewpoints.empty());
    }
}

TEST(io_read_pcd, refuses_a_damaged_header) {
    const auto refuse = [](const std::string& header, const std::string& at,
                           const std::string& why) {
        io_test::expect_error(pcd_parser, header + "DATA ascii\n1 2 3\n4 5 6\n", at, why);
    };
    refuse("FIELDS x y\nPOINTS 2\n", "line 3", "no field \"z\"; there are: x, y");
    refuse("FIELDS x y z\nSIZE 4 4\nPOINTS 2\n", "line 4", "missing");
    refuse("FIELDS x y z\nSIZE 4 4 4 4\nPOINTS 2\n", "line 4", "more fields");
    refuse("FIELDS x y z\nSIZE 4 4 3\nPOINTS 2\n", "line 4", "do not go together");
    refuse("FIELDS x y z\nTYPE F F I I\nPOINTS 2\n", "line 4", "more fields");
    refuse("FIELDS x y z\nTYPE F F FF\nPOINTS 2\n", "line 4", "TYPE of \"z\"");
    refuse("FIELDS x y z\nTYPE F F Q\nPOINTS 2\n", "line 4", "do not go together");
    refuse("FIELDS x y z\nSIZE 4 4 20\nTYPE F F E\nPOINTS 2\n", "line 5", "do not go together");
    refuse("FIELDS x y z\nTYPE F F F\nSIZE 4 4 2\nPOINTS 2\n", "line 5", "do not go together");
    refuse("FIELDS x y z\nCOUNT 1 1 0\nPOINTS 2\n", "line 4", "COUNT of \"z\"");
    const std::string most = std::to_string(std::numeric_limits<std::size_t>::max());
    refuse("FIELDS x y z\nCOUNT 1 1 " + most + "\nPOINTS 0\n", "line 4", "COUNT of \"z\"");
    refuse("FIELDS x y z\nWIDTH 2\nHEIGHT 2\nPOINTS 2\n", "line 5", "is not POINTS");
    refuse("FIELDS x y z\nWIDTH 9223372036854775808\nHEIGHT 2\n", "line 4", "impossible");
    refuse("FIELDS x y z\n", "line 2", "neither WIDTH nor POINTS");
    refuse("FIELDS x y z\nPOINTS two\n", "line 2", "\"two\" is not a count");
    refuse("FIELDS x y z\nPOINTZ 2\n", "line 2", "\"POINTZ\" is not a keyword");
    refuse("FIELDS x y z\nVIEWPOINT 0 0\nPOINTS 2\n", "line 4", "missing");
    io_test::expect_error(pcd_parser, "", "line 1", "ends too early");
    io_test::expect_error(pcd_parser, pcd_xyz, "line 10", "ends too early");
    io_test::expect_error(pcd_parser, pcd_xyz + "DATA zip\n", "line 10", "\"zip\" is not known");
    io_test::expect_error([](const auto& file) { return gnomon::io::read_pcd(file, {"_"}); },
                          pcd_mixed + "DATA binary\n" + pcd_mixed_binary, "line 12",
                          "there are: x, y, z, h[0], h[1], a, b, c");
}

TEST(io_read_pcd, refuses_damaged_data) {
    const auto refuse = [](const std::string& data, const std::string& at, const std::string& why) {
        io_test::expect_error(pcd_parser, pcd_xyz + data, at, why);
    };
    const std::string start = std::to_string(pcd_xyz.size() + 23);
    refuse("DATA ascii\n1 2 3\n", "line 10", "bytes are left");
    refuse("DATA ascii\n1 2 3\n      \n", "line 13", "ends too early");
    refuse("DATA ascii\n1 2 3\n4 5\n\n\n", "line 12", "missing");
    refuse("DATA ascii\n1 2 3 4\n4 5 6\n", "line 11", "more values");
    refuse("DATA ascii\n1 2 x\n4 5 6\n", "line 11", "\"x\" is not a number");
    refuse("DATA binary\n12345", "byte " + std::to_string(pcd_xyz.size() + 12), "bytes are left");
    refuse("DATA binary_compressed\n" + pcd_word(7), "byte " + std::to_string(pcd_xyz.size() + 27),
           "ends too early");
    const std::string place = "byte " + std::to_string(pcd_xyz.size() + 31);
    refuse("DATA binary_compressed\n" + pcd_word(7) + pcd_word(6) + "\5abcde", place, "too early");
    refuse("DATA binary_compressed\n" + pcd_word(7) + pcd_word(7) + "\5abcdef", place, "the size");
    refuse("DATA binary_compressed\n" + pcd_word(7) + pcd_word(6) + "\6abcdef", place, "damaged");
    refuse("DATA binary_compressed\n" + pcd_word(6) + pcd_word(6) + "\4abcde", place, "damaged");
    for (const std::string count : {"2000000000", "9223372036854775808"}) {
        const std::string header = "FIELDS x y z\nPOINTS " + count + "\nDATA ";
        io_test::expect_error(pcd_parser, header + "ascii\n1 2 3", "line 3", "bytes are left");
        io_test::expect_error(pcd_parser, header + "binary\n1 2 3",
                              "byte " + std::to_string(header.size() + 7), "bytes are left");
        io_test::expect_error(pcd_parser, header + "binary_compressed\n1234567890",
                              "byte " + std::to_string(header.size() + 26), "the size");
    }
    // As many bytes as 357913941 points have, from a file of three.
    const std::string header = "FIELDS x y z\nPOINTS 357913941\nDATA binary_compressed\n";
    io_test::expect_error(pcd_parser, header + pcd_word(3) + pcd_word(4294967292U) + "\1ab",
                          "byte " + std::to_string(header.size() + 8), "damaged");
}

/// Of a point of color 0xAABBCC with alpha 0xFF, which as a float is a NaN, and one of 0x010203.
void expect_colors(const gnomon::scan& s, bool has_alpha) {
    const std::vector<std::string> names{"w", "red", "green", "blue", "alpha"};
    const std::vector<std::vector<double>> values{
        {9, 7}, {0xAA, 1}, {0xBB, 2}, {0xCC, 3}, {0xFF, 0}};
    ASSERT_EQ(s.fields.size(), has_alpha ? 5u : 4u);
    for (std::size_t k = 0; k < s.fields.size(); ++k) {
        EXPECT_EQ(s.fields[k].name, names[k]);
        EXPECT_EQ(s.fields[k].values, values[k]) << names[k];
        EXPECT_EQ(s.fields[k].type,
                  k == 0 ? gnomon::scan::field_type::uint16 : gnomon::scan::field_type::uint8);
    }
}

TEST(io_read_pcd, unpacks_colors) {
    const std::string first = io_test::bytes_of("\xCC\xBB\xAA\xFF"),
                      second = io_test::bytes_of("\3\2\1\0");
    for (const char* const name : {"rgb", "rgba"}) {
        const bool has_alpha = std::string(name) == "rgba";
        for (const char* const type : {"F", "U", "I"}) {
            const auto parse = [&](const std::string& data) {
                std::string bytes = "FIELDS x " + std::string(name) +
                                    " y z w\nSIZE 1 4 1 1 2\nTYPE I " + type +
                                    " I I U\nPOINTS 2\nDATA " + data;
                return parse_pcd(bytes, {"*"});
            };
            expect_colors(parse("binary\n\1" + first + io_test::bytes_of("\2\3\t\0\1") + second +
                                io_test::bytes_of("\2\3\7\0")),
                          has_alpha);
            const std::string planar =
                "\1\1" + first + second + io_test::bytes_of("\2\2\3\3\t\0\7\0");
            expect_colors(parse("binary_compressed\n" + pcd_word(pcd_pack(planar).size()) +
                                pcd_word(planar.size()) + pcd_pack(planar)),
                          has_alpha);
        }
        // As numbers: 0xFFAABBCC unsigned and signed, 0x010203 as a float with the bits of it.
        const auto parse_text = [&](const std::string& type, const std::string& colors) {
            const std::size_t blank = colors.find(' ');
            return parse_pcd("FIELDS x " + std::string(name) + " y z w\nSIZE 1 4 1 1 2\nTYPE I " +
                                 type + " I I U\nPOINTS 2\nDATA ascii\n1 " +
                                 colors.substr(0, blank) + " 2 3 9\n1 " + colors.substr(blank + 1) +
                                 " 2 3 7\n",
                             {"*"});
        };
        expect_colors(parse_text("U", "4289379276 66051"), has_alpha);
        expect_colors(parse_text("I", "-5588020 66051"), has_alpha);
        const gnomon::scan floats = parse_text("F", "nan 9.2557165e-41");
        EXPECT_EQ(floats.fields[1].values, (std::vector<double>{0, 1}));
        EXPECT_EQ(floats.fields[3].values, (std::vector<double>{0, 3}));
        EXPECT_EQ(parse_text("U", "1e300 -1e300").fields[1].values, (std::vector<double>{0, 0}));
        EXPECT_EQ(parse_text("F", "1e300 -1e300").size(), 2u);
    }
}

TEST(io_read_pcd, gives_all_fields_but_padding_and_coordinates) {
    const gnomon::scan s = parse_pcd(pcd_mixed + "DATA binary\n" + pcd_mixed_binary, {"b", "*"});
    using enum gnomon::scan::field_type;
    const std::vector<std::string> names{"b", "h[0]", "h[1]", "a", "c"};
    const std::vector<gnomon::scan::field_type> types{float64, int16, int16, float64, uint8};
    ASSERT_EQ(s.fields.size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
        EXPECT_EQ(s.fields[k].name, names[k]);
        EXPECT_EQ(s.fields[k].type, types[k]) << names[k];
        EXPECT_EQ(s.fields[k].values.size(), 2u);
    }
    // A field of color that is not four bytes is one like any other.
    const gnomon::scan doubles = parse_pcd(
        "FIELDS x y z rgb\nSIZE 4 4 4 8\nTYPE F F F F\nPOINTS 1\nDATA ascii\n1 2 3 4\n", {"*"});
    ASSERT_EQ(doubles.fields.size(), 1u);
    EXPECT_EQ(doubles.fields[0].name, "rgb");
}

TEST(io_read_pcd, survives_truncation_and_damage) {
    const auto all_fields = [](const gnomon::io::input& file) {
        return gnomon::io::read_pcd(file, {"*"});
    };
    for (const char* const type : {"F", "U"}) {
        const std::string header = std::string("FIELDS x y z rgba\nSIZE 1 1 1 4\nTYPE I I I ") +
                                   type + "\nPOINTS 2\nDATA ";
        io_test::check_mutation(all_fields, header + "ascii\n1 2 3 4e9\n4 5 6 7\n");
        io_test::check_truncation(all_fields, header + "binary\n12345671234567", true);
        io_test::check_mutation(all_fields, header + "binary\n12345671234567");
    }
    io_test::check_mutation(all_fields, pcd_compressed());

    const std::string text = pcd_xyz + "DATA ascii\n1 2 3\n4 5 6\n";
    const std::string binary = pcd_mixed + "DATA binary\n" + pcd_mixed_binary;
    io_test::check_truncation(pcd_parser, text, false);
    io_test::check_truncation(pcd_parser, binary, true);
    io_test::check_truncation(pcd_parser, pcd_compressed(), true);
    io_test::check_mutation(pcd_parser, text);
    io_test::check_mutation(pcd_parser, binary);
    io_test::check_mutation(pcd_parser, pcd_compressed());
}

std::optional<std::string> unpacked(std::string_view packed, std::size_t size) {
    return gnomon::io::detail::unpack_lzf(packed, size);
}

TEST(io_lzf, unpacks_runs_and_repetitions) {
    EXPECT_EQ(unpacked("", 0), "");
    EXPECT_EQ(unpacked(std::string_view("\0a", 2), 1), "a");
    EXPECT_EQ(unpacked("\4hello", 5), "hello");
    // "abc", then 4 bytes from distance 3, then 3 from distance 1: source and destination overlap.
    EXPECT_EQ(unpacked(std::string_view("\2abc\x40\2\x20\0", 8), 10), "abcabcaaaa");
    // A long back reference: 7 + 2 + 91 bytes.
    EXPECT_EQ(unpacked(std::string_view("\0x\xe0\x5b\0", 5), 101), std::string(101, 'x'));
    // The largest distance, 8192 bytes.
    const std::string far_ = "\xff\xff" + std::string(8190, '-');
    std::string packed = pcd_pack(far_);
    packed += "\x3f\xff";
    EXPECT_EQ(unpacked(packed, 8195), far_ + "\xff\xff-");
}

TEST(io_lzf, refuses_whatever_reaches_beyond_either_side) {
    EXPECT_EQ(unpacked("\5hello", 6), std::nullopt);  // run beyond input
    EXPECT_EQ(unpacked("\4hello", 4), std::nullopt);  // run beyond output
    EXPECT_EQ(unpacked("\4hello", 6), std::nullopt);  // too little
    EXPECT_EQ(unpacked("\x20", 3), std::nullopt);     // no distance
    EXPECT_EQ(unpacked(std::string_view("\0x\xe0\x5b", 4), 101), std::nullopt);  // no distance
    EXPECT_EQ(unpacked(std::string_view("\0x\x20\1", 4), 4), std::nullopt);  // before the output
    EXPECT_EQ(unpacked(std::string_view("\0x\x20\0", 4), 3), std::nullopt);  // beyond the output
    EXPECT_EQ(unpacked("\4hello", 4294967295U), std::nullopt);               // impossible ratio
}

}  // namespace

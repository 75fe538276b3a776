// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/input.hpp>
#include <gnomon/io/read_ply.hpp>
#include <gnomon/io/write_ply.hpp>

namespace {

namespace io = gnomon::io;
using io::field_type;
using io::ply_format;

constexpr std::array all_formats = {ply_format::ascii, ply_format::binary_little_endian,
                                    ply_format::binary_big_endian};

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// UTM coordinates, the smallest and the largest double, and a NaN point.
const std::vector<Eigen::Vector3d> awkward_points = {
    {691234.1234567891, 5335678.987654321, 515.0000000001},
    {5e-324, -1.7976931348623157e308, 0.1},
    {not_a_number, -not_a_number, std::numeric_limits<double>::infinity()}};

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

gnomon::scan written_and_read(const std::string& path,
                              const std::vector<std::string>& fields = {}) {
    return io::read_ply(io::load(path), fields);
}

TEST(io_write_ply, keeps_doubles_exactly_in_every_format) {
    const std::string path = io_test::scratch_path("a.ply");
    for (const ply_format format : all_formats) {
        io::write_ply(path, awkward_points, {}, {.format = format});
        const gnomon::scan s = written_and_read(path);
        ASSERT_EQ(s.size(), awkward_points.size());
        for (std::size_t i = 0; i < s.size(); ++i)
            for (const int k : {0, 1, 2})
                EXPECT_TRUE(same(s.points[i][k], awkward_points[i][k])) << i << " " << k;
        EXPECT_TRUE(s.viewpoints.empty());
    }
}

TEST(io_write_ply, keeps_every_type_exactly_in_every_format) {
    const std::string path = io_test::scratch_path("a.ply");
    const std::vector<Eigen::Vector3f> points = {{1.1F, 2, 3}, {4, 5, 6}};
    const std::vector<std::int8_t> a = {-128, 127};
    const std::vector<std::uint8_t> b = {0, 255};
    const std::vector<std::int16_t> c = {-32768, 32767};
    const std::vector<std::uint16_t> d = {0, 65535};
    const std::vector<std::int32_t> e = {-2147483647 - 1, 2147483647};
    const std::vector<std::uint32_t> f = {0, 4294967295U};
    const std::vector<float> g = {0.1F, std::numeric_limits<float>::quiet_NaN()};
    const std::vector<double> h = {0.1, -1e-300};
    const io::properties all = {io::scalar_property("a", a), io::scalar_property("b", b),
                                io::scalar_property("c", c), io::scalar_property("d", d),
                                io::scalar_property("e", e), io::scalar_property("f", f),
                                io::scalar_property("g", g), io::scalar_property("h", h)};
    for (const ply_format format : all_formats) {
        io::write_ply(path, points, all, {.format = format, .coordinates = field_type::float32});
        const gnomon::scan s = written_and_read(path, {"a", "b", "c", "d", "e", "f", "g", "h"});
        ASSERT_EQ(s.size(), 2U);
        EXPECT_EQ(static_cast<float>(s.points[0].x()), 1.1F);
        for (const io::property& column : all) {
            const auto& values = s.fields[static_cast<std::size_t>(column.name[0] - 'a')].values;
            for (const std::size_t i : {0U, 1U}) {
                const double expected = column.value(i);
                // The shortest text of a float differs from that of the equal double.
                if (column.type == field_type::float32)
                    EXPECT_TRUE(same(static_cast<float>(values[i]), static_cast<float>(expected)));
                else
                    EXPECT_EQ(values[i], expected) << column.name;
            }
        }
    }
}

TEST(io_write_ply, writes_this_text) {
    const std::string path = io_test::scratch_path("a.ply");
    gnomon::scan s;
    s.points = {{0.1, -2, 3e10}, {-not_a_number, 0, 1}};
    s.viewpoints = Eigen::Vector3d(1, 0.5, -1e-7);
    const std::vector<std::array<std::uint8_t, 3>> colors = {{1, 2, 3}, {255, 0, 7}};
    const std::vector<Eigen::Vector3d> normals = {{0, 0, 1}, {0.1, 0, 0}};
    io::write_ply(path, s, {io::normal_properties(normals), io::color_properties(colors)},
                  {.format = ply_format::ascii});
    EXPECT_EQ(io::load(path).bytes,
              "ply\nformat ascii 1.0\ncomment viewpoint 1 0.5 -1e-07\nelement vertex 2\n"
              "property double x\nproperty double y\nproperty double z\n"
              "property float nx\nproperty float ny\nproperty float nz\n"
              "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
              "0.1 -2 3e+10 0 0 1 1 2 3\nnan 0 1 0.1 0 0 255 0 7\n");
    EXPECT_EQ(written_and_read(path).viewpoints[0], s.viewpoints[0]);
}

TEST(io_write_ply, keeps_a_single_view_point) {
    const std::string path = io_test::scratch_path("a.ply");
    const Eigen::Vector3d here(691234.1234567891, 1.0 / 3.0, -1e-9);
    io::write_ply(path, gnomon::with_viewpoint(awkward_points, here));
    EXPECT_EQ(written_and_read(path).viewpoints[0], here);
}

/// Points of a moving sensor keep their viewpoints.
TEST(io_write_ply, keeps_many_view_points) {
    gnomon::scan s;
    s.points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    const std::vector<Eigen::Vector3d> seen_from{{0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 1e-20}};
    s.viewpoints = gnomon::viewpoint_table(seen_from);
    const std::string path = io_test::scratch_path("a.ply");
    for (const auto format : {io::ply_format::ascii, io::ply_format::binary_little_endian}) {
        io::write_ply(path, s, {}, {.format = format});
        const auto again = io::read_ply(io::load(path));
        ASSERT_TRUE(again.viewpoints.covers(3));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(again.viewpoints[i], seen_from[i]);
    }
}

struct foreign_hit {
    double range;
    std::array<float, 3> where;
};

TEST(io_write_ply, takes_foreign_points_by_projection_and_many_of_them) {
    const std::string path = io_test::scratch_path("a.ply");
    std::vector<foreign_hit> hits(20000);
    for (std::size_t i = 0; i < hits.size(); ++i)
        hits[i] = {static_cast<double>(i), {static_cast<float>(i), 1, 2}};
    io::write_ply(path, hits, io::scalar_property("range", hits, &foreign_hit::range), {},
                  &foreign_hit::where);
    const gnomon::scan s = written_and_read(path, {"range"});
    ASSERT_EQ(s.size(), hits.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        EXPECT_EQ(s.points[i].x(), static_cast<double>(i));
        EXPECT_EQ(s.fields[0].values[i], static_cast<double>(i));
    }
    io::write_ply(path, std::vector<Eigen::Vector3d>{});
    EXPECT_EQ(written_and_read(path).size(), 0U);
}

TEST(io_write_ply, refuses_impossible_arguments_and_leaves_nothing) {
    const std::string path = io_test::scratch_path("a.ply");
    std::remove(path.c_str());
    const auto refuse = [&](const io::properties& columns, io::ply_options options = {}) {
        EXPECT_THROW(io::write_ply(path, awkward_points, columns, options), std::invalid_argument);
        EXPECT_FALSE(io_test::exists(path));
        EXPECT_FALSE(io_test::exists(path + ".part0"));
    };
    const auto constant = [](double value) { return [value](std::size_t) { return value; }; };
    const std::vector<int> four(4);
    refuse(io::scalar_property("other_size", four));
    refuse({}, {.coordinates = field_type::int32});
    refuse(io::property{"x", field_type::float64, 3, constant(0)});
    const io::property once{"twice", field_type::float64, 3, constant(0)};
    refuse({once, once});
    refuse(io::property{"", field_type::float64, 3, constant(0)});
    refuse(io::property{"two words", field_type::float64, 3, constant(0)});
    for (const double value : {256.0, -1.0, 0.5, not_a_number, 1e300})
        refuse(io::property{"byte", field_type::uint8, 3, constant(value)});
    for (const double value : {4e38, -1e300})  // which would read back as infinities
        refuse(io::property{"float", field_type::float32, 3, constant(value)});
}

TEST(io_write_ply, refuses_a_missing_directory) {
    const std::string path = io_test::scratch_path("no") + "/such/a.ply";
    EXPECT_THROW(io::write_ply(path, awkward_points), gnomon::error);
}

TEST(io_write_ply, leaves_the_older_file_when_a_value_cannot_be_had) {
    const std::string path = io_test::scratch_file("a.ply", "older");
    const auto fail = [](std::size_t) -> double { throw std::runtime_error("of the user's"); };
    const io::property column{"v", field_type::float64, 3, fail};
    EXPECT_THROW(io::write_ply(path, awkward_points, column), std::runtime_error);
    EXPECT_EQ(io::load(path).bytes, "older");
    EXPECT_FALSE(io_test::exists(path + ".part0"));
}

TEST(io_write_ply, reader_survives_truncation_and_damage) {
    const auto parser = [](const io::input& file) { return io::read_ply(file, {"v"}); };
    const std::string path = io_test::scratch_path("a.ply");
    const std::vector<std::int16_t> values = {1, 2, 3};
    for (const ply_format format : all_formats) {
        io::write_ply(path, awkward_points, io::scalar_property("v", values), {.format = format});
        const std::string bytes = io::load(path).bytes;
        io_test::check_truncation(parser, bytes, format != ply_format::ascii);
        io_test::check_mutation(parser, bytes, 1000);
    }
}

/// A file that write_ply could have written, of a property of each type with random bytes.
std::string file_of_random_bytes(ply_format format, std::size_t points) {
    std::string text = "ply\nformat ";
    text += io::detail::ply_format_names[static_cast<std::size_t>(format)];
    text += " 1.0\nelement vertex " + std::to_string(points) + "\n";
    for (const char* const axis : {"x", "y", "z"})
        text += std::string("property double ") + axis + "\n";
    std::size_t size = 24;
    for (const auto& type : io::detail::ply_types) {
        text += "property " + std::string(type.name) + " of_" + std::string(type.name) + "\n";
        size += type.layout.size;
    }
    text += "end_header\n";
    gnomon::random_stream random(5);
    for (std::size_t i = 0; i < size * points; ++i) text += static_cast<char>(random.below(256));
    return text;
}

TEST(io_write_ply, writes_fields_as_they_were_read_bit_for_bit) {
    for (const ply_format format :
         {ply_format::binary_little_endian, ply_format::binary_big_endian}) {
        std::string bytes = file_of_random_bytes(format, 3000);
        // Signaling NaNs become quiet ones: a second turn changes nothing any more.
        std::size_t differences = 0;
        for (int turn = 0; turn < 2; ++turn) {
            const gnomon::scan s = io::read_ply({"some.file", bytes}, {"*"});
            ASSERT_EQ(s.fields.size(), 8u);
            const std::string path = io_test::scratch_path("copy.ply");
            io::write_ply(path, s, io::field_properties(s), {.format = format});
            const std::string copy = io::load(path).bytes;
            ASSERT_EQ(copy.size(), bytes.size());
            differences = 0;
            for (std::size_t k = 0; k < copy.size(); ++k)
                differences += copy[k] != bytes[k] ? 1 : 0;
            EXPECT_LT(differences,
                      30u);  // of 12,000 numbers 1 in 256 is a NaN, half of them signaling
            bytes = copy;
        }
        EXPECT_EQ(differences, 0u);
    }
}

TEST(io_write_ply, writes_fields_as_text_that_reads_the_same) {
    const std::string bytes = file_of_random_bytes(ply_format::binary_little_endian, 500);
    const gnomon::scan s = io::read_ply({"some.file", bytes}, {"*"});
    const std::string path = io_test::scratch_path("copy.ply");
    io::write_ply(path, s, io::field_properties(s), {.format = ply_format::ascii});
    const gnomon::scan copy = written_and_read(path, {"*"});
    ASSERT_EQ(copy.fields.size(), s.fields.size());
    for (std::size_t k = 0; k < s.fields.size(); ++k) {
        EXPECT_EQ(copy.fields[k].name, s.fields[k].name);
        EXPECT_EQ(copy.fields[k].type, s.fields[k].type);
        // The digits of a float determine it, and not the double that is read of them.
        const bool is_float = s.fields[k].type == field_type::float32;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double value = copy.fields[k].values[i];
            const double rounded = is_float ? static_cast<float>(value) : value;
            EXPECT_TRUE(same(rounded, s.fields[k].values[i]));
        }
    }
}

}  // namespace

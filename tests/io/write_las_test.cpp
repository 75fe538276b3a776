// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
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
#include "las_test_support.hpp"
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/input.hpp>
#include <gnomon/io/read_las.hpp>
#include <gnomon/io/write_las.hpp>

namespace {

namespace io = gnomon::io;
using io::field_type;

constexpr double las_nan = std::numeric_limits<double>::quiet_NaN();

/// Points of a scan in a box about `center`.
gnomon::scan las_cloud(std::size_t points, const Eigen::Vector3d& center, double half_extent) {
    gnomon::random_stream random(7);
    gnomon::scan s;
    for (std::size_t i = 0; i < points; ++i)
        s.points.emplace_back(center + half_extent * Eigen::Vector3d(2 * random.uniform() - 1,
                                                                     2 * random.uniform() - 1,
                                                                     2 * random.uniform() - 1));
    return s;
}

gnomon::scan las_again(const std::string& path, const std::vector<std::string>& fields = {"*"}) {
    return io::read_las(io::load(path), fields);
}

/// The number of a type at a byte of a file.
template <class T>
T number_at(const std::string& bytes, std::size_t at) {
    T value{};
    std::copy_n(bytes.data() + at, sizeof value, reinterpret_cast<char*>(&value));
    return value;
}

const std::vector<double>& las_field(const gnomon::scan& s, const std::string& name) {
    for (const auto& field : s.fields)
        if (field.name == name) return field.values;
    throw std::runtime_error("no field " + name);
}

/// Coordinates are off by at most half the resolution, at any place and extent.
TEST(io_write_las, rounds_coordinates_to_the_resolution) {
    const std::string path = io_test::scratch_path("a.las");
    for (const double resolution : {1e-4, 1e-3, 0.25}) {
        for (const double half : {0.0, 1.0, 5000.0}) {
            for (const Eigen::Vector3d& center :
                 {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(691234.1, 5335678.9, 515),
                  Eigen::Vector3d(-1e7, 3, -0.4)}) {
                const gnomon::scan s = las_cloud(100, center, half);
                io::write_las(path, s, {}, {.resolution = resolution});
                const gnomon::scan again = las_again(path);
                ASSERT_EQ(again.size(), s.size());
                for (std::size_t i = 0; i < s.size(); ++i)
                    EXPECT_LE((again.points[i] - s.points[i]).cwiseAbs().maxCoeff(),
                              0.5 * resolution + 4e-9);  // and the rounding of UTM in double
            }
        }
    }
}

/// 0.1 mm over 10,000 km does not fit 32 bits, 10 mm does.
TEST(io_write_las, coarsens_the_resolution_for_wide_scans) {
    const std::string path = io_test::scratch_path("a.las");
    const gnomon::scan s = las_cloud(100, {0, 0, 0}, 5e6);
    io::write_las(path, s);
    const gnomon::scan again = las_again(path);
    double off = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
        off = std::max(off, (again.points[i] - s.points[i]).cwiseAbs().maxCoeff());
    EXPECT_LE(off, 0.0051);
    EXPECT_GT(off, 0.0005);
}

/// The header, byte by byte as in the specification (LAS 1.4 R15, table 3).
TEST(io_write_las, writes_this_header) {
    const std::string path = io_test::scratch_path("a.las");
    const std::vector<Eigen::Vector3d> points = {{1, 2, 3}, {3, 2, 1.5}};
    const std::vector<std::uint8_t> returns = {1, 3};
    const std::vector<std::int32_t> labels = {-1, 70000};
    io::write_las(
        path, points,
        {io::scalar_property("return_number", returns), io::scalar_property("label", labels)},
        {.resolution = 0.5});
    const std::string b = io::load(path).bytes;
    EXPECT_EQ(b.substr(0, 4), "LASF");
    EXPECT_EQ(number_at<std::uint16_t>(b, 6), 16U);  // well-known text
    EXPECT_EQ(b[24], 1);
    EXPECT_EQ(b[25], 4);
    EXPECT_EQ(b.substr(26, 6), std::string("OTHER\0", 6));
    EXPECT_EQ(b.substr(58, 7), std::string("gnomon\0", 7));
    EXPECT_EQ(number_at<std::uint16_t>(b, 94), 375U);
    EXPECT_EQ(number_at<std::uint32_t>(b, 96), 375U + 54U + 192U);
    EXPECT_EQ(number_at<std::uint32_t>(b, 100), 1U);
    EXPECT_EQ(b[104], 6);
    EXPECT_EQ(number_at<std::uint16_t>(b, 105), 34U);
    for (std::size_t at = 107; at < 131; ++at) EXPECT_EQ(b[at], 0) << at;  // old counts
    const double expected[] = {0.5, 0.5, 0.5, 2, 2, 2, 3, 1, 2, 2, 3, 1.5};
    for (std::size_t k = 0; k < 12; ++k)
        EXPECT_EQ(number_at<double>(b, 131 + 8 * k), expected[k]) << k;
    EXPECT_EQ(number_at<std::uint64_t>(b, 227), 0U);
    EXPECT_EQ(number_at<std::uint64_t>(b, 235), 0U);
    EXPECT_EQ(number_at<std::uint32_t>(b, 243), 0U);
    EXPECT_EQ(number_at<std::uint64_t>(b, 247), 2U);
    for (std::size_t k = 0; k < 15; ++k)
        EXPECT_EQ(number_at<std::uint64_t>(b, 255 + 8 * k), k == 0 || k == 2 ? 1U : 0U) << k;
    // The record of extra bytes, and the second point.
    EXPECT_EQ(b.substr(377, 10), std::string("LASF_Spec\0", 10));
    EXPECT_EQ(number_at<std::uint16_t>(b, 393), 4U);
    EXPECT_EQ(number_at<std::uint16_t>(b, 395), 192U);
    EXPECT_EQ(b[431], 6);  // int32
    EXPECT_EQ(b.substr(433, 6), std::string("label\0", 6));
    ASSERT_EQ(b.size(), 621U + 2 * 34U);
    EXPECT_EQ(number_at<std::int32_t>(b, 655), 2);
    EXPECT_EQ(number_at<std::int32_t>(b, 659), 0);
    EXPECT_EQ(number_at<std::int32_t>(b, 663), -1);
    EXPECT_EQ(b[669], 0x13);
    EXPECT_EQ(number_at<std::int32_t>(b, 685), 70000);
}

/// Properties of every type and attributes of every kind come back by their names.
TEST(io_write_las, keeps_properties_by_name) {
    const std::string path = io_test::scratch_path("a.las");
    const gnomon::scan s = las_cloud(500, {4e5, 5e6, 300}, 50);
    gnomon::random_stream random(3);
    std::vector<io::property> columns;
    std::vector<std::vector<double>> values;
    const auto add = [&](const std::string& name, field_type type, double low, double high,
                         bool whole = true) {
        values.emplace_back();
        for (std::size_t i = 0; i < s.size(); ++i) {
            const double v = low + (high - low) * random.uniform();
            values.back().push_back(whole ? std::round(v) : v);
        }
        columns.push_back({name, type, s.size(), [&values, k = values.size() - 1](std::size_t i) {
                               return values[k][i];
                           }});
    };
    add("intensity", field_type::uint16, 0, 65535);
    add("return_number", field_type::uint8, 1, 15);
    add("number_of_returns", field_type::float64, 1, 15);
    add("scan_direction_flag", field_type::uint8, 0, 1);
    add("edge_of_flight_line", field_type::uint8, 0, 1);
    add("classification", field_type::int32, 0, 255);
    add("synthetic", field_type::uint8, 0, 1);
    add("key_point", field_type::uint8, 0, 1);
    add("withheld", field_type::uint8, 0, 1);
    add("overlap", field_type::uint8, 0, 1);
    add("scanner_channel", field_type::uint8, 0, 3);
    add("user_data", field_type::uint8, 0, 255);
    add("point_source_id", field_type::uint16, 0, 65535);
    add("gps_time", field_type::float64, -1e9, 1e9, false);
    add("red", field_type::uint16, 0, 65535);
    add("green", field_type::uint16, 0, 65535);
    add("blue", field_type::uint16, 0, 65535);
    add("nir", field_type::uint16, 0, 65535);
    add("int8", field_type::int8, -128, 127);
    add("uint8", field_type::uint8, 0, 255);
    add("int16", field_type::int16, -32768, 32767);
    add("uint16", field_type::uint16, 0, 65535);
    add("label", field_type::int32, -2147483648.0, 2147483647);
    add("uint32", field_type::uint32, 0, 4294967295);
    add("float64", field_type::float64, -1e300, 1e300, false);
    io::write_las(path, s, io::properties(columns));
    const gnomon::scan again = las_again(path);
    EXPECT_EQ(io::load(path).bytes[104], 8);
    for (std::size_t k = 0; k < columns.size(); ++k)
        EXPECT_EQ(las_field(again, columns[k].name), values[k]) << columns[k].name;
    for (const auto& field : again.fields)
        if (field.name == "label") {
            EXPECT_EQ(field.type, field_type::int32);
        }
}

TEST(io_write_las, widens_colors_and_rounds_angles) {
    const std::string path = io_test::scratch_path("a.las");
    const std::vector<Eigen::Vector3d> points = {{1, 2, 3}, {4, 5, 6}};
    const std::vector<std::array<std::uint8_t, 3>> colors = {{0, 128, 255}, {1, 2, 3}};
    const std::vector<double> angles = {-17, 30.0001};
    io::write_las(path, points,
                  {io::color_properties(colors), io::scalar_property("scan_angle", angles)});
    EXPECT_EQ(io::load(path).bytes[104], 7);
    const gnomon::scan again = las_again(path);
    EXPECT_EQ(las_field(again, "green"), (std::vector<double>{257 * 128, 514}));
    EXPECT_EQ(las_field(again, "blue"), (std::vector<double>{65535, 771}));
    for (const std::size_t i : {0U, 1U})
        EXPECT_NEAR(las_field(again, "scan_angle")[i], angles[i], 0.003 + 1e-12);
    EXPECT_EQ(las_field(again, "return_number"), (std::vector<double>{1, 1}));
    EXPECT_EQ(las_field(again, "number_of_returns"), (std::vector<double>{1, 1}));
}

TEST(io_write_las, keeps_view_points) {
    const std::string path = io_test::scratch_path("a.las");
    gnomon::scan s = las_cloud(3, {0, 0, 0}, 1);
    const Eigen::Vector3d here(691234.1234567891, 1.0 / 3.0, -1e-9);
    s.viewpoints = here;
    io::write_las(path, s);
    EXPECT_EQ(las_again(path).viewpoints.positions(), std::vector<Eigen::Vector3d>{here});
    const std::vector<Eigen::Vector3d> moving{{0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 1e-20}};
    s.viewpoints = gnomon::viewpoint_table(moving);
    io::write_las(path, s);
    for (const std::vector<std::string>& fields : {std::vector<std::string>{}, {"*"}}) {
        const gnomon::scan again = las_again(path, fields);
        ASSERT_TRUE(again.viewpoints.covers(3));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(again.viewpoints[i], moving[i]);
    }
}

TEST(io_write_las, refuses_missing_points_or_drops_them_with_their_properties) {
    const std::string path = io_test::scratch_path("a.las");
    std::remove(path.c_str());
    const std::vector<Eigen::Vector3d> points = {
        {las_nan, 0, 0}, {1, 2, 3}, {0, std::numeric_limits<double>::infinity(), 0}, {4, 5, 6}};
    const std::vector<std::int32_t> labels = {0, 1, 2, 3};
    const io::properties label = io::scalar_property("label", labels);
    EXPECT_THROW(io::write_las(path, points, label), std::invalid_argument);
    EXPECT_FALSE(io_test::exists(path));
    io::write_las(path, points, label, {.drop_missing = true});
    const gnomon::scan again = las_again(path, {"label"});
    EXPECT_EQ(again.points, (std::vector<Eigen::Vector3d>{points[1], points[3]}));
    EXPECT_EQ(again.fields[0].values, (std::vector<double>{1, 3}));
    const std::vector<Eigen::Vector3d> nothing(2, Eigen::Vector3d::Constant(las_nan));
    io::write_las(path, nothing, {}, {.drop_missing = true});
    EXPECT_EQ(las_again(path).size(), 0U);
}

/// A file read and written again with itself as source has the same coordinates, attributes,
/// reference system and kind of time.
TEST(io_write_las, copies_the_frame_of_a_source) {
    const std::string path = io_test::scratch_path("a.las");
    gnomon::random_stream random(9);
    for (const bool as_text : {true, false}) {
        io_test::las_file file{.minor = 4, .format = 6, .scale = {0.01, 1e-7, 0.3}};
        for (int i = 0; i < 200; ++i) {
            io_test::las_point p;
            p.x = static_cast<std::int32_t>(random.bits() >> 2U);
            p.y = static_cast<std::int32_t>(random.bits());
            p.z = static_cast<std::int32_t>(random.bits());
            if (std::abs(static_cast<double>(p.x)) > 2e9 ||
                std::abs(static_cast<double>(p.y)) > 2e9 ||
                std::abs(static_cast<double>(p.z)) > 2e9)
                continue;
            p.classification = static_cast<unsigned>(i);
            file.points.push_back(p);
        }
        file.records = {
            io_test::las_record_bytes("LASF_Projection", as_text ? 2112 : 34735, "A CRS"),
            io_test::las_record_bytes("someone", 1, "else")};
        std::string bytes = las_bytes(file);
        bytes[6] = as_text ? 17 : 1;
        const io::input source{"some.las", bytes};
        const gnomon::scan s = io::read_las(source, {"*"});
        io::write_las(path, s, io::field_properties(s), {.source = &source});
        const gnomon::scan again = las_again(path);
        EXPECT_EQ(again.points, s.points);
        EXPECT_EQ(las_field(again, "classification"), las_field(s, "classification"));
        const std::string copy = io::load(path).bytes;
        EXPECT_EQ(copy[6], bytes[6]);
        EXPECT_NE(copy.find("A CRS"), std::string::npos);
        EXPECT_EQ(copy.find("else"), std::string::npos);
        // Points that its scale cannot hold are rounded to the resolution.
        const std::vector<Eigen::Vector3d> far_away = {{1e9, 0, 0}};
        io::write_las(path, far_away, {}, {.source = &source});
        EXPECT_EQ(las_again(path).points, far_away);
    }
    const io::input other{"some.ply", "ply\n"};
    EXPECT_THROW(io::write_las(path, las_cloud(1, {0, 0, 0}, 1), {}, {.source = &other}),
                 gnomon::error);
}

TEST(io_write_las, names_the_value_that_does_not_fit) {
    const std::vector<float> shares{0.375f, 1.0f, 0.0f};
    try {
        io::write_las(io_test::scratch_path("a.las"), las_cloud(3, {0, 0, 0}, 1),
                      io::scalar_property("intensity", shares));
        FAIL();
    } catch (const std::invalid_argument& e) {
        EXPECT_STREQ(e.what(),
                     "properties: 0.375 does not fit its property, which holds whole "
                     "numbers from 0 to 65535");
    }
}

TEST(io_write_las, refuses_impossible_arguments_and_leaves_nothing) {
    const std::string path = io_test::scratch_path("a.las");
    std::remove(path.c_str());
    const gnomon::scan s = las_cloud(3, {0, 0, 0}, 1);
    const auto refuse = [&](const io::properties& columns, io::las_options options = {}) {
        EXPECT_THROW(io::write_las(path, s, columns, options), std::invalid_argument);
        EXPECT_FALSE(io_test::exists(path));
        EXPECT_FALSE(io_test::exists(path + ".part0"));
    };
    const auto column = [](const std::string& name, field_type type, double value) {
        return io::property{name, type, 3, [value](std::size_t) { return value; }};
    };
    for (const double resolution : {0.0, -1.0, las_nan, std::numeric_limits<double>::infinity()})
        refuse({}, {.resolution = resolution});
    const std::vector<int> four(4);
    refuse(io::scalar_property("other_size", four));
    refuse(column("x", field_type::float64, 0));
    refuse({column("twice", field_type::int8, 0), column("twice", field_type::int8, 0)});
    refuse(column(std::string(33, 'a'), field_type::int8, 0));
    for (const double value : {-1.0, 256.0, 0.5, las_nan})
        refuse(column("classification", field_type::float64, value));
    refuse(column("return_number", field_type::float64, 16));
    refuse(column("scan_angle", field_type::float64, 197));
    refuse(column("label", field_type::int32, 3e9));
    std::vector<io::property> many;
    for (int k = 0; k < 342; ++k) many.push_back(column(std::to_string(k), field_type::int8, 0));
    refuse(io::properties(many));
}

TEST(io_write_las, leaves_the_older_file_when_a_value_cannot_be_had) {
    const std::string path = io_test::scratch_file("a.las", "older");
    const auto fail = [](std::size_t) -> double { throw std::runtime_error("of the user's"); };
    EXPECT_THROW(io::write_las(path, las_cloud(3, {0, 0, 0}, 1),
                               io::property{"v", field_type::float64, 3, fail}),
                 std::runtime_error);
    EXPECT_EQ(io::load(path).bytes, "older");
    EXPECT_FALSE(io_test::exists(path + ".part0"));
}

struct las_hit {
    double range;
    std::array<float, 3> where;
};

TEST(io_write_las, takes_foreign_points_by_projection_and_many_of_them) {
    const std::string path = io_test::scratch_path("a.las");
    std::vector<las_hit> hits(20000);
    for (std::size_t i = 0; i < hits.size(); ++i)
        hits[i] = {static_cast<double>(i), {static_cast<float>(i), 1, 2}};
    io::write_las(path, hits, io::scalar_property("range", hits, &las_hit::range), {},
                  &las_hit::where);
    const gnomon::scan again = las_again(path, {"range"});
    ASSERT_EQ(again.size(), hits.size());
    for (std::size_t i = 0; i < again.size(); ++i) {
        EXPECT_NEAR(again.points[i].x(), static_cast<double>(i), 1e-9);
        EXPECT_EQ(again.fields[0].values[i], static_cast<double>(i));
    }
}

TEST(io_write_las, reader_survives_truncation_and_damage) {
    const std::string path = io_test::scratch_path("a.las");
    gnomon::scan s = las_cloud(3, {0, 0, 0}, 1);
    s.viewpoints = Eigen::Vector3d(1, 2, 3);
    const std::vector<std::int32_t> labels = {1, 2, 3};
    io::write_las(path, s, io::scalar_property("label", labels));
    const std::string bytes = io::load(path).bytes;
    const auto parser = [](const io::input& file) { return io::read_las(file, {"*"}); };
    io_test::check_truncation(parser, bytes, true);
    io_test::check_mutation(parser, bytes, 1000);
}

}  // namespace

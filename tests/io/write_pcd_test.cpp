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
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/input.hpp>
#include <gnomon/io/read_pcd.hpp>
#include <gnomon/io/write_pcd.hpp>

namespace {

namespace io = gnomon::io;
using io::field_type;

constexpr double pcd_nan = std::numeric_limits<double>::quiet_NaN();

gnomon::scan pcd_again(const std::string& path, const std::vector<std::string>& fields = {"*"}) {
    return io::read_pcd(io::load(path), fields);
}

TEST(io_write_pcd, writes_this_text) {
    const std::string path = io_test::scratch_path("a.pcd");
    gnomon::scan s;
    s.points = {{0.1, -2, 3}, {-pcd_nan, 0, 1}};
    s.viewpoints = Eigen::Vector3d(1, 0.5, -1e-7);
    const std::vector<std::array<std::uint8_t, 3>> colors = {{1, 2, 3}, {255, 0, 7}};
    const std::vector<Eigen::Vector3d> normals = {{0, 0, 1}, {0.1, 0, 0}};
    const std::vector<std::int32_t> labels = {-1, 12};
    io::write_pcd(path, s,
                  {io::normal_properties(normals), io::color_properties(colors),
                   io::scalar_property("label", labels)},
                  {.ascii = true});
    EXPECT_EQ(io::load(path).bytes,
              "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
              "FIELDS x y z normal_x normal_y normal_z label rgb\nSIZE 4 4 4 4 4 4 4 4\n"
              "TYPE F F F F F F U U\nCOUNT 1 1 1 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
              "VIEWPOINT 1 0.5 -1e-07 1 0 0 0\nPOINTS 2\nDATA ascii\n"
              "0.1 -2 3 0 0 1 4294967295 66051\nnan 0 1 0.1 0 0 12 16711687\n");
}

/// Everything that is written is read again, in text and in binary data.
TEST(io_write_pcd, keeps_what_it_writes) {
    const std::string path = io_test::scratch_path("a.pcd");
    gnomon::random_stream random(5);
    gnomon::scan s;
    std::vector<std::array<std::uint8_t, 3>> colors;
    std::vector<std::int32_t> labels;
    std::vector<double> times;
    std::vector<float> curvatures;
    for (int i = 0; i < 600; ++i) {
        s.points.emplace_back(691234 + random.uniform(), 5335678 + random.uniform(), pcd_nan);
        colors.push_back({static_cast<std::uint8_t>(random.bits()), 255,
                          static_cast<std::uint8_t>(random.bits())});
        labels.push_back(static_cast<std::int32_t>(random.bits()));
        times.push_back(1e9 * random.uniform());
        curvatures.push_back(static_cast<float>(random.uniform()));
    }
    s.width = 20;
    s.viewpoints = Eigen::Vector3d(691000.125, 5e6, 1.0 / 3.0);
    const io::properties all{io::color_properties(colors), io::scalar_property("label", labels),
                             io::scalar_property("time", times),
                             io::scalar_property("curvature", curvatures)};
    for (const bool ascii : {false, true}) {
        io::write_pcd(path, s, all, {.ascii = ascii, .coordinates = field_type::float64});
        const gnomon::scan again = pcd_again(path);
        ASSERT_EQ(again.size(), s.size());
        EXPECT_EQ(again.width, 20U);
        EXPECT_EQ(again.viewpoints[0], s.viewpoints[0]);
        for (std::size_t i = 0; i < s.size(); ++i) {
            EXPECT_EQ(again.points[i].head<2>(), s.points[i].head<2>());
            EXPECT_TRUE(std::isnan(again.points[i].z()));
        }
        ASSERT_EQ(again.fields.size(), 6U);
        for (const gnomon::scan::scalar_field& field : again.fields) {
            for (const io::property& column : all) {
                if (column.name != field.name) continue;
                const bool is_label = field.name == "label";  // unsigned in the file
                EXPECT_EQ(field.type, is_label ? field_type::uint32 : column.type);
                for (std::size_t i = 0; i < s.size(); ++i) {
                    if (column.type == field_type::float32)  // the shortest text
                        ASSERT_EQ(static_cast<float>(field.values[i]), curvatures[i]);
                    else if (is_label)
                        ASSERT_EQ(field.values[i], static_cast<std::uint32_t>(labels[i]));
                    else
                        ASSERT_EQ(field.values[i], column.value(i)) << field.name;
                }
            }
        }
    }
}

TEST(io_write_pcd, keeps_many_view_points) {
    gnomon::scan s;
    s.points = {{1, 2, 3}, {4, 5, 6}};
    const std::vector<Eigen::Vector3d> moving{{0.1, 0, 0}, {0.3, 0, 1e-20}};
    s.viewpoints = gnomon::viewpoint_table(moving);
    const std::string path = io_test::scratch_path("a.pcd");
    io::write_pcd(path, s);
    const gnomon::scan again = pcd_again(path, {});
    ASSERT_TRUE(again.viewpoints.covers(2));
    for (const std::size_t i : {0U, 1U}) EXPECT_EQ(again.viewpoints[i], moving[i]);
}

/// Fields of a file, read and written again, are the same fields.
TEST(io_write_pcd, writes_fields_as_they_were_read) {
    const std::string path = io_test::scratch_path("a.pcd");
    const std::vector<Eigen::Vector3f> points = {{1.5F, 2, 3}, {4, 5, 6}};
    const std::vector<std::array<std::uint8_t, 3>> colors = {{1, 2, 3}, {255, 0, 7}};
    const std::vector<Eigen::Vector3d> normals = {{0, 0, 1}, {0.1, 0, 0}};
    io::write_pcd(path, points, {io::normal_properties(normals), io::color_properties(colors)});
    const std::string first = io::load(path).bytes;
    const gnomon::scan s = pcd_again(path);
    io::write_pcd(path, s, io::field_properties(s));
    EXPECT_EQ(io::load(path).bytes, first);
}

TEST(io_write_pcd, refuses_to_round_coordinates_by_more_than_a_millimetre) {
    const std::string path = io_test::scratch_path("a.pcd");
    std::remove(path.c_str());
    const std::vector<Eigen::Vector3d> here = {{16383.9995, -16383.9995, 0}},
                                       utm = {{691234.12, 5335678.98, 515}},
                                       beyond_floats = {{0, 1e300, 0}};
    EXPECT_THROW(io::write_pcd(path, utm), std::invalid_argument);
    EXPECT_THROW(io::write_pcd(path, beyond_floats), std::invalid_argument);
    EXPECT_FALSE(io_test::exists(path));
    io::write_pcd(path, utm, {}, {.coordinates = field_type::float64});
    EXPECT_EQ(pcd_again(path).points, utm);
    io::write_pcd(path, here);
    EXPECT_LE((pcd_again(path).points[0] - here[0]).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(io_write_pcd, refuses_impossible_arguments_and_leaves_nothing) {
    const std::string path = io_test::scratch_path("a.pcd");
    std::remove(path.c_str());
    gnomon::scan s;
    s.points.assign(3, Eigen::Vector3d(1, 2, 3));
    const auto refuse = [&](const io::properties& columns, io::pcd_options options = {}) {
        EXPECT_THROW(io::write_pcd(path, s, columns, options), std::invalid_argument);
        EXPECT_FALSE(io_test::exists(path));
        EXPECT_FALSE(io_test::exists(path + ".part0"));
    };
    const auto column = [](const std::string& name, double value) {
        return io::property{name, field_type::uint8, 3, [value](std::size_t) { return value; }};
    };
    const std::vector<int> four(4);
    refuse(io::scalar_property("other_size", four));
    refuse({}, {.coordinates = field_type::int32});
    refuse({column("twice", 0), column("twice", 0)});
    refuse({column("nx", 0), column("normal_x", 0)});
    refuse(column("two words", 0));
    refuse(column("byte", 256));
    s.width = 2;
    refuse({});
}

TEST(io_write_pcd, reader_survives_truncation_and_damage) {
    const auto parser = [](const io::input& file) { return io::read_pcd(file, {"*"}); };
    const std::string path = io_test::scratch_path("a.pcd");
    const std::vector<Eigen::Vector3d> points = {{1, 2, 3}, {pcd_nan, 0, 1}};
    const std::vector<std::array<std::uint8_t, 3>> colors = {{1, 2, 3}, {255, 0, 7}};
    for (const bool ascii : {false, true}) {
        io::write_pcd(path, points, io::color_properties(colors), {.ascii = ascii});
        const std::string bytes = io::load(path).bytes;
        io_test::check_truncation(parser, bytes, !ascii);
        io_test::check_mutation(parser, bytes, 1000);
    }
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <clocale>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include "las_test_support.hpp"
#include "shared_file.hpp"
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/io/read_las.hpp>  // where included, LAS files are read

namespace {

const auto any_parser = [](const gnomon::io::input& file) { return gnomon::io::read(file); };

/// The same three points in every format, under file names of other formats.
const std::vector<std::string> one_cloud = {
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n1 2 3\n4.5 5 6\n",
    "# .PCD v.7\nFIELDS x y z\nPOINTS 2\nDATA ascii\n1 2 3\n4.5 5 6\n",
    "# by a tool\n of mine\nVERSION .7\nFIELDS x y z\nPOINTS 2\nDATA ascii\n1 2 3\n4.5 5 6\n",
    "# vtk DataFile Version 2.0\n\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n1 2 3 4.5 5 6\n",
    "# text\n1 2 3\n4.5 5 6\n",
    "x,y,z\n1,2,3\n4.5,5,6\n",
    io_test::las_bytes({.points = {{.x = 10, .y = 20, .z = 30}, {.x = 45, .y = 50, .z = 60}},
                        .scale = {0.1, 0.1, 0.1},
                        .offset = {0, 0, 0}})};

TEST(io_read, detects_the_format_by_content) {
    for (const std::string& bytes : one_cloud) {
        const gnomon::scan s = gnomon::io::read(io_test::scratch_file("wrong.jpg", bytes));
        ASSERT_EQ(s.size(), 2U) << bytes;
        EXPECT_EQ(s.points[1], Eigen::Vector3d(4.5, 5, 6));
    }
}

TEST(io_read, does_not_depend_on_the_locale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* const name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
        if (std::setlocale(LC_ALL, name) != nullptr) break;
    for (const std::string& bytes : one_cloud)
        EXPECT_EQ(gnomon::io::read({"some.file", bytes}).points[1].x(), 4.5);
    std::setlocale(LC_ALL, before.c_str());
}

TEST(io_read, names_the_file_as_given) {
    const std::string path = io_test::scratch_file("bad.xyz", "1 2 3\n4 5 six\n");
    try {
        static_cast<void>(gnomon::io::read(path));
        FAIL();
    } catch (const gnomon::error& e) {
        EXPECT_EQ(std::string(e.what()), path + ", line 2: \"six\" is not a number");
    }
    EXPECT_THROW(static_cast<void>(gnomon::io::read(path + ".missing")), gnomon::error);
}

TEST(io_read, names_a_tool_for_what_it_does_not_read) {
    io_test::expect_error(any_parser, "ASTM-E57" + std::string(100, '\0'), "byte 0",
                          "pdal translate a.e57 a.las");
    for (const char* mesh :
         {"OFF\n3 1 0\n", "solid chair\n", "glTF\2", "<?xml version=\"1.0\"?>\n",
          "# a chair\n\nmtllib chair.mtl\n", "v 0 0 0\nv 0.5 0 0\n", "o seat\nv 0 0 0\n"})
        io_test::expect_error(any_parser, mesh, "byte 0", "simulate_scan --scene a.obj");
    std::string laz = one_cloud.back();
    laz[104] = '\x80';
    io_test::expect_error(any_parser, laz, "byte 104", "laszip -i a.laz -o a.las");
    // As in a program that does not include the reader.
    const auto reader = std::exchange(gnomon::io::detail::las_reader, nullptr);
    io_test::expect_error(any_parser, one_cloud.back(), "byte 0", "<gnomon/io/read_las.hpp>");
    gnomon::io::detail::las_reader = reader;
}

TEST(io_read, survives_any_bytes) {
    for (const std::string& bytes : one_cloud) {
        io_test::check_truncation(any_parser, bytes, false);
        io_test::check_mutation(any_parser, bytes, 1000);
    }
    std::string noise;
    for (unsigned i = 0, x = 1; i < 5000; ++i, x = x * 1664525 + 1013904223)
        noise += static_cast<char>(x >> 24);
    EXPECT_FALSE(io_test::survives(any_parser, noise));
    EXPECT_FALSE(io_test::survives(any_parser, "ply\n" + noise));
    EXPECT_FALSE(io_test::survives(any_parser, std::string(1 << 20, '\0')));
    EXPECT_FALSE(io_test::survives(any_parser, "ply\n" + std::string(1 << 20, '\n')));
}

struct known_file {
    const char* name;
    std::size_t points;
    std::size_t finite;
    std::vector<std::string> fields = {};
};

TEST(io_read, counts_the_points_of_real_files) {
    const std::vector<known_file> files = {
        {"scans/lms400_table_scene_1cm.pcd", 41049, 41049},
        {"scans/asl_apartment_0.vtk", 36674, 36674},
        {"scans/pcl_room_scan1.pcd", 112586, 112586},
        {"scans/pcl_office1_kinect.pcd", 307200, 254456, {"rgb"}},
        {"scans/pcl_table_mug_stereo.pcd", 307200, 209280},
        {"scans/box_caixa.ply", 46370, 46370, {"red", "green", "blue"}},
        {"scans/box_caixa2.ply", 16145, 16145},
        {"segmentation_truth/synpeb_test_100.pcd", 10000, 10000, {"intensity"}},
        {"segmentation_truth/tum_office_room1_parts.pcd", 237907, 237907, {"label"}}};
    if (shared_file(files.front().name).empty()) GTEST_SKIP() << "needs shared data";
    for (const known_file& file : files) {
        SCOPED_TRACE(file.name);
        const gnomon::scan s = gnomon::io::read(shared_file(file.name), file.fields);
        std::size_t finite = 0;
        for (const Eigen::Vector3d& p : s) finite += gnomon::is_finite(p) ? 1 : 0;
        EXPECT_EQ(s.size(), file.points);
        EXPECT_EQ(finite, file.finite);
        ASSERT_EQ(s.fields.size(), file.fields.size());
        for (const gnomon::scan::scalar_field& field : s.fields) {
            ASSERT_EQ(field.values.size(), file.points);
            if (field.name == "rgb") continue;  // three bytes in the guise of a float
            for (const double value : field.values) ASSERT_EQ(value, std::floor(value));
        }
    }
}

}  // namespace

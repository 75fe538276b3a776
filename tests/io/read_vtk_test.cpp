// SPDX-License-Identifier: BSL-1.0
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/scan.hpp>
#include <gnomon/io/read_vtk.hpp>

namespace {

const auto vtk_parser = [](const gnomon::io::input& file) { return gnomon::io::read_vtk(file); };

const std::string vtk_begin = "# vtk DataFile Version 3.0\nBINARY DATASET POINTS\n";
const std::string vtk_points = "POINTS 3 float\n1 2 3 4 5 6\n7\n\n 8 9";

TEST(io_read_vtk, reads_points_that_run_on_over_lines) {
    for (const std::string dataset :
         {"DATASET POLYDATA\n", "\nDATASET UNSTRUCTURED_GRID\n",
          "DATASET POLYDATA\nFIELD FieldData 1\nTIME 1 1 double\n1\n"}) {
        for (const std::string tail : {"", "\nVERTICES 1 2\n1 0\n"}) {
            const gnomon::scan s = gnomon::io::read_vtk(
                {"some.file", vtk_begin + "ASCII\n" + dataset + vtk_points + tail});
            ASSERT_EQ(s.size(), 3U);
            EXPECT_EQ(s.points[0], Eigen::Vector3d(1, 2, 3));
            EXPECT_EQ(s.points[2], Eigen::Vector3d(7, 8, 9));
            EXPECT_TRUE(s.viewpoints.empty());
        }
    }
}

TEST(io_read_vtk, rejects_unsupported_files) {
    const auto refuse = [](const std::string& bytes, const std::string& at,
                           const std::string& why) {
        io_test::expect_error(vtk_parser, bytes, at, why);
    };
    const std::string ascii = vtk_begin + "ASCII\n";
    const std::string poly = ascii + "DATASET POLYDATA\n";
    refuse("# vtk\n", "line 1", "not a legacy VTK");
    refuse(vtk_begin, "line 3", "ends too early");
    refuse(vtk_begin + "BINARY\n", "line 3", "BINARY is not supported");
    refuse(vtk_begin + "TEXT\n", "line 3", "ASCII or BINARY");
    refuse(ascii + vtk_points, "line 4", "DATASET is missing");
    refuse(ascii + "DATASET STRUCTURED_POINTS\n", "line 4", "\"STRUCTURED_POINTS\"");
    refuse(poly + "VERTICES 1 2\n1 0\n", "line 7", "ends too early");
    refuse(poly + "POINTS 3 int\n", "line 5", "\"int\"");
    refuse(poly + "POINTS -3 float\n", "line 5", "not a count");
    refuse(poly + "POINTS 4 float\n1 2 3 4 5 6 7 8 9\n", "line 5", "bytes are left");
    refuse(poly + "POINTS 2000000000 float\n1 2 3", "line 5", "bytes are left");
    refuse(poly + "POINTS 9223372036854775808 float\n1 2 3", "line 5", "bytes are left");
    refuse(poly + "POINTS 1 float\n1 2\nx\n", "line 7", "\"x\" is not a number");
    refuse(poly + "POINTS 1 float\n1 2\n\n\n", "line 9", "ends too early");
    io_test::expect_error([](const auto& file) { return gnomon::io::read_vtk(file, {"time"}); },
                          poly + vtk_points, "line 5", "no field \"time\"; there are: x, y, z");
}

TEST(io_read_vtk, survives_truncation_and_damage) {
    const std::string bytes = vtk_begin + "ASCII\nDATASET POLYDATA\n" + vtk_points;
    io_test::check_truncation(vtk_parser, bytes, false);
    io_test::check_mutation(vtk_parser, bytes);
}

}  // namespace

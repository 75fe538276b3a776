// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/scan.hpp>
#include <gnomon/io/read_xyz.hpp>

namespace {

const auto xyz_parser = [](const gnomon::io::input& file) { return gnomon::io::read_xyz(file); };

gnomon::scan parse_xyz(const std::string& bytes, const std::vector<std::string>& fields = {}) {
    return gnomon::io::read_xyz({"some.file", bytes}, fields);
}

TEST(io_read_xyz, reads_every_separator) {
    for (const std::string bytes : {
             "1 2.5 -3e1\n4 nan 6\n",
             "1\t2.5\t-3e1\n4\tnan\t6",
             "1,2.5,-3e1\r\n4,NaN,6\r\n",
             "1 , 2.5 , -3e1 ,\n 4;nan;6;\n",
             "# a comment\n\n// X Y Z\n  +1; 2.5; -3e1  \n#\n4, nan, 6\n\n",
             "\xEF\xBB\xBF"
             "1 2.5 -3e1\n4 nan 6\n",
         }) {
        const gnomon::scan s = parse_xyz(bytes);
        ASSERT_EQ(s.size(), 2U) << bytes;
        EXPECT_EQ(s.points[0], Eigen::Vector3d(1, 2.5, -30));
        EXPECT_TRUE(std::isnan(s.points[1].y()));
        EXPECT_EQ(s.points[1].z(), 6);
        EXPECT_TRUE(s.viewpoints.empty());
    }
}

TEST(io_read_xyz, names_columns_by_position_or_by_the_first_line) {
    const gnomon::scan by_position =
        parse_xyz("1 2 3 40 50\n6 7 8 90 100", {"column 4", "column 3"});
    EXPECT_EQ(by_position.fields[0].name, "column 4");
    EXPECT_EQ(by_position.fields[0].values, (std::vector<double>{50, 100}));
    EXPECT_EQ(by_position.fields[1].values, (std::vector<double>{40, 90}));

    const gnomon::scan by_name = parse_xyz("x,y,z,intensity\n1,2,3,40\n6,7,8,90\n", {"intensity"});
    EXPECT_EQ(by_name.size(), 2U);
    EXPECT_EQ(by_name.fields[0].values, (std::vector<double>{40, 90}));
    EXPECT_EQ(parse_xyz("easting northing height\n1 2 3\n").points[0], Eigen::Vector3d(1, 2, 3));
}

TEST(io_read_xyz, rejects_files_that_are_no_table) {
    const auto refuse = [](const std::string& bytes, const std::string& at,
                           const std::string& why) {
        io_test::expect_error(xyz_parser, bytes, at, why);
    };
    refuse("", "line 1", "no points");
    refuse("# nothing\n", "line 2", "no points");
    refuse("x y z\n", "line 2", "no points");
    refuse("1 2\n", "line 1", "fewer than three");
    refuse("OFF\n8 6 12\n", "line 1", "fewer than three");
    refuse("1 2 3\n4 5\n", "line 2", "missing");
    refuse("1 2 3\n4 5 6 7\n", "line 2", "more values");
    refuse("1 2 3\n4 five 6\n", "line 2", "\"five\" is not a number");
    refuse("1 2 x\n", "line 1", "\"x\" is not a number");
    refuse("1 2 3\nx y z\n", "line 2", "\"x\" is not a number");
    refuse("1 2 1e400\n", "line 1", "out of range");
    refuse("1,2,,3\n", "line 1", "\"\" is not a number");
    refuse("1,5;2,5;3,5\n", "line 1", "\"1,5\"");
    refuse("-1,5;2,5;3,5\n1;2;3\n", "line 1", "\"-1,5\"");
    refuse("1;5;2,5\n", "line 1", "\"2,5\" is not a number");
    refuse("v 1 2 3\n", "line 1", "cannot be the name");
    refuse("time,x,y,z\n0,1,2,3\n", "line 1", "cannot be the name");
    refuse("Z,Y,X\n1,2,3\n", "line 1", "\"Z\" cannot be the name of column 0");
    refuse("'x';\"z\";'y'\n1;2;3\n", "line 1", "cannot be the name of column 1");
    refuse("\x89PNG\r\n\x1a\n", "line 1", "fewer than three");
    io_test::expect_error([](const auto& file) { return gnomon::io::read_xyz(file, {"i"}); },
                          "1 2 3 4\n", "line 1", "no field \"i\"; there are: x, y, z, column 3");
}

TEST(io_read_xyz, survives_truncation_and_damage) {
    const std::string bytes = "x;y;z;i\n// comment\n1;2;3;4\n\n-5.5;6e2;nan;8\n";
    io_test::check_truncation(xyz_parser, bytes, false);
    io_test::check_mutation(xyz_parser, bytes);
}

TEST(io_read_xyz, gives_all_columns) {
    const gnomon::scan unnamed = parse_xyz("1 2 3 4 5\n6 7 8 9 10\n", {"*"});
    ASSERT_EQ(unnamed.fields.size(), 2u);
    EXPECT_EQ(unnamed.fields[1].name, "column 4");
    EXPECT_EQ(unnamed.fields[1].values, (std::vector<double>{5, 10}));
    EXPECT_EQ(unnamed.fields[1].type, gnomon::scan::field_type::float64);
    EXPECT_EQ(parse_xyz("x,y,z,intensity\n1,2,3,4\n", {"*"}).fields[0].name, "intensity");
    EXPECT_TRUE(parse_xyz("1 2 3\n", {"*"}).fields.empty());
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "io_test_support.hpp"
#include <gnomon/core/error.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/label_properties.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/io/read_las.hpp>
#include <gnomon/io/write_las.hpp>
#include <gnomon/io/write_pcd.hpp>
#include <gnomon/io/write_ply.hpp>

namespace {

namespace io = gnomon::io;

TEST(io_label_properties, colors_differ) {
    std::set<std::array<std::uint8_t, 3>> colors;
    for (std::int32_t label = -1; label < 60; ++label) colors.insert(io::label_color(label));
    EXPECT_EQ(colors.size(), 61U);
    EXPECT_EQ(io::label_color(60), io::label_color(0));
    EXPECT_EQ(io::label_color(-7), io::label_color(-1));
    EXPECT_EQ(io::label_color(20), (std::array<std::uint8_t, 3>{113, 164, 214}));
    static_cast<void>(io::label_color(2147483647));
}

/// Labels and their colors are the same after a turn through a file of each format.
TEST(io_label_properties, labels_survive_every_format) {
    const std::vector<std::int32_t> labels = {-1, 0, 5, 2147483647, 300};
    const std::vector<Eigen::Vector3d> points(5, Eigen::Vector3d(1, 2, 3));
    const io::properties columns = io::label_properties(labels);
    ASSERT_EQ(columns.size(), 4U);
    const std::string ply = io_test::scratch_path("a.ply"), pcd = io_test::scratch_path("a.pcd"),
                      las = io_test::scratch_path("a.las");
    io::write_ply(ply, points, columns);
    io::write_pcd(pcd, points, columns);
    io::write_las(las, points, columns);
    const gnomon::scan all[] = {io::read(ply, {"*"}), io::read(pcd, {"*"}),
                                io::read_las(io::load(las), {"*"})};
    for (const gnomon::scan& s : all) {
        EXPECT_EQ(io::labels_of(s), labels);
        for (const auto& field : s.fields) {
            const double unit = &s == &all[2] ? 257 : 1;  // sixteen bits
            for (std::size_t i = 0; i < labels.size() && field.name == "green"; ++i)
                EXPECT_EQ(field.values[i], unit * io::label_color(labels[i])[1]);
        }
    }
}

TEST(io_label_properties, refuses_fields_that_are_no_labels) {
    gnomon::scan s;
    s.points.resize(2);
    EXPECT_THROW(static_cast<void>(io::labels_of(s)), gnomon::error);
    for (const double value : {-2.0, 0.5, 2147483648.0, 1e300, std::stod("nan")}) {
        s.fields = {{"label", {0, value}}};
        try {
            static_cast<void>(io::labels_of(s));
            ADD_FAILURE() << value;
        } catch (const gnomon::error& e) {
            EXPECT_EQ(e.position(), "point 1");
        }
    }
}

}  // namespace

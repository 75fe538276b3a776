// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/io/ply_format.hpp>

namespace {

using gnomon::io::field_type;
using gnomon::io::ply_format;

TEST(io_ply_format, has_the_names_and_sizes_of_the_specification) {
    using gnomon::io::detail::ply_type_of;
    EXPECT_EQ(ply_type_of(field_type::int8).name, "char");
    EXPECT_EQ(ply_type_of(field_type::uint16).name, "ushort");
    EXPECT_EQ(ply_type_of(field_type::uint32).later_name, "uint32");
    EXPECT_EQ(ply_type_of(field_type::float32).layout.size, 4U);
    EXPECT_EQ(ply_type_of(field_type::float64).layout.kind, 'F');
    EXPECT_EQ(gnomon::io::detail::ply_format_names[static_cast<int>(ply_format::ascii)], "ascii");
}

}  // namespace

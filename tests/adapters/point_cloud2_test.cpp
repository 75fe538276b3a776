// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/point_range_laws.hpp"
#include <gnomon/adapters/point_cloud2.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/label_properties.hpp>
#include <gnomon/io/property.hpp>

namespace {

namespace io = gnomon::io;

/// The members of sensor_msgs::msg::PointField and PointCloud2.
struct point_field {
    std::string name;
    std::uint32_t offset = 0;
    std::uint8_t datatype = 0;
    std::uint32_t count = 1;
};
struct message {
    std::string header = "frame";
    std::uint32_t height = 0, width = 0;
    std::vector<point_field> fields;
    bool is_bigendian = false;
    std::uint32_t point_step = 0, row_step = 0;
    std::vector<std::uint8_t> data;
    bool is_dense = false;
};

/// How a message lies in memory.
struct message_layout {
    std::uint32_t width = 5, height = 1, point_padding = 0, row_padding = 0;
    bool is_double = false, is_big = false;
};

template <class T>
void put_bytes(message& m, std::size_t at, T value) {
    auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
    if (m.is_bigendian) std::reverse(bytes.begin(), bytes.end());
    std::copy(bytes.begin(), bytes.end(), m.data.begin() + static_cast<std::ptrdiff_t>(at));
}

/// A message of z, an intensity, x, y, a packed color and two numbers, written by hand; points by
/// number.
message message_of(const message_layout& layout) {
    const std::uint32_t size = layout.is_double ? 8 : 4;
    const std::uint8_t type = layout.is_double ? 8 : 7;
    message m;
    m.width = layout.width;
    m.height = layout.height;
    m.is_bigendian = layout.is_big;
    m.fields = {{"z", 1, type, 1},
                {"intensity", 1 + size, 4, 1},
                {"x", 3 + size, type, 0},  // as some drivers count
                {"y", 3 + 2 * size, type, 1},
                {"rgb", 3 + 3 * size, 7, 1},
                {"pair", 7 + 3 * size, 3, 2}};
    m.point_step = 11 + 3 * size + layout.point_padding;
    m.row_step = m.width * m.point_step + layout.row_padding;
    m.data.assign(std::size_t{m.row_step} * m.height, 0xcd);
    const auto put = [&](std::size_t at, double value) {
        if (layout.is_double)
            put_bytes(m, at, value);
        else
            put_bytes(m, at, static_cast<float>(value));
    };
    for (std::uint32_t i = 0; i < m.width * m.height; ++i) {
        const std::size_t at = i / m.width * m.row_step + i % m.width * m.point_step;
        put(at + m.fields[2].offset, i);
        put(at + m.fields[3].offset, 0.5 * i);
        put(at + m.fields[0].offset, -1.0 * i);
        put_bytes(m, at + m.fields[1].offset, static_cast<std::uint16_t>(1000 + i));
        put_bytes(m, at + m.fields[4].offset, 0x00010200U + i);
        put_bytes(m, at + m.fields[5].offset, static_cast<std::int16_t>(-300));
        put_bytes(m, at + m.fields[5].offset + 2, static_cast<std::int16_t>(i));
    }
    return m;
}

std::vector<message_layout> all_layouts() {
    std::vector<message_layout> result;
    for (const bool is_double : {false, true})
        for (const bool is_big : {false, true})
            for (const std::uint32_t height : {1U, 3U})
                for (const std::uint32_t padding : {0U, 7U})
                    result.push_back({5, height, padding, 2 * padding, is_double, is_big});
    return result;
}

TEST(adapters_point_cloud2, points_of_every_layout) {
    for (const message_layout& layout : all_layouts()) {
        const message m = message_of(layout);
        const auto points = gnomon::point_cloud2_points(m);
        ASSERT_EQ(points.size(), 5U * layout.height);
        laws::point_range_laws(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto n = static_cast<double>(i);
            EXPECT_EQ(points[i], Eigen::Vector3d(n, 0.5 * n, -n));
        }
        EXPECT_EQ(points.width, layout.height == 1 ? 0U : 5U);
        EXPECT_EQ(points.epsilon(), layout.is_double
                                        ? std::numeric_limits<double>::epsilon()
                                        : double{std::numeric_limits<float>::epsilon()});
    }
}

TEST(adapters_point_cloud2, fields_of_every_layout) {
    for (const message_layout& layout : all_layouts()) {
        const message m = message_of(layout);
        const gnomon::scan s = gnomon::point_cloud2_scan(m, {"*"});
        const auto points = gnomon::point_cloud2_points(m);
        const std::vector<std::string> names = {"intensity", "pair[0]", "pair[1]",
                                                "red",       "green",   "blue"};
        ASSERT_EQ(s.fields.size(), names.size());
        EXPECT_EQ(s.width, points.width);
        for (std::size_t i = 0; i < s.size(); ++i) {
            const auto n = static_cast<double>(i);
            const double expected[] = {1000 + n, -300, n, 1, 2, n};
            EXPECT_EQ(s.points[i], points[i]);
            for (std::size_t k = 0; k < names.size(); ++k) {
                EXPECT_EQ(s.fields[k].name, names[k]);
                EXPECT_EQ(s.fields[k].values[i], expected[k]) << names[k];
            }
        }
        EXPECT_TRUE(gnomon::point_cloud2_scan(m).fields.empty());
    }
}

void expect_cloud2_error(const message& m, const std::string& position, const std::string& part) {
    try {
        static_cast<void>(gnomon::point_cloud2_scan(m, {"*"}));
        ADD_FAILURE() << "accepted, but should have failed with \"" << part << "\"";
    } catch (const gnomon::error& e) {
        EXPECT_EQ(e.file(), "PointCloud2");
        EXPECT_EQ(e.position(), position) << e.what();
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
}

TEST(adapters_point_cloud2, refuses_damaged_messages) {
    const message good = message_of({.height = 3, .row_padding = 4});
    message m = good;
    m.fields.erase(m.fields.begin() + 3);
    expect_cloud2_error(m, "field \"y\"", "is missing; there are: z, intensity, x, rgb, pair");
    m = good;
    m.fields[3].datatype = 8;
    expect_cloud2_error(m, "field \"y\"", "FLOAT32 or all");
    for (const int k : {0, 2, 3}) m.fields[static_cast<std::size_t>(k)].datatype = 5;
    expect_cloud2_error(m, "field \"x\"", "FLOAT32 or all");
    for (const unsigned type : {0U, 9U, 255U}) {
        m = good;
        m.fields[1].datatype = static_cast<std::uint8_t>(type);
        expect_cloud2_error(m, "field \"intensity\"", "no datatype");
    }
    m = good;
    m.fields[2].count = 2;
    expect_cloud2_error(m, "field \"x\"", "several values");
    for (const std::uint32_t offset : {m.point_step - 3, m.point_step + 1, 4294967295U}) {
        m = good;
        m.fields[2].offset = offset;
        expect_cloud2_error(m, "field \"x\"", "beyond point_step");
    }
    m = good;
    m.fields[5].count = 3;
    expect_cloud2_error(m, "field \"pair\"", "beyond point_step");
    m = good;
    m.row_step = 5 * m.point_step - 1;
    expect_cloud2_error(m, "", "row_step is 114");
    m = good;
    m.point_step = 0;
    expect_cloud2_error(m, "", "point_step is 0");
    m = good;
    m.data.resize(2 * m.row_step + 5 * m.point_step);  // the last row needs no padding
    EXPECT_EQ(gnomon::point_cloud2_points(m).size(), 15U);
    m.data.pop_back();
    expect_cloud2_error(m, "", "too few for 3 rows of 115");
    m = good;
    m.width = m.height = m.point_step = m.row_step = 4294967295U;
    expect_cloud2_error(m, "", "row_step is 4294967295, but a row has 18446744065119617025");
    m.height = 1;
    expect_cloud2_error(m, "", "too few");
    m = good;
    m.height = 4294967295U;
    expect_cloud2_error(m, "", "too few");
}

TEST(adapters_point_cloud2, empty_messages_have_no_points) {
    message m = message_of({});
    m.width = 0;
    m.data.clear();
    EXPECT_EQ(gnomon::point_cloud2_points(m).size(), 0U);
    EXPECT_EQ(gnomon::point_cloud2_scan(m, {"*"}).fields.size(), 6U);
    const message blank;
    EXPECT_EQ(gnomon::point_cloud2_points(blank).size(), 0U);
    EXPECT_EQ(gnomon::point_cloud2_scan(blank, {"*"}).size(), 0U);
    m.fields[5].count = 4294967295U;
    expect_cloud2_error(m, "field \"pair\"", "beyond point_step");
}

/// Any damage gives points or a gnomon::error.
TEST(adapters_point_cloud2, survives_damage) {
    gnomon::random_stream random(4);
    const message good = message_of({.height = 3, .row_padding = 4});
    int accepted = 0;
    for (int round = 0; round < 20000; ++round) {
        message m = good;
        for (int k = 0; k < 2; ++k) {
            const std::uint64_t kind = random.below(8);
            std::uint32_t value = static_cast<std::uint32_t>(random.below(64));
            if (random.below(4) == 0) value = static_cast<std::uint32_t>(random.bits());
            point_field& field = m.fields[random.below(m.fields.size())];
            if (kind == 0) m.width = value;
            if (kind == 1) m.height = value;
            if (kind == 2) m.point_step = value;
            if (kind == 3) m.row_step = value;
            if (kind == 4) m.data.resize(value % 400);
            if (kind == 5) field.offset = value;
            if (kind == 6) field.datatype = static_cast<std::uint8_t>(value);
            if (kind == 7) field.count = value % 1000;
        }
        try {
            const gnomon::scan s = gnomon::point_cloud2_scan(m, {"*"});
            ++accepted;
            EXPECT_LE(s.size(), 400U);
        } catch (const gnomon::error&) {
        }
    }
    EXPECT_GT(accepted, 100);
}

/// What is filled in is read again.
TEST(adapters_point_cloud2, fills_messages) {
    gnomon::random_stream random(6);
    gnomon::scan s;
    std::vector<Eigen::Vector3d> normals;
    std::vector<std::int32_t> labels;
    for (int i = 0; i < 60; ++i) {
        s.points.emplace_back(static_cast<float>(random.uniform()), 2, i);
        normals.push_back({0, static_cast<float>(random.uniform()), -1});
        labels.push_back(i % 7 - 1);
    }
    s.points[3].x() = std::numeric_limits<double>::quiet_NaN();
    s.width = 12;
    for (const auto type : {io::field_type::float32, io::field_type::float64}) {
        message m;
        gnomon::fill_point_cloud2(
            m, s, {io::normal_properties(normals), io::label_properties(labels)}, type);
        const std::uint32_t size = type == io::field_type::float32 ? 4 : 8;
        EXPECT_EQ(m.header, "frame");
        EXPECT_EQ(m.width, 12U);
        EXPECT_EQ(m.height, 5U);
        EXPECT_EQ(m.point_step, 3 * size + 20);
        EXPECT_EQ(m.row_step, 12 * m.point_step);
        EXPECT_EQ(m.data.size(), 5 * m.row_step);
        EXPECT_FALSE(m.is_bigendian);
        EXPECT_FALSE(m.is_dense);
        const std::vector<std::string> names = {"x",        "y",        "z",     "normal_x",
                                                "normal_y", "normal_z", "label", "rgb"};
        const std::vector<unsigned> types = {size == 4 ? 7U : 8U, 7, 7, 7, 7, 7, 6, 7};
        ASSERT_EQ(m.fields.size(), names.size());
        for (std::size_t k = 0; k < names.size(); ++k) {
            EXPECT_EQ(m.fields[k].name, names[k]);
            EXPECT_EQ(m.fields[k].count, 1U);
            if (k == 0 || k > 2) {
                EXPECT_EQ(m.fields[k].datatype, types[k]);
            }
            EXPECT_EQ(m.fields[k].offset, k < 3 ? k * size : 3 * size + 4 * (k - 3));
        }
        const gnomon::scan again = gnomon::point_cloud2_scan(m, {"*"});
        EXPECT_EQ(again.width, 12U);
        EXPECT_EQ(io::labels_of(again), labels);
        for (std::size_t i = 0; i < s.size(); ++i) {
            EXPECT_EQ(again.points[i].tail<2>(), s.points[i].tail<2>());
            EXPECT_EQ(again.fields[1].values[i], normals[i].y());
            EXPECT_EQ(again.fields[5].values[i], io::label_color(labels[i])[1]);
        }
        EXPECT_TRUE(std::isnan(again.points[3].x()));
    }
}

TEST(adapters_point_cloud2, leaves_the_message_when_it_cannot_be_filled) {
    const message good = message_of({});
    message m = good;
    const std::vector<Eigen::Vector3d> utm = {{691234.12, 5335678.98, 515}};
    EXPECT_THROW(gnomon::fill_point_cloud2(m, utm), std::invalid_argument);
    gnomon::scan s;
    s.points.resize(3, Eigen::Vector3d::Zero());
    const std::vector<int> four(4);
    EXPECT_THROW(gnomon::fill_point_cloud2(m, s, io::scalar_property("v", four)),
                 std::invalid_argument);
    EXPECT_THROW(gnomon::fill_point_cloud2(m, s, {}, io::field_type::int32), std::invalid_argument);
    s.width = 2;
    EXPECT_THROW(gnomon::fill_point_cloud2(m, s), std::invalid_argument);
    EXPECT_EQ(m.data, good.data);
    EXPECT_EQ(m.fields.size(), good.fields.size());
    EXPECT_EQ(m.width, good.width);
    gnomon::fill_point_cloud2(m, utm, {}, io::field_type::float64);
    EXPECT_EQ(gnomon::point_cloud2_points(m)[0], utm[0]);
    gnomon::fill_point_cloud2(m, std::vector<Eigen::Vector3d>{});
    EXPECT_EQ(m.width * m.height, 0U);
    EXPECT_TRUE(m.is_dense);
}

}  // namespace

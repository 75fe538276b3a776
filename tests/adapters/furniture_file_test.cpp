// SPDX-License-Identifier: BSL-1.0
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "shared_file.hpp"
#include <gnomon/adapters/furniture_file.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/furniture.hpp>

namespace sim = gnomon::simulation;

namespace {

/// A board 0.4 m deep and 1 m wide on a post, far from the origin and above the floor. The axes are
/// depth, width, height, in the order of the file: x y z, or x -z y.
std::string board_on_post(const std::string& name, bool y_up, double unit = 1.0) {
    const std::string path = testing::TempDir() + "furniture_file_" + name;
    std::ofstream file(path, std::ios::binary);
    const auto vertex = [&](double x, double y, double z) {
        x = (x + 3) * unit, y = (y - 7) * unit, z = (z + 2) * unit;
        file << "v " << x << " " << (y_up ? z : y) << " " << (y_up ? -y : z) << "\n";
    };
    file << "o board\n";
    vertex(-0.2, -0.5, 0.7), vertex(0.2, -0.5, 0.7), vertex(0.2, 0.5, 0.7), vertex(-0.2, 0.5, 0.7);
    file << "f 1 2 3 4\no post\n";
    vertex(0, -0.1, 0), vertex(0, 0.1, 0), vertex(0, 0, 0.7);
    file << "f 5 6 7\n";
    return path;
}

/// A model of a file, as an object of a scene.
sim::scene alone(const sim::furniture_model& model) {
    sim::scene world;
    sim::add(world, model);
    return world;
}

TEST(furniture_file, stands_upright_on_the_floor_about_the_z_axis) {
    for (const bool y_up : {false, true}) {
        const std::string path = board_on_post(y_up ? "y.obj" : "z.obj", y_up);
        const auto model = sim::read_furniture(path, y_up ? sim::up_axis::y : sim::up_axis::z);
        const std::string name = y_up ? "furniture_file_y" : "furniture_file_z";
        EXPECT_EQ(model.name, name);
        const sim::scene world = alone(model);
        EXPECT_EQ(world.objects(), std::vector<std::string>{name});
        const sim::bounds extent = world.extent();
        EXPECT_LT((extent.low - Eigen::Vector3d(-0.2, -0.5, 0)).norm(), 1e-6);
        EXPECT_LT((extent.high - Eigen::Vector3d(0.2, 0.5, 0.7)).norm(), 1e-6);
        const auto hit = sim::bvh_caster(world)({{0.1, 0.4, 3}, {0, 0, -1}});
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->range, 2.3, 1e-6);
        EXPECT_EQ(world.surface_name(hit->surface), name + "/board/mesh");
    }
}

/// A model is placed in a room, as a built-in one.
TEST(furniture_file, stands_where_it_is_placed) {
    const auto model = sim::read_furniture(board_on_post("placed.obj", false));
    sim::scene world;
    sim::add(world, model, sim::at(4, 1, 0) * sim::yaw(gnomon::degrees(90)));
    EXPECT_LT((world.extent().low - Eigen::Vector3d(3.5, 0.8, 0)).norm(), 1e-6);
    EXPECT_LT((world.extent().high - Eigen::Vector3d(4.5, 1.2, 0.7)).norm(), 1e-6);
}

std::string message_of(const std::string& path) {
    try {
        (void)sim::read_furniture(path);
    } catch (const gnomon::error& e) {
        EXPECT_EQ(e.file(), path);
        return e.what();
    }
    return "no error";
}

TEST(furniture_file, refuses_other_units) {
    for (const double unit : {0.04, 5.1, 100.0, 1000.0}) {
        SCOPED_TRACE(unit);
        const std::string message =
            message_of(board_on_post("unit_" + std::to_string(unit) + ".obj", false, unit));
        EXPECT_NE(message.find("furniture in metres is 0.05 m to 5 m long"), std::string::npos)
            << message;
    }
    EXPECT_NE(message_of(board_on_post("cm.obj", false, 100.0)).find("this model 100 m"),
              std::string::npos);
    for (const double unit : {0.06, 1.0, 4.9})
        EXPECT_EQ(message_of(board_on_post("unit.obj", false, unit)), "no error");
}

TEST(furniture_file, refuses_files_without_triangles) {
    const std::string path = testing::TempDir() + "furniture_file_points.obj";
    std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\np 2\n";
    EXPECT_NE(message_of(path), "no error");
    EXPECT_NE(message_of("no/such/file.obj"), "no error");
}

/// All pieces of the shared data stand on the floor, and have the height of their file.
TEST(furniture_file, reads_all_furniture) {
    if (shared_file("furniture").empty()) GTEST_SKIP() << "needs shared data";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shared_file("furniture"))) {
        SCOPED_TRACE(entry.path().filename());
        const auto model = sim::read_furniture(entry.path().string());
        EXPECT_EQ(model.name, entry.path().stem().string());
        const sim::scene world = alone(model);
        EXPECT_EQ(world.objects().size(), 1u);
        const sim::bounds extent = world.extent();
        EXPECT_NEAR(extent.low.z(), 0.0, 1e-9);
        EXPECT_NEAR(extent.middle().x(), 0.0, 1e-9);
        EXPECT_NEAR(extent.middle().y(), 0.0, 1e-9);
        const auto file = sim::read_scene(entry.path().string());
        EXPECT_NEAR(extent.size().z(), file.extent().size().z(), 1e-9);
        ++files;
    }
    EXPECT_EQ(files, 25u);
}

}  // namespace

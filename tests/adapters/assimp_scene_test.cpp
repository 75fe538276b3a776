// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/ray_caster_laws.hpp"
#include "shared_file.hpp"
#include <gnomon/adapters/assimp_scene.hpp>
#include <gnomon/adapters/embree_caster.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/simulate.hpp>

namespace sim = gnomon::simulation;

namespace {

std::string written(const std::string& name, const std::string& text) {
    // Tests run at the same time: each has a file of its own.
    const std::string path = testing::TempDir() + "assimp_scene_" + name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

/// Four vertices, and a face.
std::string ply_of_face(const std::string& face) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n" +
           face + "\n";
}

const std::string two_groups =
    "o seat\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no leg\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 5 6 7\n";

TEST(assimp_scene, keeps_the_names_of_groups) {
    const std::string path = written("chair.obj", two_groups);
    const auto room = sim::read_scene(path);
    EXPECT_EQ(room.objects(), (std::vector<std::string>{"seat", "leg"}));
    EXPECT_EQ(room.surface_name(1), "leg/body/mesh");
    const auto chair = sim::read_scene(path, sim::mesh_groups::parts);
    EXPECT_EQ(chair.objects(), (std::vector<std::string>{"assimp_scene_chair"}));
    EXPECT_EQ(chair.surface_name(0), "assimp_scene_chair/seat/mesh");
    EXPECT_EQ(chair.surface_name(1), "assimp_scene_chair/leg/mesh");
    const auto hit = sim::bvh_caster(chair)({{0.9, 0.8, 3}, {0, 0, -1}});  // the quad's half
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->range, 2.0);
    EXPECT_EQ(hit->surface, 1);
}

/// A group stays one object, of however many materials it is.
TEST(assimp_scene, keeps_groups_of_several_materials_together) {
    const std::string path = written(
        "chair_of_two_materials.obj",
        "o chair\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nusemtl wood\nf 1 2 3\n"
        "usemtl steel\nf 4 5 6\no floor\nv 0 0 -1\nv 1 0 -1\nv 0 1 -1\nusemtl wood\nf 7 8 9\n");
    const auto room = sim::read_scene(path);
    EXPECT_EQ(room.objects(), (std::vector<std::string>{"chair", "floor"}));
    const sim::bvh_caster caster(room);
    for (const double height : {3.0, 0.5, -0.5}) {
        const auto hit = caster({{0.2, 0.2, height}, {0, 0, -1}});
        ASSERT_TRUE(hit);
        EXPECT_EQ(room.surface_name(hit->surface),
                  height > 0.0 ? "chair/body/mesh" : "floor/body/mesh");
    }
}

/// COLLADA files declare a unit and an up axis: coordinates are read in metres, along the axes of
/// the file.
TEST(assimp_scene, reads_collada_in_metres_and_its_own_axes) {
    const std::string path = written("plate.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="plate"><mesh>
<source id="p"><float_array id="a" count="9">0 0 5 100 0 5 0 200 5</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)");
    const auto extent = sim::read_scene(path).extent();
    EXPECT_LT((extent.low - Eigen::Vector3d(0, 0, 0.05)).norm(), 1e-6);
    EXPECT_LT((extent.high - Eigen::Vector3d(1, 2, 0.05)).norm(), 1e-6);
}

TEST(assimp_scene, refuses_missing_and_broken_files) {
    EXPECT_THROW((void)sim::read_scene("no/such/file.obj"), gnomon::error);
    for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
             {"empty.obj", ""},
             {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
             {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\np 2\np 3\n"},
             {"infinite.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n"},
             {"negative.ply", ply_of_face("3 0 1 -7")},
             {"beyond.ply", ply_of_face("3 0 1 99")},
             {"cut.stl", std::string(80, ' ') + "\x64"},
             {"noise.obj",
              "\x7f"
              "ELF\x02\x01\x01\xff\xfe\x00\x01 f 1 2 3 4 5 6 7 8 9"}}) {
        const std::string path = written(name, text);
        try {
            (void)sim::read_scene(path);
            ADD_FAILURE() << name;
        } catch (const gnomon::error& e) {
            EXPECT_EQ(e.file(), path);
            EXPECT_NE(std::string(e.what()).find(name), std::string::npos);
        }
    }
}

TEST(assimp_scene, every_piece_of_furniture_can_be_scanned) {
    if (shared_file("furniture").empty()) GTEST_SKIP() << "needs shared data";
    std::size_t files = 0;
    for (const char* folder : {"furniture", "normals_truth"}) {
        for (const auto& entry : std::filesystem::directory_iterator(shared_file(folder))) {
            SCOPED_TRACE(entry.path().filename());
            const auto world = sim::read_scene(entry.path().string(), sim::mesh_groups::parts);
            EXPECT_EQ(world.objects(), std::vector<std::string>{entry.path().stem().string()});
            const auto extent = world.extent();
            const Eigen::Vector3d middle = 0.5 * (extent.low + extent.high);
            const double size = (extent.high - extent.low).norm();
            sim::pose mount = sim::pitch(gnomon::degrees(20));
            mount.position = middle - 1.5 * size * mount.direction_out({1, 0, 0});
            const auto truth = sim::simulate(
                world, sim::vertical{.mount = mount},
                {.resolution = gnomon::degrees(0.5), .min_range = 0.0, .max_range = 1e4});
            EXPECT_GT(truth.scan.size(), 300u);
            ++files;
        }
    }
    EXPECT_EQ(files, 28u);
}

/// The rooms of the AWS house: the same hits by both casters; every object has its name.
TEST(assimp_scene, rooms_can_be_scanned) {
    if (shared_file("scenes").empty()) GTEST_SKIP() << "needs shared data";
    for (const auto& [file, objects, door] :
         {std::tuple{"aws_house_kitchen_dining.obj", 20u, "Refrigerator_01_001"},
          {"aws_house_living_room.obj", 30u, "AirconditionerB_01_001"}}) {
        const auto world = sim::read_scene(shared_file(std::string("scenes/") + file));
        EXPECT_EQ(world.objects().size(), objects);
        EXPECT_NE(std::find(world.objects().begin(), world.objects().end(), door),
                  world.objects().end());
        const sim::bvh_caster exact(world);
        const sim::embree_caster embree(world);
        gnomon::random_stream random(1);
        const auto extent = world.extent();
        std::size_t hits = 0;
        std::size_t others = 0;
        for (int i = 0; i < 20'000; ++i) {
            const auto r = laws::ray_within(extent, random);
            const auto expected = exact(r);
            const auto found = embree(r);
            if (expected && expected->range < 0.1) continue;  // nearer than any scanner sees
            hits += expected.has_value();
            const bool same =
                expected.has_value() == found.has_value() &&
                (!expected || std::abs(found->range - expected->range) <= 1e-5 * expected->range);
            others += !same;
        }
        EXPECT_GT(hits, 10'000u);
        EXPECT_LE(others, hits / 1000);  // at edges
        std::printf("%s: %zu hits, %zu rays differ by more than 1e-5\n", file, hits, others);
    }
}

}  // namespace

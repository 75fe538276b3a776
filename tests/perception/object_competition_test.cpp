// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "chair_in_scene.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/perception/detail/object_competition.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace {

using namespace one_chair;

/// Objects that came to one pose are one, which has the cells of all of them.
TEST(object_competition, unites_objects_at_one_pose) {
    const chair_in_scene scene;
    const std::vector<rec::surface_model> surfaces(2, scene.surfaces()[0]);
    const auto at = [](std::size_t object, double x) {
        rec::found_object o;
        o.object = object;
        o.aligned.pose = rigid_motion::on_ground(x, 0.0, degrees(0.0));
        return o;
    };
    std::vector<rec::found_object> objects{at(0, 0.0), at(1, 0.0), at(0, 0.02), at(0, 0.05)};
    std::vector<std::int32_t> of_cell{3, 2, gnomon::unlabeled, 1, 0};
    rec::detail::unite(objects, of_cell, surfaces);
    ASSERT_EQ(objects.size(), 3u);
    EXPECT_EQ(objects[1].object, 1u);
    EXPECT_EQ(objects[2].aligned.pose.position.x(), 0.05);
    EXPECT_EQ(of_cell, (std::vector<std::int32_t>{2, 0, gnomon::unlabeled, 1, 0}));
}

}  // namespace

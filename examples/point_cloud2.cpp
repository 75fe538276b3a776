// SPDX-License-Identifier: BSL-1.0
// How do I take sensor_msgs/PointCloud2 messages of ROS, and publish surfaces as such a message?
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/help.hpp"
#include <gnomon/adapters/point_cloud2.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/io/label_properties.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

// This program needs no ROS: here are the members of its messages. In a node, include
// <sensor_msgs/msg/point_cloud2.hpp> instead, and nothing else changes.
namespace sensor_msgs::msg {

struct PointField {
    std::string name;
    std::uint32_t offset = 0;
    std::uint8_t datatype = 0;
    std::uint32_t count = 0;
};

struct PointCloud2 {
    struct {
        std::string frame_id;
    } header;
    std::uint32_t height = 0, width = 0;
    std::vector<PointField> fields;
    bool is_bigendian = false;
    std::uint32_t point_step = 0, row_step = 0;
    std::vector<std::uint8_t> data;
    bool is_dense = false;
};

}  // namespace sensor_msgs::msg

namespace {

// [point_cloud2]
// #include <gnomon/adapters/point_cloud2.hpp>, <gnomon/io/label_properties.hpp>
class surface_node {
  public:
    sensor_msgs::msg::PointCloud2 on_cloud(const sensor_msgs::msg::PointCloud2& message) {
        const auto points = gnomon::point_cloud2_points(message);  // no copy
        chain_.into(seen_, points, threads_);  // in the memory of the last message

        using namespace gnomon::io;
        sensor_msgs::msg::PointCloud2 result;
        result.header = message.header;
        gnomon::fill_point_cloud2(
            result, points,
            {normal_properties(seen_.surface), label_properties(seen_.surfaces.labels())});
        return result;  // x y z normal_x normal_y normal_z label rgb
    }

  private:
    gnomon::perception<> chain_;
    gnomon::perception_result<> seen_;
    gnomon::team threads_;
};
// [point_cloud2]

/// What a driver would publish: a simulated kitchen, sixteen bytes a point.
sensor_msgs::msg::PointCloud2 message_of_a_driver() {
    namespace sim = gnomon::simulation;
    const sim::scene kitchen = sim::scenes::kitchen();
    gnomon::scan scan =
        sim::simulate(kitchen, sim::rotational{.mount = kitchen.sensor}, {}, {.sigma = 0.005}).scan;
    for (Eigen::Vector3d& p : scan.points) p -= scan.viewpoints[0];  // the frame of the sensor
    sensor_msgs::msg::PointCloud2 message;
    message.header.frame_id = "laser";
    const std::vector<float> intensity(scan.size(), 1.0F);
    gnomon::fill_point_cloud2(message, scan, gnomon::io::scalar_property("intensity", intensity));
    return message;
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv,
                     "Takes a message sensor_msgs/PointCloud2, and makes one of its surfaces."))
        return 0;
    surface_node node;
    const sensor_msgs::msg::PointCloud2 result = node.on_cloud(message_of_a_driver());
    std::printf("frame %s, %u x %u points of %u bytes:", result.header.frame_id.c_str(),
                result.width, result.height, result.point_step);
    for (const auto& field : result.fields) std::printf(" %s", field.name.c_str());
    const auto labels = gnomon::io::labels_of(gnomon::point_cloud2_scan(result, {"label"}));
    std::printf("\n%zu surfaces\n", gnomon::segments(labels).size());
}

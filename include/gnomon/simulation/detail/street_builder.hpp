// SPDX-License-Identifier: BSL-1.0
/// @file
/// The builder of random streets. Both sides of a street are built alike, each in a frame whose y
/// axis points away from the middle of the road: that of the scene for the left side, turned by 180
/// degrees for the right side. Traffic keeps to the right and so goes along -x in either frame.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/detail/greenery.hpp>
#include <gnomon/simulation/detail/house.hpp>
#include <gnomon/simulation/detail/mesh_builder.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/vehicle.hpp>

namespace gnomon::simulation::detail {

/// Draws a street from -length / 2 to length / 2 along x, with the sensor in the middle of its
/// length. The numbers of objects begin with 1 for each kind.
class street_builder {
  public:
    street_builder(double length, double kerb, double crown, bool plain, std::uint64_t seed)
        : random_(seed),
          plain_(plain),
          end_(0.5 * length),
          kerb_(kerb),
          crown_(crown),
          lane_(random_.uniform(3.0, 3.4)),
          road_(lane_ + random_.uniform(2.4, 2.8)),
          front_(road_ + random_.uniform(2.8, 3.8)) {
        const double above = random_.uniform(1.7, 2.0);
        world_.sensor = at(0.0, -0.5 * lane_, height(0.5 * lane_) + above);
        add_road();
        for (const auto& [name, turned] : {std::pair{"left", 0.0}, std::pair{"right", 180.0}}) {
            side_ = yaw(degrees(turned));
            add_ground(name);
            add_houses();
            add_trees_and_poles();
            add_parked_vehicles();
            add_traffic();
        }
    }

    /// Adds the car that carries the sensor in the middle of its roof.
    void add_own_car() {
        const vehicle car;
        const double roof = 0.5 * (car.boot + car.rear_window - car.bonnet - car.windscreen);
        add(world_, "own car", car, at(-roof, -0.5 * lane_, height(0.5 * lane_)));
    }

    [[nodiscard]] const scene& world() const { return world_; }

  private:
    /// "tree 3"
    [[nodiscard]] std::string next(const std::string& kind) {
        return numbered(kind, ++count_[kind]);
    }

    /// How high the road is at a distance from its middle [m]: a parabola.
    [[nodiscard]] double height(double y) const { return crown_ * (1.0 - y * y / (road_ * road_)); }

    void add_road() {
        if (crown_ == 0.0) {
            world_.add_object("road", plane_patch{2.0 * end_, 2.0 * road_});
            return;
        }
        constexpr int strips = 32;  // numerical: .1 mm from a parabola of 10 cm
        mesh_builder road;
        road.surface("plane");
        for (int s = 0; s < strips; ++s) {
            const double right = road_ * (2.0 * s / strips - 1.0);
            const double left = right + road_ * 2.0 / strips;
            road.face({Eigen::Vector3d(-end_, right, height(right)),
                       Eigen::Vector3d(end_, right, height(right)),
                       Eigen::Vector3d(end_, left, height(left)),
                       Eigen::Vector3d(-end_, left, height(left))});
        }
        world_.add_object("road", road.mesh());
    }

    /// The pavement reaches below the houses and to the gaps between them.
    void add_ground(const std::string& name) {
        constexpr double behind =
            16.0;  // fronts [m]: more than setback and depth of a house; chosen
        const double width = front_ + behind - road_;
        world_.add_object("kerb " + name, plane_patch{2.0 * end_, kerb_},
                          side_ * at(0.0, road_, 0.5 * kerb_) * roll(degrees(90)));
        world_.add_object("pavement " + name, plane_patch{2.0 * end_, width},
                          side_ * at(0.0, road_ + 0.5 * width, kerb_));
    }

    /// A row of houses. Half of them stand at the pavement, the others behind a hedge.
    void add_houses() {
        double x = -end_ + random_.uniform(0.0, 3.0);
        while (true) {
            house h;
            h.bays = 3 + static_cast<int>(random_.below(3));
            h.width = h.bays * random_.uniform(2.4, 3.1);
            if (x + h.width > end_) return;
            h.storeys = 2 + static_cast<int>(random_.below(3));
            h.eaves = h.storeys * random_.uniform(2.7, 3.2);
            h.ridge = h.eaves + random_.uniform(1.5, 4.0);
            h.recess = random_.uniform(0.10, 0.20);
            h.window_width = random_.uniform(1.0, 1.4);
            h.door = static_cast<int>(random_.below(static_cast<std::size_t>(h.bays)));
            h.openings = !plain_;
            const bool has_garden = random_.uniform() < 0.5;
            const double setback =
                has_garden ? random_.uniform(1.5, 3.0) : random_.uniform(0.0, 0.5);
            add_house(world_, next("house"), h, side_ * at(x, front_ + setback, kerb_));
            if (has_garden) add_hedges(x, h);
            x += h.width;
            if (random_.uniform() < 0.3) x += random_.uniform(1.0, 4.0);
        }
    }

    /// At the end of the pavement, with an opening before the door of the house.
    void add_hedges(double x, const house& h) {
        const double height = random_.uniform(0.9, 1.5);
        const double path = x + h.middle_of(h.door);
        for (const auto& [from, to] :
             {std::pair{x + 0.2, path - 0.7}, std::pair{path + 0.7, x + h.width - 0.2}}) {
            if (to - from < 1.0) continue;
            add_hedge(world_, next("hedge"), side_ * at(0.0, front_, kerb_),
                      {{from, 0.2, 0.05}, {to, 0.75, height}}, random_);
        }
    }

    /// In a row on the pavement, near the kerb.
    void add_trees_and_poles() {
        for (double x = -end_ + random_.uniform(2.0, 8.0); x < end_ - 2.0;
             x += random_.uniform(7.0, 12.0)) {
            const pose place = side_ * at(x, road_ + 0.6, kerb_);
            const double kind = random_.uniform();
            if (kind < 0.45) {
                add_tree(world_, next("tree"), place, random_);
            } else if (kind < 0.7) {
                object_builder(world_, next("pole"), place)
                    .part("post")
                    .disc(0.0, 0.0, 0.14, 0.0, 6.0)
                    .part("arm")
                    .block(0.0, -0.6, 0.08, 1.2, 5.9, 5.98)
                    .part("lamp")
                    .block(0.0, -1.3, 0.25, 0.6, 5.8, 5.9);
            } else if (kind < 0.85) {
                object_builder(world_, next("pole"), place)
                    .part("post")
                    .disc(0.0, 0.0, 0.07, 0.0, 2.7)
                    .part("sign")
                    .block(-0.05, 0.0, 0.02, 0.6, 2.0, 2.6);
            }
        }
    }

    /// A car or a van of random size, at a place of the side, along -x.
    void add_vehicle(const vehicle& v, const std::string& kind, double x, double y) {
        const angle turned = degrees(180.0 + random_.uniform(-1.5, 1.5));
        const pose place = side_ * at(x, y, height(y)) * yaw(turned);
        if (plain_) {
            object_builder(world_, next(kind), place)
                .part("body")
                .block(0.0, 0.0, v.length, v.width, v.clearance, v.height);
        } else {
            add(world_, next(kind), v, place);
        }
    }

    [[nodiscard]] std::pair<vehicle, std::string> any_vehicle() {
        const double scale = random_.uniform(0.92, 1.08);
        const bool is_van = random_.uniform() < 0.2;
        return {scaled(is_van ? van() : vehicle{}, scale), is_van ? "van" : "car"};
    }

    /// At the kerb, at distances that one can leave from, and with free places.
    void add_parked_vehicles() {
        double x = -end_ + random_.uniform(0.0, 6.0);
        while (true) {
            const auto [v, kind] = any_vehicle();
            const double y = road_ - 0.5 * v.width - random_.uniform(0.15, 0.35);
            if (x + v.length > end_) return;
            add_vehicle(v, kind, x + 0.5 * v.length, y);
            x += v.length + random_.uniform(0.6, 1.4);
            if (random_.uniform() < 0.6) x += random_.uniform(5.0, 18.0);
        }
    }

    /// In the middle of the lane, not where the sensor's own car is.
    void add_traffic() {
        constexpr double free = 9.0;  // to either side of the sensor [m]: about two cars; chosen
        for (double x = -end_ + random_.uniform(3.0, 25.0); x < end_ - 3.0;
             x += random_.uniform(15.0, 45.0)) {
            const auto [v, kind] = any_vehicle();
            const double y = 0.5 * lane_ + random_.uniform(-0.15, 0.15);
            const bool is_own_lane = side_.point_out({0.0, 1.0, 0.0}).y() < 0.0;
            if (!is_own_lane || std::abs(x) > free) add_vehicle(v, kind, x, y);
        }
    }

    scene world_;
    random_stream random_;
    bool plain_;    ///< facades are rectangles, and vehicles are boxes
    double end_;    ///< half the length of the street [m]
    double kerb_;   ///< height of the pavements [m]
    double crown_;  ///< height of the middle of the road [m]
    double lane_;   ///< width of a lane [m]
    double road_;   ///< half the width of the road, from kerb to kerb [m]
    double front_;  ///< the end of the pavement, from the middle of the road [m]
    pose side_;     ///< of the side that is built
    std::map<std::string, int> count_;  ///< objects of each kind
};

}  // namespace gnomon::simulation::detail

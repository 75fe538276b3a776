// SPDX-License-Identifier: BSL-1.0
// Figs. 4.9, 4.10 and 4.12 as laws: rooms of known truth, 15 mm of noise, the parameters of Sec.
// 4.4.1.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::unlabeled;

/// A scan of a room, and what was perception_result in it.
struct perceived_room {
    sim::scene world;
    sim::true_scan truth;
    gnomon::perception_result<gnomon::plane_fit> seen;

    perceived_room(sim::scene scene, const auto& trajectory, std::uint64_t seed)
        : world(std::move(scene)),
          truth(sim::simulate(world, trajectory, {}, {.sigma = 0.015, .seed = seed},
                              gnomon::threads{2})),
          seen(gnomon::perception<>{.leave_out = gnomon::floor_and_ceiling{}}(truth.scan)) {}

    struct recovery {
        double iou = 0.0;  ///< of the surface with the segment that has most of it
        std::int32_t segment = unlabeled;
    };

    [[nodiscard]] recovery of(const std::string& name) const {
        const std::int32_t surface = world.find_surface(name);
        EXPECT_NE(surface, sim::nothing) << name;
        std::map<std::int32_t, std::size_t> held;
        std::size_t points = 0;
        for (const auto i : seen.kept) {
            if (truth.surfaces[i] != surface) continue;
            ++held[seen.surfaces.labels()[i]];
            ++points;
        }
        held.erase(unlabeled);
        if (held.empty()) return {};
        const auto& [label, common] =
            *std::ranges::max_element(held, {}, [](const auto& h) { return h.second; });
        const std::size_t size = seen.surfaces[static_cast<std::size_t>(label)].size();
        return {static_cast<double>(common) / static_cast<double>(points + size - common), label};
    }
};

perceived_room perceived_kitchen(std::uint64_t seed) {
    const sim::scene world = sim::scenes::kitchen();
    return {world, sim::rotational{.mount = world.sensor}, seed};
}

perceived_room perceived_living_room(std::uint64_t seed) {
    const sim::scene world = sim::scenes::living_room();
    return {world, sim::rotational{.mount = world.sensor}, seed};
}

/// What a segment has of a surface at least. A seat has some hundred points, of which those of the
/// rim can belong to the board. (The vase of the living room is no plane, and several segments.)
double least_iou(const std::string& name) {
    return name.find("/seat/") != std::string::npos ? 0.7 : 0.8;
}

constexpr std::uint64_t seeds_of_rooms = 3;

TEST(merged_rooms, major_surfaces_of_the_kitchen_are_one_segment_each) {
    for (std::uint64_t seed = 1; seed <= seeds_of_rooms; ++seed) {
        const perceived_room r = perceived_kitchen(seed);
        for (const char* name :
             {"room/wall +x/plane", "room/wall -y/plane", "room/wall +y/plane", "cupboard/body/-x",
              "sink cabinet/body/-x", "sink cabinet/body/+z", "table/top/+z", "chair 1/seat/+z",
              "chair 2/seat/+z", "chair 4/seat/+z"})
            EXPECT_GE(r.of(name).iou, least_iou(name)) << name << ", seed " << seed;
    }
}

TEST(merged_rooms, major_surfaces_of_the_living_room_are_one_segment_each) {
    for (std::uint64_t seed = 1; seed <= seeds_of_rooms; ++seed) {
        const perceived_room r = perceived_living_room(seed);
        for (const char* name :
             {"room/wall +x/plane", "room/wall -y/plane", "room/wall +y/plane", "platform/body/+z",
              "small table/top/+z", "armchair 1/arm right/-y", "armchair 2/arm left/+y",
              "sideboard/body/-x"})
            EXPECT_GE(r.of(name).iou, least_iou(name)) << name << ", seed " << seed;
    }
}

TEST(merged_rooms, seats_of_two_chairs_are_one_segment_each) {
    const sim::scene world = sim::scenes::two_chairs();
    const auto expect_found = [&](const auto& trajectory, std::uint64_t seed) {
        const perceived_room r(world, trajectory, seed);
        for (const char* name : {"chair 1/seat/+z", "chair 2/seat/+z"})
            EXPECT_GE(r.of(name).iou, least_iou(name)) << name << ", seed " << seed;
    };
    for (std::uint64_t seed = 1; seed <= seeds_of_rooms; ++seed) {
        expect_found(sim::horizontal{.mount = world.sensor}, seed);
        expect_found(sim::vertical{.mount = world.sensor}, seed);
        expect_found(sim::rotational{.mount = world.sensor}, seed);
    }
}

TEST(merged_rooms, seats_of_neighboring_chairs_stay_apart) {
    const auto expect_apart = [](const perceived_room& r, const std::vector<std::string>& seats) {
        std::set<std::int32_t> segments;
        for (const std::string& seat : seats) {
            const std::int32_t segment = r.of(seat).segment;
            EXPECT_NE(segment, unlabeled) << seat;
            segments.insert(segment);
        }
        EXPECT_EQ(segments.size(), seats.size());
    };
    for (std::uint64_t seed = 1; seed <= seeds_of_rooms; ++seed) {
        expect_apart(perceived_kitchen(seed),
                     {"chair 1/seat/+z", "chair 2/seat/+z", "chair 4/seat/+z"});
        const sim::scene world = sim::scenes::two_chairs();
        expect_apart({world, sim::rotational{.mount = world.sensor}, seed},
                     {"chair 1/seat/+z", "chair 2/seat/+z"});
    }
}

TEST(merged_rooms, second_run_changes_nothing) {
    for (std::uint64_t seed = 1; seed <= seeds_of_rooms; ++seed) {
        for (const perceived_room& r : {perceived_kitchen(seed), perceived_living_room(seed)}) {
            const gnomon::visibility visible(r.truth.scan);
            const auto once =
                gnomon::merge_occluded(r.truth.scan, r.seen.initial_segments, visible);
            const auto again = gnomon::merge_occluded(r.truth.scan, once.segments, visible);
            EXPECT_EQ(again.segments.labels(), once.segments.labels());
        }
    }
}

/// Fig. 4.12, also for a sensor on an arm that turns about its elbow: no two scan lines are from
/// one place.
TEST(merged_rooms, wall_behind_the_column_is_one_segment_from_any_trajectory) {
    const sim::scene world = sim::scenes::two_chairs();
    const auto expect_one_wall = [&](const auto& trajectory) {
        const perceived_room r(world, trajectory, 1);
        EXPECT_GT(r.seen.initial_segments.size(), r.seen.surfaces.size());
        EXPECT_GE(r.of("room/wall +x/plane").iou, 0.95);
    };
    expect_one_wall(sim::rotational{.mount = world.sensor});
    expect_one_wall(sim::vertical{.mount = world.sensor});
    const auto forearm = sim::at(0.25, 0, 0), elbow = world.sensor * sim::at(-0.25, 0, 0);
    expect_one_wall(sim::along(4.0, [&](double seconds) {
        return elbow * sim::yaw(gnomon::degrees(45.0 * seconds - 90.0)) * forearm *
               sim::roll(gnomon::degrees(90));
    }));
}

}  // namespace

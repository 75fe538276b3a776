// SPDX-License-Identifier: BSL-1.0
/// @file
/// How recognition in whole rooms is tested (Klasing 2010, Sec. 5.7): simulated rooms with clutter,
/// their truth, and the judgement of the objects that a method finds in their scans, which is
/// independent of the method:
///
///     const seen_room room = room_of(sim::furniture_models(), seed, {});
///     const std::vector<found_object> found = method(room.truth.scan);
///     total.add(judgement_of(room, found, headings));
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "views.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/true_scan.hpp>

/// Objects, and groups of background, of fewer points do not count.
inline constexpr std::size_t fewest_points = 60;

/// What rooms are like, and how they are scanned.
struct room_kind {
    bool touching = false;  ///< objects touch walls and each other
    int pieces = 4;         ///< of furniture
    int clutter = 22;       ///< of which a scan shows about 20
    double duration = 8.0;  ///< t_s [s]
    double sigma = 0.005;   ///< of the noise along the rays [m]
};

/// A piece of furniture in a scan.
struct true_piece {
    std::string name;                         ///< of its model
    sim::pose pose;                           ///< of the model in the room
    std::vector<gnomon::point_index> points;  ///< that are of it
};

/// Clutter in a scan, or the cupboard.
struct background_group {
    std::string name;        ///< without its number
    std::size_t points = 0;  ///< that are of it
    double height = 0.0;     ///< of its upper end above the floor [m]
    double distance = 0.0;   ///< of its points from those of furniture, the least [m]
};

/// Fewest points of a piece whose pose is compared with the true one.
inline constexpr std::size_t enough_for_pose = 200;

/// A scan of a room, and what is true of it.
struct seen_room {
    sim::true_scan truth;
    std::vector<true_piece> pieces;
    /// Of each point: the number of its piece, or `no_piece`.
    std::vector<std::size_t> piece_of_point;
    std::vector<background_group> background;  ///< of `fewest_points` and more

    static constexpr std::size_t no_piece = static_cast<std::size_t>(-1);
};

/// A room of a seed, scanned by beams that skim, `wide_beam`.
[[nodiscard]] seen_room room_of(const std::vector<sim::furniture_model>& models, std::uint64_t seed,
                                const room_kind& kind);

/// An object that a method has found, or a group of points that it calls background.
struct found_object {
    std::string name;          ///< of the most probable class, background among them
    double probability = 0.0;  ///< of that class
    std::vector<gnomon::point_index> points;
    /// Of the model, if the method finds poses.
    std::optional<gnomon::alignment> aligned = std::nullopt;
};

/// A method: it gets a scan, and nothing else.
using room_method = std::function<std::vector<found_object>(const gnomon::scan&)>;

/// The number of headings in one turn in which a model is the same, by the name of the model; 0 if
/// it is the same in all.
using equal_headings = std::map<std::string, int>;

/// By rays at each model, turned and not turned.
[[nodiscard]] equal_headings equal_headings_of(const std::vector<sim::furniture_model>& models);

/// The difference of a found pose from the true one.
struct pose_error {
    double distance = 0.0;  ///< of the origins [m]
    double angle = 0.0;     ///< of heading and tilt [rad]
    /// The squared error of place and heading in stated deviations, per degree of freedom, if the
    /// points determine these; the heading is not counted where it makes no difference.
    std::optional<double> nees = std::nullopt;

    /// Within 2 cm and 2 degrees.
    [[nodiscard]] bool is_small() const {
        return distance <= 0.02 && angle <= gnomon::degrees(2).radians();
    }
};

/// @param headings  in which the model is the same, 0 for all
[[nodiscard]] pose_error error_of(const gnomon::alignment& found, const sim::pose& truth,
                                  int headings);

/// The judgement of some rooms.
struct judgement {
    std::size_t objects = 0;  ///< in the rooms, of `fewest_points` and more
    std::size_t found = 0;    ///< of these
    /// Of these: some group has 80 % of its points that are in any group, and 80 % of the points of
    /// the group are its.
    std::size_t whole = 0;
    std::size_t decided = 0;  ///< found objects that are no background, of probability P_d and more
    std::size_t right = 0;    ///< of these: of the name of the object that most points are of
    std::size_t views = 0;    ///< all found objects and background
    std::size_t right_views = 0;         ///< of these: right, or background that is not decided
    std::vector<pose_error> poses = {};  ///< of right objects of 200 points and more, if found

    void add(const judgement& more);
    [[nodiscard]] double recall() const { return share(found, objects); }
    [[nodiscard]] double precision() const { return share(right, decided); }
    [[nodiscard]] double accuracy() const { return share(right_views, views); }
    [[nodiscard]] double wholeness() const { return share(whole, objects); }
    [[nodiscard]] double share_of_right_poses() const {
        return share(static_cast<std::size_t>(std::ranges::count_if(poses, &pose_error::is_small)),
                     poses.size());
    }
    /// Of the poses that are right and that points determine: no covariance covers a place on the
    /// next slat.
    [[nodiscard]] std::vector<double> nees() const {
        std::vector<double> of_poses;
        for (const pose_error& e : poses)
            if (e.is_small() && e.nees) of_poses.push_back(*e.nees);
        return of_poses;
    }

  private:
    /// 1 of none.
    [[nodiscard]] static double share(std::size_t part, std::size_t all) {
        return all == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(all);
    }
};

/// Judges what was found in a room. A second right object on the same piece is wrong.
/// @param min_probability  P_d
[[nodiscard]] judgement judgement_of(const seen_room& room, std::vector<found_object> found,
                                     const equal_headings& headings, double min_probability = 0.90);

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Votes for places of objects, and the places at which most of them agree: the result of
/// `part_votes`.
///
/// In no umbrella: include it by name.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/recognition/detail/part_place.hpp>

namespace gnomon::recognition {

/// A place at which an object may stand.
struct object_place {
    std::size_t object = 0;  ///< its number
    rigid_motion pose;       ///< of the object's frame in that of the scan
    double votes = 0.0;      ///< the sum of the votes, at most one of each part
};

/// How parts vote; chosen on furnished_room() with clutter, seeds 1 to 12.
struct part_votes_options {
    std::size_t nearest = 10;    ///< learned parts of each object by which a part votes
    double likeness = 0.3;       ///< standard deviation of the distance of features of one part
    double max_distance = 0.9;   ///< of features; parts that differ more do not vote
    double reach = 0.10;         ///< standard deviation of the place of a vote [m]
    angle turn = degrees(15.0);  ///< that of its heading
    double min_votes = 0.3;      ///< of a place
    std::size_t most = 12;       ///< places of an object, those of most votes

    /// @throws std::invalid_argument  unless numbers are positive, deviations positive and finite,
    ///                                and max_distance and min_votes not negative
    void require_valid() const {
        using gnomon::detail::require;
        require(nearest > 0 && most > 0, "part_votes: requires a part and a place");
        for (const double x : {likeness, reach, turn.radians()})
            require(x > 0.0 && std::isfinite(x), "part_votes: deviations must be positive");
        require(max_distance >= 0.0 && min_votes >= 0.0,
                "part_votes: max_distance and min_votes must not be negative or NaN");
    }
};

/// Votes of parts, on the ground below the first of them.
class cast_votes {
  public:
    /// No votes yet, for objects with numbers below `objects`.
    /// @throws std::invalid_argument  for options that are not valid
    cast_votes(const part_votes_options& options, std::size_t objects)
        : options_(options), votes_(objects) {
        options.require_valid();
    }

    /// Begins a further part, whose votes are the next ones.
    /// @return the frame of the ground, in which places are
    const rigid_motion& begin_part(const plane& ground, const Eigen::Vector3d& centroid) {
        if (parts_ == 0) ground_ = detail::ground_motion(ground, centroid);
        ++parts_;
        return ground_;
    }

    /// Adds a vote of the part that was begun. Preconditions: there is one, `object` is below the
    /// number of objects, and place, heading and weight are finite.
    /// @param object   its number
    /// @param x, y     of the object's frame on the ground [m]
    /// @param heading  of the object [rad]
    void add(std::size_t object, double x, double y, double heading, double weight) {
        votes_[object].push_back({x, y, heading, weight, parts_ - 1, std::floor(x / farthest())});
    }

    /// The sum of the votes for an object at a pose in the scan, at most one of each part; 0 for an
    /// object without votes. Precondition: the pose is a rigid motion. O(v) for v votes.
    [[nodiscard]] double at(std::size_t object, const rigid_motion& pose) const {
        if (object >= votes_.size()) return 0.0;
        const Eigen::Vector3d place = ground_.point_in(pose.position);
        const Eigen::Vector3d ahead =
            ground_.direction_in(gnomon::detail::column(pose.rotation, 0));
        const vote here{place.x(), place.y(), std::atan2(ahead.y(), ahead.x()), 0.0, 0, 0.0};
        std::vector<double> of_part(parts_, 0.0);
        add_votes(votes_[object], here, of_part);
        return taken_sum(of_part);
    }

    /// The places at which most votes agree.
    /// @param run  `sequential{}` or `threads{n}`; the result does not depend on it
    /// @return of each object those of most votes first
    /// Complexity: O(v (log v + w + p)) for the v votes of each object, w of which are near one of
    /// them, and p parts.
    template <execution X = sequential>
    [[nodiscard]] std::vector<object_place> places(const X& run = {}) const {
        std::vector<std::vector<object_place>> of_object(votes_.size());
        run(votes_.size(), [&](std::size_t o) { of_object[o] = maxima_of(o); });
        std::vector<object_place> places;
        for (const auto& some : of_object) places.insert(places.end(), some.begin(), some.end());
        return places;
    }

  private:
    struct vote {
        double x, y, heading, weight;
        std::uint32_t part;
        double strip;  // the number of the strip along y that it is in, x / farthest()
    };

    static constexpr double most_deviations = 3.0;  // chosen: farther votes agree by 1 % at most

    /// The largest distance of two votes that agree [m].
    [[nodiscard]] double farthest() const {
        constexpr double rounding = 1e-9;  // numerical: of distances
        return (1.0 + rounding) * most_deviations * options_.reach;
    }

    /// Adds some votes for a place to those of each part.
    void add_votes(std::span<const vote> votes, const vote& place,
                   std::vector<double>& of_part) const {
        for (const vote& v : votes) of_part[v.part] += v.weight * agreement(place, v);
    }
    /// The sum of the votes of all parts, at most one of each, which become zero.
    [[nodiscard]] static double taken_sum(std::vector<double>& of_part) {
        double sum = 0.0;
        for (double& one : of_part) {
            sum += std::min(one, 1.0);
            one = 0.0;
        }
        return sum;
    }

    /// std::remainder(x, full turn): headings rarely differ by more than one and a half turns, and
    /// below that one subtraction, which is exact, gives the same value.
    [[nodiscard]] static double shortest_turn(double x) {
        constexpr double half = std::numbers::pi, full = 2.0 * half;
        if (std::abs(x) <= half) return x;
        if (std::abs(x) < half + full) return x > 0.0 ? x - full : x + full;
        return std::remainder(x, full);
    }

    /// How much two votes agree, from 0 to 1.
    [[nodiscard]] double agreement(const vote& a, const vote& b) const {
        const double deviation = options_.reach, turn = options_.turn.radians();
        const double dx = (a.x - b.x) / deviation, dy = (a.y - b.y) / deviation;
        const double across = dx * dx + dy * dy;
        constexpr double most = most_deviations * most_deviations;
        if (across > most) return 0.0;
        const double dh = shortest_turn(a.heading - b.heading) / turn;
        const double sum = across + dh * dh;
        return sum > most ? 0.0 : std::exp(-0.5 * sum);
    }

    /// The places of an object at which most votes agree.
    [[nodiscard]] std::vector<object_place> maxima_of(std::size_t object) const {
        std::vector<vote> votes = votes_[object];
        std::stable_sort(votes.begin(), votes.end(), [](const vote& a, const vote& b) {
            return std::pair(a.strip, a.y) < std::pair(b.strip, b.y);
        });
        const auto first_from = [&](double strip, double y) {
            return std::partition_point(votes.cbegin(), votes.cend(), [&](const vote& v) {
                return std::pair(v.strip, v.y) < std::pair(strip, y);
            });
        };
        std::vector<double> of_part(parts_, 0.0);
        std::vector<std::pair<double, std::size_t>> sums;
        for (std::size_t i = 0; i < votes.size(); ++i) {
            const vote& own = votes[i];
            const std::array strips{own.strip - 1.0, own.strip, own.strip + 1.0};
            for (std::size_t k = 0; k < strips.size(); ++k) {
                if (k > 0 && strips[k] == strips[k - 1]) continue;  // numbers above 2^53
                add_votes({first_from(strips[k], own.y - farthest()),
                           first_from(strips[k], own.y + farthest())},
                          own, of_part);
            }
            sums.emplace_back(-taken_sum(of_part), i);
        }
        std::sort(sums.begin(), sums.end());
        std::vector<object_place> places;
        std::vector<std::size_t> taken;
        for (const auto& of_vote : sums) {
            const double sum = of_vote.first;
            const std::size_t i = of_vote.second;  // clang 14 captures no binding
            if (-sum < options_.min_votes || taken.size() == options_.most) break;
            constexpr double same = 0.1;  // chosen: two deviations
            if (std::any_of(taken.begin(), taken.end(),
                            [&](std::size_t j) { return agreement(votes[i], votes[j]) > same; }))
                continue;
            taken.push_back(i);
            places.push_back({object,
                              ground_ * rigid_motion::on_ground(votes[i].x, votes[i].y,
                                                                radians(votes[i].heading)),
                              -sum});
        }
        return places;
    }

    part_votes_options options_;
    std::vector<std::vector<vote>> votes_;  // of each object
    rigid_motion ground_;
    std::uint32_t parts_ = 0;
};

}  // namespace gnomon::recognition

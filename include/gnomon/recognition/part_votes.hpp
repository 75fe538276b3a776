// SPDX-License-Identifier: BSL-1.0
/// @file
/// Parts vote for objects and their places: each part of a scan votes where the objects should
/// stand of which it was learned as a part. Places of many votes are hypotheses, before anything is
/// grouped: objects that touch, or that are half hidden, have a place each. An implicit shape model
/// (Leibe, Leonardis and Schiele 2004) of surfaces instead of patches of images.
///
///     namespace rec = gnomon::recognition;
///     rec::part_votes votes;
///     votes.learn(view, pose, chair);  // views of objects whose poses are known
///     for (const rec::object_place& p : votes.places(views)) use(p.object, p.pose, p.votes);
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
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/recognition/detail/part_place.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/weighted_distance.hpp>

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

    /// @throws std::invalid_argument  unless all are positive and finite, and max_distance and
    ///                                min_votes not negative
    void require_valid() const {
        using gnomon::detail::require;
        require(nearest > 0 && most > 0, "part_votes: requires a part and a place");
        for (const double x : {likeness, reach, turn.radians()})
            require(x > 0.0 && std::isfinite(x), "part_votes: deviations must be positive");
        require(max_distance >= 0.0 && min_votes >= 0.0,
                "part_votes: max_distance and min_votes must not be negative or NaN");
    }
};

/// Learns where parts are in objects, and votes. Objects stand upright on the ground.
template <class Features = std::remove_cv_t<decltype(default_features)>>
class part_votes {
  public:
    static constexpr std::size_t features_per_part = feature_count<Features>;
    /// A part that was learned, and where its object is, seen from it.
    struct sample {
        std::array<double, features_per_part> features;  ///< divided by their scales
        std::uint32_t object = 0;                        ///< its number
        double ahead = 0.0, left = 0.0;  ///< of the heading of the part, of the object's frame [m]
        double turn = 0.0;               ///< heading of the object less that of the part [rad]
    };

    /// @throws std::invalid_argument  for options that are not valid, or weights that are all 0
    explicit part_votes(part_votes_options options = {}, Features features = default_features)
        : options_(options), features_(std::move(features)) {
        options.require_valid();
        weighted_distance<features_per_part>{feature_weights(features_)}.require_weights();
    }

    /// Learns the parts of a view of an object.
    /// @param pose    of the object's frame in that of the scan
    /// @param object  its number, below 1,000,000: votes of all smaller numbers are counted, too
    /// @throws std::invalid_argument  if the view has no ground, the pose is no rigid motion, the
    ///                                number is too large, or a feature or a place is not finite;
    ///                                nothing is learned then
    void learn(const view& v, const rigid_motion& pose, std::size_t object) {
        constexpr std::size_t most_objects = 1'000'000;  // performance only
        gnomon::detail::require(object < most_objects,
                                "part_votes: the number of an object is too large");
        gnomon::detail::require(v.ground.has_value(), "part_votes: a view needs a ground");
        gnomon::detail::require(is_rigid(pose), "part_votes: the pose is no rigid motion");
        const rigid_motion ground = detail::ground_motion(*v.ground, pose.position);
        const Eigen::Vector3d ahead = ground.direction_in(gnomon::detail::column(pose.rotation, 0));
        const double heading = std::atan2(ahead.y(), ahead.x());
        const Eigen::Vector3d at = ground.point_in(pose.position);
        std::vector<sample> learned;
        for (const part& p : v.parts) {
            const detail::part_place place(p, ground);
            const double c = std::cos(place.heading), s = std::sin(place.heading);
            const double x = at.x() - place.at.x(), y = at.y() - place.at.y();
            learned.push_back({feature_vector(features_, p, v), static_cast<std::uint32_t>(object),
                               c * x + s * y, c * y - s * x, heading - place.heading});
        }
        if (!learned.empty()) objects_ = std::max(objects_, object + 1);
        samples_.insert(samples_.end(), learned.begin(), learned.end());
    }

    /// The parts that were learned, in their sequence.
    [[nodiscard]] const std::vector<sample>& samples() const { return samples_; }

    /// The places of objects by the votes of the parts of all views.
    /// @return of each object those of most votes first
    /// @throws std::invalid_argument  if a view has no ground, or a feature or place is not finite
    /// Complexity: O(p s) for p parts and s samples.
    [[nodiscard]] std::vector<object_place> places(std::span<const view> views) const {
        std::vector<std::vector<vote>> votes(objects_);
        std::uint32_t number = 0;
        rigid_motion ground;
        bool has_ground = false;
        for (const view& v : views) {
            gnomon::detail::require(v.ground.has_value(), "part_votes: a view needs a ground");
            for (const part& p : v.parts) {
                if (!has_ground) ground = detail::ground_motion(*v.ground, p.shape.frame.centroid);
                has_ground = true;
                cast(p, v, ground, number++, votes);
            }
        }
        std::vector<object_place> places;
        for (std::size_t o = 0; o < votes.size(); ++o)
            maxima_of(votes[o], o, number, ground, places);
        return places;
    }

  private:
    struct vote {
        double x, y, heading, weight;
        std::uint32_t part;
    };

    /// The votes of one part, by the samples that are most like it.
    void cast(const part& p, const view& v, const rigid_motion& ground, std::uint32_t number,
              std::vector<std::vector<vote>>& votes) const {
        const auto f = feature_vector(features_, p, v);
        const weighted_distance<features_per_part> distance{feature_weights(features_)};
        std::vector<std::vector<std::pair<double, std::size_t>>> alike(objects_);
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const double d = distance(f, samples_[i].features);
            if (d <= options_.max_distance) alike[samples_[i].object].emplace_back(d, i);
        }
        const detail::part_place place(p, ground);
        for (std::size_t o = 0; o < objects_; ++o) {
            auto& of_object = alike[o];
            const std::size_t n = std::min(of_object.size(), options_.nearest);
            std::partial_sort(of_object.begin(), of_object.begin() + static_cast<std::ptrdiff_t>(n),
                              of_object.end());
            for (std::size_t k = 0; k < n; ++k) {
                const sample& s = samples_[of_object[k].second];
                const double d = of_object[k].first / options_.likeness;
                const double weight =
                    std::exp(-0.5 * d * d) / static_cast<double>(options_.nearest);
                for (int t = 0; t < place.headings; ++t) {
                    const double turned =
                        place.heading + 2.0 * std::numbers::pi * t / place.headings;
                    const double c = std::cos(turned), w = std::sin(turned);
                    votes[o].push_back({place.at.x() + c * s.ahead - w * s.left,
                                        place.at.y() + w * s.ahead + c * s.left, turned + s.turn,
                                        weight, number});
                }
            }
        }
    }

    /// How much two votes agree, from 0 to 1.
    [[nodiscard]] double agreement(const vote& a, const vote& b) const {
        const double reach = options_.reach, turn = options_.turn.radians();
        const double dx = (a.x - b.x) / reach, dy = (a.y - b.y) / reach;
        const double across = dx * dx + dy * dy;
        constexpr double most = 9.0;  // performance only: three deviations
        if (across > most) return 0.0;
        const double dh = std::remainder(a.heading - b.heading, 2.0 * std::numbers::pi) / turn;
        const double sum = across + dh * dh;
        return sum > most ? 0.0 : std::exp(-0.5 * sum);
    }

    /// Adds the places at which most votes agree.
    void maxima_of(const std::vector<vote>& votes, std::size_t object, std::size_t parts,
                   const rigid_motion& ground, std::vector<object_place>& places) const {
        std::vector<std::pair<double, std::size_t>> sums;
        std::vector<double> of_part(parts);
        for (std::size_t i = 0; i < votes.size(); ++i) {
            std::ranges::fill(of_part, 0.0);
            for (const vote& v : votes) of_part[v.part] += v.weight * agreement(votes[i], v);
            double sum = 0.0;
            for (const double x : of_part) sum += std::min(x, 1.0);
            sums.emplace_back(-sum, i);
        }
        std::ranges::sort(sums);
        std::vector<std::size_t> taken;
        for (const auto& of_vote : sums) {
            const double sum = of_vote.first;
            const std::size_t i = of_vote.second;  // clang 14 captures no binding
            if (-sum < options_.min_votes || taken.size() == options_.most) break;
            constexpr double same = 0.1;  // chosen: two deviations
            if (std::ranges::any_of(
                    taken, [&](std::size_t j) { return agreement(votes[i], votes[j]) > same; }))
                continue;
            taken.push_back(i);
            places.push_back({object,
                              ground * rigid_motion::on_ground(votes[i].x, votes[i].y,
                                                               radians(votes[i].heading)),
                              -sum});
        }
    }

    part_votes_options options_;
    Features features_;
    std::vector<sample> samples_;
    std::size_t objects_ = 0;
};

}  // namespace gnomon::recognition

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

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/detail/part_place.hpp>
#include <gnomon/recognition/part_feature.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/weighted_distance.hpp>

namespace gnomon::recognition {

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

    /// Nothing is learned yet.
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

    /// The votes of the parts of all views of one scan. Places are on the ground of the first view.
    /// @param run  `sequential{}` or `threads{n}`; the result does not depend on it
    /// @throws std::invalid_argument  if a view has no ground, or a feature or place is not finite
    /// Complexity: O(p s) for p parts and s samples.
    template <execution X = sequential>
    [[nodiscard]] cast_votes votes(std::span<const view> views, const X& run = {}) const {
        std::vector<std::pair<const part*, const view*>> parts;
        for (const view& v : views) {
            gnomon::detail::require(v.ground.has_value(), "part_votes: a view needs a ground");
            for (const part& p : v.parts) parts.emplace_back(&p, &v);
        }
        std::vector<std::vector<alike>> nearest(parts.size());
        run(parts.size(),
            [&](std::size_t i) { nearest[i] = nearest_to(*parts[i].first, *parts[i].second); });
        cast_votes all(options_, objects_);
        for (std::size_t i = 0; i < parts.size(); ++i)
            cast(*parts[i].first, *parts[i].second->ground, nearest[i], all);
        return all;
    }

    /// The places of most votes: `votes(views, run).places(run)`, with its errors and complexity.
    template <execution X = sequential>
    [[nodiscard]] std::vector<object_place> places(std::span<const view> views,
                                                   const X& run = {}) const {
        return votes(views, run).places(run);
    }

  private:
    struct alike {
        double distance;  ///< of features
        std::size_t sample;

        friend bool operator<(const alike& a, const alike& b) {
            return a.distance != b.distance ? a.distance < b.distance : a.sample < b.sample;
        }
    };

    /// The samples that are most like a part, of each object the nearest ones, nearest first.
    [[nodiscard]] std::vector<alike> nearest_to(const part& p, const view& v) const {
        const auto f = feature_vector(features_, p, v);
        const weighted_distance<features_per_part> distance{feature_weights(features_)};
        std::vector<std::vector<alike>> of_object(objects_);
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const double d = distance(f, samples_[i].features);
            if (d <= options_.max_distance) of_object[samples_[i].object].push_back({d, i});
        }
        std::vector<alike> all;
        for (auto& some : of_object) {
            const auto n = static_cast<std::ptrdiff_t>(std::min(some.size(), options_.nearest));
            std::partial_sort(some.begin(), some.begin() + n, some.end());
            all.insert(all.end(), some.begin(), some.begin() + n);
        }
        return all;
    }

    /// The votes of one part.
    void cast(const part& p, const plane& ground, const std::vector<alike>& nearest,
              cast_votes& all) const {
        const detail::part_place place(p, all.begin_part(ground, p.shape.frame.centroid));
        for (const alike& q : nearest) {
            const sample& s = samples_[q.sample];
            const double d = q.distance / options_.likeness;
            const double weight = std::exp(-0.5 * d * d) / static_cast<double>(options_.nearest);
            for (int t = 0; t < place.headings; ++t) {
                const double turned = place.heading + 2.0 * std::numbers::pi * t / place.headings;
                const double c = std::cos(turned), w = std::sin(turned);
                all.add(s.object, place.at.x() + c * s.ahead - w * s.left,
                        place.at.y() + w * s.ahead + c * s.left, turned + s.turn, weight);
            }
        }
    }

    part_votes_options options_;
    Features features_;
    std::vector<sample> samples_;
    std::size_t objects_ = 0;
};

}  // namespace gnomon::recognition

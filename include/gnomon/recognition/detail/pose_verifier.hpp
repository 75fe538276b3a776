// SPDX-License-Identifier: BSL-1.0
/// @file
/// The counts of `verify_pose`.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/recognition/detail/points_in_bounds.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/verification.hpp>
#include <gnomon/recognition/wall.hpp>

namespace gnomon::recognition::detail {

/// All points are to be explained.
inline constexpr auto all_points = [](point_index) { return true; };

/// Compares one object at one pose with one scan.
class pose_verifier {
  public:
    /// Keeps references to all arguments.
    /// @throws std::invalid_argument  if the pose is no rigid motion, or the options are not valid
    pose_verifier(const spatial_index& index, const visibility& seen, const surface_model& model,
                  const rigid_motion& pose, const verification_options& options)
        : index_(index),
          images_(seen.images()),
          pixel_(seen.pixel().radians()),
          model_(model),
          pose_(pose),
          options_(options),
          least_cosine_(cos(options.max_angle)) {
        options.require_valid();
        gnomon::detail::require(is_rigid(pose), "verify_pose: the pose is no rigid motion");
        for (const wall& w : options.walls)
            if (is_in_front_of(w)) walls_.push_back(&w);
    }

    /// @param normal_of  (i): the normal of point i of the scan; zero if it is missing
    /// @param is_left   (i): whether point i is to be explained
    [[nodiscard]] verification operator()(const auto& normal_of, const auto& is_left) {
        (void)count_samples(normal_of, [](const verification&, std::size_t) { return false; });
        count_points(is_left);
        return counts_;
    }

    /// Counts the samples.
    /// @param stops  (counts, left): whether to stop before the last `left` of them
    /// @return whether it was not stopped
    [[nodiscard]] bool count_samples(const auto& normal_of, const auto& stops) {
        const std::size_t n = model_.points().size();
        const std::size_t tested = std::min(n, options_.most);
        counts_.samples = tested;
        for (std::size_t s = 0; s < tested; ++s) {
            const std::size_t i = s * n / tested;
            count_sample(pose_.point_out(model_.points()[i]),
                         pose_.direction_out(model_.normals()[i].normal), normal_of);
            if (stops(counts_, tested - s - 1)) return false;
        }
        return true;
    }

    /// Counts the points within the bounds of the object, and near its surface, again.
    /// @param is_left  (i): whether point i is to be explained
    void count_points(const auto& is_left) {
        counts_.points = counts_.explained = counts_.near_surface = counts_.on_surface = 0;
        if (model_.points().size() > 0) count_left(is_left);
    }

    [[nodiscard]] const verification& counts() const { return counts_; }

  private:
    /// Counts a sample that faces a view point by the strongest observation from any of these.
    void count_sample(const Eigen::Vector3d& at, const Eigen::Vector3d& normal,
                      const auto& normal_of) {
        constexpr double least_facing = 0.1;  // chosen: cosine; rays at 84 degrees are unreliable
        std::array<bool, 5> seen{};
        bool in_wall = false;
        for (const range_image& image : images_) {
            const Eigen::Vector3d way = gnomon::detail::difference(at, image.viewpoint());
            const double range = gnomon::detail::length(way);
            const double facing = -gnomon::detail::dot(way, normal);
            if (!(facing > least_facing * range)) continue;
            const double noise = noise_along(way);
            if (is_supported(at, normal, facing / range, range, noise, normal_of)) {
                ++counts_.facing;
                ++counts_.supported;
                return;
            }
            const observation here = observed(at, range, noise, image);
            seen[static_cast<std::size_t>(here)] = true;
            in_wall = in_wall || (here == observation::occluded && is_in_wall(at, image));
        }
        const auto is_seen = [&](observation o) { return seen[static_cast<std::size_t>(o)]; };
        std::size_t* count = is_seen(observation::free_space)   ? &counts_.seen_through
                             : is_seen(observation::on_surface) ? &counts_.mismatched
                             : in_wall                          ? &counts_.in_walls
                             : is_seen(observation::occluded)   ? &counts_.hidden
                             : is_seen(observation::unobserved) ? &counts_.unobserved
                                                                : nullptr;
        if (count == nullptr) return;
        ++counts_.facing;
        ++*count;
    }

    /// Whether a hidden sample is behind a wall: one view point sees the wall in front of it, or
    /// something in front of the wall.
    [[nodiscard]] bool is_in_wall(const Eigen::Vector3d& at, const range_image& image) const {
        return std::ranges::any_of(walls_, [&](const wall* w) {
            const Eigen::Vector3d foot = w->foot_of(at);
            const Eigen::Vector3d way = gnomon::detail::difference(foot, image.viewpoint());
            const double noise = noise_along(way);
            if (!w->is_before(at, options_.tolerance + noise)) return false;
            const observation there = observed(foot, gnomon::detail::length(way), noise, image);
            return there == observation::on_surface || there == observation::occluded;
        });
    }

    /// Whether the bounds of the object reach to the front of a wall: those of an object in the
    /// next room, seen through an opening, do not.
    [[nodiscard]] bool is_in_front_of(const wall& w) const {
        constexpr double clearly = 0.05;  // [m]; chosen: poses of alignments are less wrong
        using gnomon::detail::combined;
        const Eigen::Vector3d normal = pose_.direction_in(w.surface.normal);
        const Eigen::Vector3d middle = combined(0.5, model_.low(), 0.5, model_.high());
        const Eigen::Vector3d half = combined(0.5, model_.high(), -0.5, model_.low());
        return w.surface.signed_distance(pose_.point_out(middle)) +
                   gnomon::detail::dot(normal.cwiseAbs(), half) >
               clearly;
    }

    /// Three deviations of the noise along a ray [m].
    [[nodiscard]] double noise_along(const Eigen::Vector3d& way) const {
        constexpr double deviations = 3.0;  // 99.7 % of a normal distribution
        return deviations * options_.noise.along(way);
    }

    /// Whether a point of the scan is on the surface at a sample.
    [[nodiscard]] bool is_supported(const Eigen::Vector3d& at, const Eigen::Vector3d& normal,
                                    double facing, double range, double noise,
                                    const auto& normal_of) {
        constexpr double spacings = 1.5;      // chosen: rays are not spaced evenly
        constexpr double most_oblique = 0.3;  // chosen: rays spread by 3 at most
        constexpr std::size_t few = 6;        // chosen: the nearest one may be of another face
        const double between = range * pixel_ / std::max(facing, most_oblique);
        const double across = options_.tolerance + facing * noise;
        const double reach = std::max(across, spacings * between);
        index_.nearest_within_into(found_, at, few, reach);
        return std::any_of(found_.begin(), found_.end(), [&](const neighbor& q) {
            const Eigen::Vector3d n = normal_of(q.index);
            const double off =
                gnomon::detail::dot(normal, gnomon::detail::difference(index_[q.index], at));
            return std::abs(off) <= across &&
                   (is_missing(n) || !(std::abs(gnomon::detail::dot(n, normal)) < least_cosine_));
        });
    }

    /// What one view point observed towards a sample: clearly, not at an edge.
    [[nodiscard]] observation observed(const Eigen::Vector3d& at, double range, double noise,
                                       const range_image& image) const {
        if (!image.may_show(at)) return observation::unobserved;
        const double margin = options_.tolerance + noise + range * pixel_;
        const auto [azimuth, elevation] = image.pixel_of(at);
        observation_count count;
        for (std::size_t e = elevation - std::min<std::size_t>(elevation, 1);
             e <= std::min(elevation + 1, image.height() - 1); ++e) {
            for (std::size_t a = azimuth + image.width() - 1; a <= azimuth + image.width() + 1;
                 ++a) {
                const double r = image.range({a % image.width(), e});
                count.add(r < 0.0              ? observation::unobserved
                          : r < range - margin ? observation::occluded
                          : r > range + margin ? observation::free_space
                                               : observation::on_surface);
            }
        }
        if (count[observation::on_surface] > 0) return observation::on_surface;
        const bool is_free = count[observation::free_space] > 0;
        const bool is_hidden = count[observation::occluded] > 0;
        if (is_free == is_hidden) return observation::unobserved;
        return is_free ? observation::free_space : observation::occluded;
    }

    void count_left(const auto& is_left) {
        using gnomon::detail::combined;
        const Eigen::Vector3d middle =
            pose_.point_out(combined(0.5, model_.low(), 0.5, model_.high()));
        double noise = 0.0;  // of the view point with most
        for (const range_image& image : images_)
            noise =
                std::max(noise, noise_along(gnomon::detail::difference(middle, image.viewpoint())));
        const double reach = model_.spacing() + options_.tolerance + noise;
        const double around = reach + options_.around;
        Eigen::Vector3d low = model_.low() - Eigen::Vector3d::Constant(around);
        low.z() = std::max(low.z(), options_.lowest);
        inside_.clear();
        for_each_point_in(index_, pose_, low, model_.high() + Eigen::Vector3d::Constant(around),
                          [&](point_index i, const Eigen::Vector3d& x) {
                              if (is_left(i)) inside_.push_back(x);
                          });
        const std::size_t tested = std::min(inside_.size(), options_.most);
        for (std::size_t k = 0; k < tested; ++k) {
            const Eigen::Vector3d& x = inside_[k * inside_.size() / tested];
            model_.points().nearest_within_into(found_, x, 1, around);
            const bool is_on = !found_.empty() && found_.front().squared_distance <= reach * reach;
            counts_.near_surface += found_.empty() ? 0 : 1;
            counts_.on_surface += is_on ? 1 : 0;
            if (!is_in_bounds(x)) continue;
            ++counts_.points;
            counts_.explained += is_on ? 1 : 0;
        }
    }

    [[nodiscard]] bool is_in_bounds(const Eigen::Vector3d& x) const {
        const double margin = options_.tolerance;
        return (model_.low().array() - margin <= x.array()).all() &&
               (x.array() <= model_.high().array() + margin).all();
    }

    const spatial_index& index_;
    std::span<const range_image> images_;
    double pixel_;
    const surface_model& model_;
    const rigid_motion& pose_;
    const verification_options& options_;
    double least_cosine_;
    std::vector<const wall*> walls_;  // those in which the object may stand
    verification counts_;
    std::vector<neighbor> found_;
    std::vector<Eigen::Vector3d> inside_;
};

}  // namespace gnomon::recognition::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The iterations of `align_to_surface`, and the covariance of their result.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/features/detail/motion_equations.hpp>
#include <gnomon/features/detail/movable_cloud.hpp>
#include <gnomon/features/detail/surface_matches.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// The rotation by a rotation vector (Rodrigues).
[[nodiscard]] inline Eigen::Matrix3d rotation_of(const Eigen::Vector3d& w) {
    const double turn = length(w);
    Eigen::Matrix3d r = diagonal(1.0, 1.0, 1.0);
    if (!(turn > 0.0)) return r;
    const Eigen::Vector3d axis = scaled(1.0 / turn, w);
    const double c = std::cos(turn), s = std::sin(turn);
    for (int j = 0; j < 3; ++j) {
        Eigen::Vector3d e(0.0, 0.0, 0.0);
        e[j] = 1.0;
        const Eigen::Vector3d turned = combined(c, e, s, cross(axis, e), (1.0 - c) * axis[j], axis);
        for (int i = 0; i < 3; ++i) r(i, j) = turned[i];
    }
    return r;
}

/// The alignment of points of one cloud, or of a sample of them.
template <class Normals, execution X>
class surface_alignment {
  public:
    /// Keeps references to all arguments.
    /// @param lever     unit of turns: a turn by 1 moves the points by this on average [m]
    /// @param rounding  of coordinates [m]
    surface_alignment(std::span<const movable_point> points,
                      const matched_surface<Normals>& surface, double lever, double rounding,
                      const alignment_options& options, const X& run)
        : points_(points),
          surface_(surface),
          options_(options),
          lever_(lever),
          rounding_(rounding),
          run_(run),
          lists_(points.size()),
          terms_(points.size()) {}

    /// Moves the pose of the centered points from `pose` on.
    /// @param limit  between corresponding points at first [m]
    void align(rigid_motion& pose, double limit, alignment& result) {
        result.status = alignment::outcome::not_converged;
        double width = limit;  // of the weights [m], at least; then that of the noise
        for (result.iterations = 1; result.iterations <= options_.max_iterations;
             ++result.iterations) {
            // Points between two samples would come and go without end.
            constexpr int choosing = 15;  // chosen: iterations, as 10 are the rule
            set_terms(pose, std::max(limit, options_.last_distance), result.iterations > choosing);
            if (count_ <= (options_.on_ground ? 3u : 6u)) {
                result.status = alignment::outcome::too_few_points;
                break;
            }
            sum_terms(width);
            const motion_solution solution(sums_, scale_, options_);
            const auto step = solution.step(options_.max_distance);
            constexpr double negligible = 0.01;  // chosen: a tenth of a deviation
            if (width == 0.0 && step.gain <= negligible * scale_ * scale_) {
                result.status = alignment::outcome::converged;
                break;
            }
            pose.rotation = (rigid_motion{rotation_of(scaled(1.0 / lever_, step.turn)), {0, 0, 0}} *
                             rigid_motion{pose.rotation, {0, 0, 0}})
                                .rotation;
            pose.position = combined(1.0, pose.position, 1.0, step.shift);
            // Where most points are on surfaces that slide on themselves, the median is small while
            // the others are far off: weights that start narrow would leave these out for good.
            constexpr double shrink = 0.5;  // chosen: 5 iterations from 10 cm to 3 mm
            constexpr double narrow = 0.1;  // chosen: of the last distance
            limit *= shrink;
            width = limit < narrow * options_.last_distance ? 0.0 : limit;
        }
        result.iterations = std::min(result.iterations, options_.max_iterations);
    }

    /// Reports the last iteration.
    void report(alignment& result, std::size_t samples) {
        const bool has_equations = result.status != alignment::outcome::too_few_points;
        if (!has_equations) sums_ = {};
        const motion_solution solution(sums_, scale_, options_);
        result.determined = solution.determined();
        if (has_equations) {
            double squares = 0.0;
            for (const motion_term& t : terms_) {
                if (!(t.weight > 0.0)) continue;
                ++result.inliers;
                squares += t.distance * t.distance;
            }
            if (result.inliers > 0)
                result.rms = std::sqrt(squares / static_cast<double>(result.inliers));
            if (result.determined < (options_.on_ground ? 3u : 6u))
                result.status = alignment::outcome::degenerate;
        }
        const auto c = solution.covariance(noise_of_terms(terms_, samples), shown_variance());
        const auto unit = [&](std::size_t i) { return i < 3 ? lever_ : 1.0; };
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j)
                result.covariance(static_cast<int>(i), static_cast<int>(j)) =
                    c[i][j] / unit(i) / unit(j);
    }

  private:
    /// Matches all points, and finds the scale of their residuals.
    /// @param keep  whether each point keeps its sample
    void set_terms(const rigid_motion& pose, double limit, bool keep) {
        for_each_chunk(run_, points_.size(), [&](std::size_t begin, std::size_t end) {
            std::vector<neighbor> found;
            surface_match m;
            for (std::size_t i = begin; i < end; ++i) {
                const Eigen::Vector3d arm = product(pose.rotation, points_[i].at);
                const Eigen::Vector3d x = combined(1.0, pose.position, 1.0, arm);
                if (!keep) {
                    terms_[i].is_matched =
                        surface_.match(points_[i], x, pose.rotation, limit, lists_[i], found, m);
                } else if (terms_[i].is_matched) {
                    m.entry = terms_[i].entry;
                    surface_.measure(points_[i], x, pose.rotation, lists_[i], m);
                }
                if (terms_[i].is_matched) {
                    terms_[i].set(m, arm, lever_, rounding_, options_);
                } else {
                    terms_[i].weight = 0.0;  // it may have had one before
                }
            }
        });
        residuals_.clear();
        for (const motion_term& t : terms_)
            if (t.is_matched) residuals_.push_back(std::abs(t.residual));
        count_ = residuals_.size();
        if (count_ == 0) return;
        const auto middle = residuals_.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
        std::nth_element(residuals_.begin(), middle, residuals_.end());
        constexpr double of_normal = 0.6745;  // median of |x| of a standard normal distribution
        scale_ = std::max(1.0, *middle / of_normal);
    }

    /// Sums of fixed chunks of the points, so that they do not depend on the threads.
    void sum_terms(double width) {
        scratch<motion_sums> parts(chunk_count(terms_.size()));
        for_each_chunk(run_, terms_.size(), [&](std::size_t begin, std::size_t end) {
            motion_sums sum;
            for (std::size_t i = begin; i < end; ++i) {
                if (terms_[i].is_matched) sum.add(terms_[i], scale_, width);
            }
            parts[begin / chunk_size] = sum;
        });
        sums_ = {};
        for (const motion_sums& part : parts) sums_.add(part);
    }

    /// The variance of residuals, in that of the noise: 1 unless they are significantly larger.
    [[nodiscard]] double shown_variance() const {
        // The median absolute deviation of n normal numbers has this deviation times 1 / sqrt(n).
        constexpr double of_median = 1.17, deviations = 3.0;
        const double most =
            1.0 + deviations * of_median /
                      std::sqrt(static_cast<double>(std::max<std::size_t>(1, count_)));
        return scale_ > most ? scale_ * scale_ : 1.0;
    }

    std::span<const movable_point> points_;
    const matched_surface<Normals>& surface_;
    const alignment_options& options_;
    double lever_, rounding_;
    const X& run_;
    scratch<sample_list> lists_;
    scratch<motion_term> terms_;
    scratch<double> residuals_;
    motion_sums sums_;
    std::size_t count_ = 0;
    double scale_ = 1.0;  // of residuals, in deviations of their noise; at least 1
};

/// Aligns a range of points to a surface.
/// @param normals  (i): the normal of point i, zero or not finite if it is missing
template <class R, class S, class Normals, execution X, class Proj>
[[nodiscard]] alignment aligned(const R& points, auto&& normals, const S& surface,
                                const Normals& surface_normals, const rigid_motion& start,
                                const alignment_options& options, const X& run, Proj projection) {
    options.require_valid();
    require(std::ranges::size(surface_normals) == std::ranges::size(surface),
            "align_to_surface: samples of the surface and normals differ in number");
    require(is_rigid(start), "align_to_surface: the start is no rigid motion");
    const auto& team = staying(run);
    constexpr std::identity as_it_is;  // named: g++ 13 warns of a reference to a temporary
    const auto& index = index_of(surface, team, as_it_is);
    const auto is_near = [&](const Eigen::Vector3d& x) {
        return is_near_surface(index, start.point_out(x), options.max_distance);
    };
    const movable_cloud cloud(points, normals, options.noise, is_near, projection);
    alignment result{.pose = start, .points = cloud.points.size()};
    rigid_motion pose{start.rotation, start.point_out(cloud.centroid)};
    double largest = cloud.largest;
    for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(pose.position[a]));
    constexpr double operations = 4.0;  // numerical: that rounded a coordinate
    constexpr double fine = 1e-9;       // numerical: of the extent of the points
    const double epsilon = std::max(epsilon_of<position_view<R, Proj>>(points), index.epsilon());
    const double rounding = std::hypot(operations * epsilon * largest, fine * cloud.lever);
    const matched_surface<Normals> matched(index, surface_normals, options);
    double limit = options.max_distance;
    if (!cloud.sample.empty()) {
        const sequential here;
        surface_alignment<Normals, sequential> first(cloud.sample, matched, cloud.lever, rounding,
                                                     options, here);
        rigid_motion moved = pose;
        first.align(moved, limit, result);
        if (result.status != alignment::outcome::too_few_points) {
            pose = moved;
            limit = 0.0;
        }
    }
    surface_alignment<Normals, std::remove_cvref_t<decltype(team)>> all(
        cloud.points, matched, cloud.lever, rounding, options, team);
    all.align(pose, limit, result);
    all.report(result, index.size());
    result.center = pose.position;
    result.pose = {pose.rotation,
                   difference(pose.position, product(pose.rotation, cloud.centroid))};
    return result;
}

}  // namespace gnomon::detail

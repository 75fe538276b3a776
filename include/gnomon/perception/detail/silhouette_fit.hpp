// SPDX-License-Identifier: BSL-1.0
/// @file
/// Moves an object whose faces do not determine its pose well, such as a table of which only the
/// top is seen, which slides on itself: to where its silhouette is that of the scan. The alignment
/// counts by its covariance. Or only compares an object at a pose with the scan by its silhouette.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/features/alignment.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/ground_motions.hpp>
#include <gnomon/perception/detail/silhouette_rays.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/surface_model.hpp>

namespace gnomon::recognition::detail {

/// The silhouettes of one object in all images that show it.
class silhouette_fit {
  public:
    /// Parameters as those of silhouette_rays.
    silhouette_fit(const visibility& seen, const imaged_points& points, const noise_curve& noise,
                   angle divergence, const surface_model& model, const rigid_motion& pose) {
        for (const range_image& image : seen.images()) {
            silhouette_rays rays(image, points, seen.pixel().radians(), noise, divergence.radians(),
                                 model, pose);
            if (rays.size() > 0) views_.push_back(std::move(rays));
        }
    }

    [[nodiscard]] bool has_rays() const { return !views_.empty(); }

    /// How they agree with the object at a pose.
    [[nodiscard]] silhouette_match match(const rigid_motion& pose) {
        silhouette_match result;
        silhouette_shares sums;
        for (silhouette_rays& view : views_) {
            result.rays += view.size();
            view.add_shares(pose, sums);
        }
        if (sums.in_any > 0.0) result.overlap = sums.in_both / sums.in_any;
        // Without its floor, a scan has hardly any rays that pass an object.
        constexpr double prior = 5.0;  // rays; chosen on rooms of seeds 541 to 590, of 5 and 20
        result.beyond = (sums.beyond + prior * result.beyond) / (sums.passing + prior);
        return result;
    }

    /// The motion of the least sum of the misfit of the silhouette and of the squared motion in
    /// deviations, by a search along the axes with steps that become smaller.
    /// @param from  where it begins
    [[nodiscard]] ground_motions::motion best(const ground_motions& motions,
                                              const ground_motions::motion& from) {
        constexpr double widest = 0.032, narrowest = 0.002;  // steps [m]; chosen: errors, a tenth
        constexpr double much = 4.0;  // deviations in a step; chosen: it would not pay
        constexpr int rounds = 3;     // of one step; chosen: few need more
        ground_motions::motion best = from;
        double least = cost(motions, best);
        for (double step = widest; step >= narrowest; step *= 0.5) {
            bool is_better = true;
            for (int round = 0; round < rounds && is_better; ++round) {
                is_better = false;
                for (int axis = 0; axis < 3; ++axis) {
                    if (much * std::sqrt(motions.variances()[axis]) < step) continue;
                    for (const double by : {step, -step}) {
                        ground_motions::motion next = best;
                        next[axis] += by;
                        const double c = cost(motions, next);
                        if (!(c < least)) continue;
                        least = c;
                        best = next;
                        is_better = true;
                        break;
                    }
                }
            }
        }
        return best;
    }

    /// Of motions along the axes: the inverse sum of the information of alignment and silhouette.
    [[nodiscard]] Eigen::Matrix3d covariance(const ground_motions& motions,
                                             const ground_motions::motion& at) {
        constexpr double step = 0.01;    // [m]; chosen: a third of a beam at 3 m
        constexpr double least = 1e-12;  // [m^2]; numerical
        Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
        for (int a = 0; a < 3; ++a)
            information(a, a) = 1.0 / std::max(least, motions.variances()[a]);
        for (silhouette_rays& view : views_) {
            std::array<std::vector<double>, 3> slopes;
            for (int a = 0; a < 3; ++a) {
                ground_motions::motion m = at;
                m[a] = at[a] + step;
                (void)view.misfit(motions.pose_after(m), shares_);
                auto& slope = slopes[static_cast<std::size_t>(a)] = shares_;
                m[a] = at[a] - step;
                (void)view.misfit(motions.pose_after(m), shares_);
                for (std::size_t r = 0; r < slope.size(); ++r)
                    slope[r] = (slope[r] - shares_[r]) / (2.0 * step);
            }
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b)
                    for (std::size_t r = 0; r < shares_.size(); ++r)
                        information(a, b) += slopes[static_cast<std::size_t>(a)][r] *
                                             slopes[static_cast<std::size_t>(b)][r] / variance;
        }
        return gnomon::detail::inverse_of_symmetric(information);
    }

  private:
    /// Of the difference of two shares of a ray, which is at most 1: rays next to each other err
    /// together, so that each is worth less.
    static constexpr double variance = 4.0;  // [1]; chosen on rooms of seeds 301 to 370, of .5 to 4

    [[nodiscard]] double cost(const ground_motions& motions, const ground_motions::motion& m) {
        const rigid_motion pose = motions.pose_after(m);
        double sum = 0.0;
        for (silhouette_rays& view : views_) sum += view.misfit(pose, shares_) / variance;
        for (int a = 0; a < 3; ++a)
            if (m[a] != 0.0) sum += m[a] * m[a] / motions.variances()[a];
        return sum;
    }

    std::vector<silhouette_rays> views_;
    std::vector<double> shares_;
};

/// An alignment, moved by its silhouette if the covariance is large. Near the right pose it is
/// clearer which rays hit the object, so that the silhouette of a far one is taken again.
/// @param up  the normal of the ground
[[nodiscard]] inline alignment by_silhouette(const alignment& found, const surface_model& model,
                                             const visibility& seen, const imaged_points& points,
                                             const noise_curve& noise, angle divergence,
                                             const Eigen::Vector3d& up) {
    constexpr double known = 0.004;  // deviation [m]; chosen: silhouettes resolve 2 cm
    constexpr double still = 0.01;   // [m]; chosen: a third of a beam at 3 m
    constexpr int most = 3;          // chosen: of far starts the second one is near
    const ground_motions motions(found, model, up);
    if (!(motions.variances()[0] > known * known)) return motions.unmoved();
    ground_motions::motion at(0.0, 0.0, 0.0);
    std::optional<silhouette_fit> fit;
    double moved = 2.0 * still;
    for (int round = 0; round < most && moved > still; ++round) {
        fit.emplace(seen, points, noise, divergence, model, motions.pose_after(at));
        if (!fit->has_rays()) return motions.unmoved();
        const ground_motions::motion next = fit->best(motions, at);
        moved = gnomon::detail::length(gnomon::detail::difference(next, at));
        at = next;
    }
    return motions.after(at, fit->covariance(motions, at));
}

}  // namespace gnomon::recognition::detail

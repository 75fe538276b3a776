// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether a surface that is curved along one direction explains the means of parts of a region
/// better than planes do. Their weighted squared residuals are compared.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/segmentation/detail/orthogonal_terms.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>

namespace gnomon::detail {

/// The comparison for at most `count` parts.
template <std::size_t count>
class parabola_test {
  public:
    /// @param all    the sums of all parts
    /// @param along  the direction of x, of unit length
    parabola_test(const plane_sums& all, const Eigen::Vector3d& along)
        : whole_(all.fit()), along_(along), across_(cross(whole_.plane.normal, along)) {}

    /// Adds a part, unless it is empty.
    /// @param own  the plane that explains it
    void add(const plane_sums& part, const plane& own) {
        if (part.count == 0) return;
        const Eigen::Vector3d mean = part.positions.mean();
        const Eigen::Vector3d offset = difference(mean, whole_.centroid);
        const double x = dot(along_, offset), y = dot(across_, offset);
        const std::array<double, 4> at{1.0, x, y, x * x};
        for (std::size_t t = 0; t < terms_.size(); ++t) terms_[t][size_] = at[t];
        height_[size_] = whole_.plane.signed_distance(mean);
        weight_[size_] = part.positions.weight;
        const double off = own.signed_distance(mean);
        of_planes_ += weight_[size_] * off * off;
        ++size_;
    }

    /// To be called once.
    [[nodiscard]] bool is_curved() {
        remove_terms(weight_, terms_, height_);
        return of_planes_ > weighted_product(weight_, height_, height_);
    }

  private:
    using values = std::array<double, count>;  // of the parts

    region_plane whole_;
    Eigen::Vector3d along_, across_;
    std::size_t size_ = 0;
    double of_planes_ = 0.0;
    std::array<values, 4> terms_{};  // formula: 1, x, y, x^2
    values height_{}, weight_{};     // of no weight beyond the parts that were added
};

}  // namespace gnomon::detail

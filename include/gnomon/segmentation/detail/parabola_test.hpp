// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether a curved surface explains the means of parts of a region better than planes do: a
/// parabola along one direction, or a paraboloid. Their weighted squared residuals are compared.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>

namespace gnomon::detail {

/// The terms of a height over a plane with the coordinates x and y: 1, x, y, x^2, then x y, y^2.
enum class curved_terms : std::size_t {
    parabola = 4,   // formula
    paraboloid = 6  // formula
};

/// The comparison for at most `count` parts.
template <std::size_t count, curved_terms which>
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
        const std::array<double, 6> at{1.0, x, y, x * x, x * y, y * y};
        for (std::size_t t = 0; t < terms_.size(); ++t) terms_[t][size_] = at[t];
        height_[size_] = whole_.plane.signed_distance(mean);
        weight_[size_] = part.positions.weight;
        const double off = own.signed_distance(mean);
        of_planes_ += weight_[size_] * off * off;
        ++size_;
    }

    /// The surface is fit by making its terms orthogonal one after the other. To be called once.
    [[nodiscard]] bool is_curved() {
        for (std::size_t t = 0; t < terms_.size(); ++t) {
            for (std::size_t before = 0; before < t; ++before) remove(terms_[before], terms_[t]);
            remove(terms_[t], height_);
        }
        return of_planes_ > product(height_, height_);
    }

  private:
    using values = std::array<double, count>;  // of the parts

    [[nodiscard]] double product(const values& a, const values& b) const {
        double sum = 0.0;
        for (std::size_t p = 0; p < size_; ++p) sum += weight_[p] * a[p] * b[p];
        return sum;
    }

    /// Makes values orthogonal to others.
    void remove(const values& others, values& from) const {
        const double squared = product(others, others);
        if (!(squared > 0.0)) return;
        const double share = product(others, from) / squared;
        for (std::size_t p = 0; p < size_; ++p) from[p] -= share * others[p];
    }

    region_plane whole_;
    Eigen::Vector3d along_, across_;
    std::size_t size_ = 0;
    double of_planes_ = 0.0;
    std::array<values, static_cast<std::size_t>(which)> terms_{};
    values height_{}, weight_{};
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The surface of an object, to verify hypotheses with: samples with normals, and the symmetry of
/// the surface about the vertical.
///
///     namespace rec = gnomon::recognition;
///     const auto samples = gnomon::simulation::sample_surface(model, {.spacing = 0.015});
///     const rec::surface_model chair(samples, samples, 0.015, {},
///                                    &gnomon::simulation::surface_sample::position);
///
/// In no umbrella: include it by name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/recognition/vertical_symmetry.hpp>

namespace gnomon::recognition {

/// Samples of the visible surface of an object in its frame: z up, z = 0 on the ground. Samples are
/// evenly spaced, so that numbers of samples are areas.
class surface_model {
  public:
    /// A sample's normal: unit vector, towards the side that can be seen. Models `normal_range`
    /// together with others.
    struct oriented {
        Eigen::Vector3d normal;  ///< of unit length
    };
    /// Samples with their normals.
    struct oriented_samples {
        spatial_index points;           ///< [m]
        std::vector<oriented> normals;  ///< of each
    };

    /// Of no samples.
    surface_model() = default;

    /// @param points    any point range of the n samples [m]
    /// @param normals   n surface elements with normals
    /// @param spacing   about one sample per square of this size [m]
    /// @param symmetry  as stored before; by default it is measured
    /// @throws std::invalid_argument  if points and normals differ in number, a point is not
    ///                                finite, a normal not of unit length, the spacing not
    ///                                positive, or the symmetry of a negative order or no axis
    /// Complexity: O(n log n).
    template <class R, normal_range Normals, class Proj = std::identity>
        requires point_range<R, Proj>
    surface_model(const R& points, const Normals& normals, double spacing,
                  std::optional<vertical_symmetry> symmetry = {}, Proj projection = {})
        : all_{spatial_index(points, sequential{}, std::move(projection)), {}}, spacing_(spacing) {
        using gnomon::detail::require;
        require(static_cast<std::size_t>(std::ranges::size(normals)) == all_.points.size(),
                "surface_model: points and normals differ in number");
        const std::size_t n = all_.points.size();
        require(all_.points.finite() == n, "surface_model: a point is not finite");
        require(spacing > 0.0 && std::isfinite(spacing),
                "surface_model: the spacing must be positive and finite");
        all_.normals.reserve(n);
        for (std::size_t i = 0; i < n; ++i) {
            const Eigen::Vector3d normal = normals[i].normal;
            constexpr double rounding = 1e-3;  // numerical: of normals in float
            require(std::abs(gnomon::detail::dot(normal, normal) - 1.0) < rounding,
                    "surface_model: a normal must be of unit length");
            all_.normals.push_back({normal});
            const Eigen::Vector3d p = all_.points[i];
            for (int a = 0; a < 3; ++a) {
                low_[a] = i == 0 ? p[a] : std::min(low_[a], p[a]);
                high_[a] = i == 0 ? p[a] : std::max(high_[a], p[a]);
            }
        }
        if (symmetry)
            require(
                symmetry->order >= 0 && std::isfinite(symmetry->x) && std::isfinite(symmetry->y),
                "surface_model: a symmetry needs an order from 0 and a finite axis");
        set_coarse();
        symmetry_ = symmetry ? *symmetry : measure_symmetry(all_.points, all_.normals, spacing);
    }

    /// The samples, in the order in which they were given: an index and a point range [m].
    [[nodiscard]] const spatial_index& points() const { return all_.points; }
    /// Their normals, a `normal_range`.
    [[nodiscard]] const std::vector<oriented>& normals() const { return all_.normals; }
    /// The samples with their normals.
    [[nodiscard]] const oriented_samples& all() const { return all_; }
    /// Some of them, none within twice the spacing of another one of its side, to align with in
    /// less time.
    [[nodiscard]] const oriented_samples& coarse() const { return coarse_; }
    [[nodiscard]] double spacing() const { return spacing_; }  ///< [m]
    /// The turns about the vertical under which the surface is the same.
    [[nodiscard]] const vertical_symmetry& symmetry() const { return symmetry_; }
    [[nodiscard]] const Eigen::Vector3d& low() const { return low_; }    ///< least coordinates [m]
    [[nodiscard]] const Eigen::Vector3d& high() const { return high_; }  ///< largest ones [m]

  private:
    /// Takes each sample that is not near one of the same side that was taken.
    void set_coarse() {
        constexpr double spacings = 2.0;   // chosen on rooms of seeds 1 to 20, of 1.5 and 2
        constexpr double same_side = 0.8;  // chosen: cosine of 37 degrees, as in alignments
        std::vector<Eigen::Vector3d> points;
        std::vector<bool> is_covered(all_.points.size(), false);
        std::vector<neighbor> nearby;
        for (std::size_t i = 0; i < is_covered.size(); ++i) {
            if (is_covered[i]) continue;
            points.push_back(all_.points[i]);
            coarse_.normals.push_back(all_.normals[i]);
            all_.points.within_into(nearby, points.back(), spacings * spacing_);
            for (const neighbor& q : nearby) {
                const auto& other = all_.normals[q.index].normal;
                if (gnomon::detail::dot(other, all_.normals[i].normal) > same_side)
                    is_covered[q.index] = true;
            }
        }
        coarse_.points = spatial_index(points);
    }

    oriented_samples all_, coarse_;
    double spacing_ = 0.0;
    vertical_symmetry symmetry_;
    Eigen::Vector3d low_{0.0, 0.0, 0.0}, high_{0.0, 0.0, 0.0};
};

}  // namespace gnomon::recognition

// SPDX-License-Identifier: BSL-1.0
/// @file
/// A drawing of an object's surface as a view point sees it, of which shares of beams are read.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/perception/detail/image_of_surface.hpp>
#include <gnomon/recognition/surface_model.hpp>

namespace gnomon::recognition::detail {

/// The faces of an object that face a view point near a pose, and a drawing of them.
class surface_drawing {
  public:
    /// @param places  of the beams on the image plane, at least one
    /// @param width   of a beam, as a tangent
    surface_drawing(const image_plane& plane, std::span<const Eigen::Vector2d> places, double width,
                    const surface_model& model, const rigid_motion& pose)
        : plane_(plane), cell_(width / across), low_(places.front()) {
        constexpr double margin = 3.0 * across;  // cells: more than half of a beam
        constexpr double most = 4e6;             // cells; an object may be near, and large
        Eigen::Vector2d high = low_;
        for (const Eigen::Vector2d& p : places) {
            low_ = low_.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        low_.array() -= margin * cell_;
        const Eigen::Vector2d size = (high - low_) / cell_ + Eigen::Vector2d::Constant(margin);
        if (!(size.x() * size.y() < most)) return;
        width_ = static_cast<std::ptrdiff_t>(size.x());
        height_ = static_cast<std::ptrdiff_t>(size.y());
        set_discs(model, pose);
    }

    /// Whether the beams are too many to draw anything.
    [[nodiscard]] bool is_too_large() const { return width_ == 0; }

    /// Draws the surface at a pose.
    void draw(const rigid_motion& pose) {
        drawing_.assign(static_cast<std::size_t>(width_ * height_), 0);
        for (const disc& d : discs_) {
            const Eigen::Vector3d way =
                gnomon::detail::difference(pose.point_out(d.at), plane_.viewpoint);
            draw((plane_.place_of(way) - low_) / cell_, d);
        }
    }

    /// The share of a beam that the drawing covers.
    /// @param at  one of the places
    [[nodiscard]] double share(const Eigen::Vector2d& at) const {
        const auto x = static_cast<std::ptrdiff_t>((at.x() - low_.x()) / cell_);
        const auto y = static_cast<std::ptrdiff_t>((at.y() - low_.y()) / cell_);
        int hits = 0;
        for (auto b = y - across / 2; b <= y + across / 2; ++b)
            for (auto a = x - across / 2; a <= x + across / 2; ++a)
                hits += drawing_[static_cast<std::size_t>(b * width_ + a)];
        return static_cast<double>(hits) / (across * across);
    }

  private:
    static constexpr int across = 3;  // cells of a beam; chosen

    /// A disc around a sample.
    struct disc {
        Eigen::Vector3d at;    ///< in the frame of the object [m]
        Eigen::Vector2d a, b;  ///< conjugate half axes of its image, an ellipse, in cells
        double wide, tall;     ///< half of its width and of its height, likewise
    };

    /// The discs around the samples that are drawn, which cover the faces. They look alike from all
    /// poses near this one.
    void set_discs(const surface_model& model, const rigid_motion& pose) {
        using gnomon::detail::combined, gnomon::detail::cross, gnomon::detail::difference;
        constexpr double spacings = 0.65;  // chosen: of the radius, from .5 to .75
        const double radius = spacings * model.spacing();
        const auto visit = [&](const facing_sample& s) {
            const Eigen::Vector3d way = difference(s.at, plane_.viewpoint);
            const Eigen::Vector2d middle = plane_.place_of(way);
            const Eigen::Vector3d a = gnomon::detail::scaled(
                radius, gnomon::detail::direction_of(gnomon::detail::orthogonal(s.normal)));
            const Eigen::Vector3d b = cross(s.normal, a);
            const auto to = [&](const Eigen::Vector3d& d) -> Eigen::Vector2d {
                return (plane_.place_of(combined(1.0, way, 1.0, d)) - middle) / cell_;
            };
            const Eigen::Vector2d p = to(a), q = to(b);
            discs_.push_back(
                {pose.point_in(s.at), p, q, std::hypot(p.x(), q.x()), std::hypot(p.y(), q.y())});
        };
        constexpr double all = -std::numeric_limits<double>::infinity();  // heights
        for_each_facing_sample(model, pose, plane_.viewpoint, all, visit);
    }

    /// @param middle  of the image of the disc, in cells
    void draw(const Eigen::Vector2d& middle, const disc& d) {
        const Eigen::Vector2d &a = d.a, &b = d.b;
        const auto cell = [](double x, std::ptrdiff_t size) {
            return static_cast<std::ptrdiff_t>(
                std::clamp(std::floor(x), 0.0, static_cast<double>(size - 1)));
        };
        if (!(middle.x() + d.wide >= 0.0 && middle.y() + d.tall >= 0.0 &&
              middle.x() - d.wide < static_cast<double>(width_) &&
              middle.y() - d.tall < static_cast<double>(height_)))
            return;
        const double area = a.x() * b.y() - a.y() * b.x();
        for (auto y = cell(middle.y() - d.tall, height_); y <= cell(middle.y() + d.tall, height_);
             ++y) {
            for (auto x = cell(middle.x() - d.wide, width_); x <= cell(middle.x() + d.wide, width_);
                 ++x) {
                const double dx = static_cast<double>(x) + 0.5 - middle.x();
                const double dy = static_cast<double>(y) + 0.5 - middle.y();
                const double p = dx * b.y() - dy * b.x(), q = dy * a.x() - dx * a.y();
                if (p * p + q * q <= area * area || std::max(std::abs(dx), std::abs(dy)) <= 0.5)
                    drawing_[static_cast<std::size_t>(y * width_ + x)] = 1;
            }
        }
    }

    image_plane plane_;
    double cell_;  // on the image plane
    Eigen::Vector2d low_;
    std::ptrdiff_t width_ = 0, height_ = 0;  // in cells
    std::vector<disc> discs_;
    std::vector<std::uint8_t> drawing_;
};

}  // namespace gnomon::recognition::detail

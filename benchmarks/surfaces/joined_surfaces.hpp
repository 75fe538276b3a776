// SPDX-License-Identifier: BSL-1.0
/// @file
/// The true surfaces of a simulated scan as one sees them: flat faces that continue each other are
/// one surface, of whatever object. Faces are joined where their planes are within 2 degrees and
/// 1 cm, and their points less than 20 cm apart; transitively. Curved faces are surfaces by
/// themselves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "../chapter4/initial_segments.hpp"

/// A set of positions in cubes, to find out whether another position is near.
class cubes_of_places {
  public:
    explicit cubes_of_places(double size) : size_(size) {}

    void add(const Eigen::Vector3d& p) { cubes_[cube_of(p)].push_back(p); }

    /// Whether a position is nearer to p than the size of a cube.
    [[nodiscard]] bool is_near(const Eigen::Vector3d& p) const {
        const auto middle = cube_of(p);
        for (int k = 0; k < 27; ++k) {
            const auto found = cubes_.find(
                {middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
            if (found == cubes_.end()) continue;
            for (const Eigen::Vector3d& q : found->second)
                if ((p - q).squaredNorm() < size_ * size_) return true;
        }
        return false;
    }

  private:
    [[nodiscard]] std::array<int, 3> cube_of(const Eigen::Vector3d& p) const {
        const auto along = [&](int axis) { return static_cast<int>(std::floor(p[axis] / size_)); };
        return {along(0), along(1), along(2)};
    }

    double size_;
    std::map<std::array<int, 3>, std::vector<Eigen::Vector3d>> cubes_;
};

/// The joined surfaces of the points that are kept.
class joined_surfaces {
  public:
    joined_surfaces(const sim::true_scan& truth, const std::vector<gnomon::point_index>& kept)
        : of_point_(truth.scan.size(), sim::nothing) {
        std::map<std::int32_t, face> faces;
        for (const auto i : kept) {
            if (truth.surfaces[i] == sim::nothing) continue;
            face& f = faces[truth.surfaces[i]];
            if (f.places.empty()) f.normal = truth.normals[i];
            f.flat = f.flat && f.normal.dot(truth.normals[i]) > cosine_of_flat;
            f.places.push_back(true_place(truth, i));
        }
        std::map<std::int32_t, std::int32_t> number;  // of the face of a surface of the scene
        std::vector<face> all;
        for (auto& [surface, f] : faces) {
            number[surface] = static_cast<std::int32_t>(all.size());
            all.push_back(std::move(f));
        }
        const std::vector<std::int32_t> joined = join(all);
        for (const auto i : kept) {
            if (truth.surfaces[i] == sim::nothing) continue;
            const std::int32_t of = joined[static_cast<std::size_t>(number[truth.surfaces[i]])];
            of_point_[i] = of;
            ++points_[of];
        }
        for (const auto& [of, points] : points_)
            is_flat_[of] = all[static_cast<std::size_t>(of)].flat;
    }

    /// The number of the surface of a point, or `nothing`: also of points that are not kept.
    [[nodiscard]] std::int32_t of(std::size_t point) const { return of_point_[point]; }
    [[nodiscard]] bool is_flat(std::int32_t surface) const { return is_flat_.at(surface); }
    /// The number of kept points of each surface.
    [[nodiscard]] const std::map<std::int32_t, std::size_t>& points() const { return points_; }

  private:
    static constexpr double cosine_of_flat = 1.0 - 1e-5;  // of a quarter of a degree
    static constexpr double farthest = 0.01, gap = 0.20;  // [m]

    struct face {
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        std::vector<Eigen::Vector3d> places;  // without noise
        bool flat = true;

        [[nodiscard]] Eigen::Vector3d middle() const {
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const Eigen::Vector3d& p : places) sum += p;
            return sum / static_cast<double>(places.size());
        }
    };

    /// For each face, the first one of its joined surface.
    static std::vector<std::int32_t> join(const std::vector<face>& faces) {
        gnomon::detail::union_find together(faces.size());
        for (gnomon::point_index a = 0; a < faces.size(); ++a)
            for (gnomon::point_index b = a + 1; b < faces.size(); ++b)
                if (together.find(a) != together.find(b) && continue_each_other(faces[a], faces[b]))
                    together.unite(a, b);
        std::vector<std::int32_t> first;
        for (gnomon::point_index a = 0; a < faces.size(); ++a)
            first.push_back(static_cast<std::int32_t>(together.find(a)));
        return first;
    }

    static bool continue_each_other(const face& f, const face& g) {
        static const double parallel = cos(gnomon::degrees(2));
        if (!f.flat || !g.flat || f.normal.dot(g.normal) < parallel) return false;
        const Eigen::Vector3d between = f.middle() - g.middle();
        if (std::abs(f.normal.dot(between)) > farthest ||
            std::abs(g.normal.dot(between)) > farthest)
            return false;
        const bool f_is_smaller = f.places.size() < g.places.size();
        const face& smaller = f_is_smaller ? f : g;
        const face& larger = f_is_smaller ? g : f;
        cubes_of_places cubes(gap);
        for (const Eigen::Vector3d& p : smaller.places) cubes.add(p);
        return std::any_of(larger.places.begin(), larger.places.end(),
                           [&](const Eigen::Vector3d& p) { return cubes.is_near(p); });
    }

    std::vector<std::int32_t> of_point_;
    std::map<std::int32_t, std::size_t> points_;
    std::map<std::int32_t, bool> is_flat_;
};

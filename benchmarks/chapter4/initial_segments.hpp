// SPDX-License-Identifier: BSL-1.0
/// @file
/// Ground truth for the segments of a simulated scan before merging: the true surface of each, and
/// the pairs of segments of the same surface that an occluder interrupts.
///
/// A true surface is the set of all coplanar faces of one object with the same outward normal, such
/// as the slats of a back or the fronts of two legs; or a curved face. A true plane is the set of
/// all coplanar faces with the same outward normal, of any objects, such as two seats of the same
/// height.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include <Eigen/Core>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

/// The position where the ray of a point hits the scene, without noise [m].
inline Eigen::Vector3d true_place(const sim::true_scan& truth, std::size_t i) {
    return truth.scan.viewpoints[i] + truth.ranges[i] * truth.directions[i];
}

/// The unit of the ground truth.
enum class unit { surface, plane };

/// The true surfaces, or planes, of a scan.
class true_surfaces {
  public:
    true_surfaces(const sim::true_scan& truth, unit one) {
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            if (truth.surfaces[i] == sim::nothing) continue;
            const auto [known, is_new] = faces_.try_emplace(
                truth.surfaces[i], face{truth.objects[i], truth.normals[i], true_place(truth, i)});
            face& f = known->second;
            f.flat = f.flat && f.normal.dot(truth.normals[i]) > parallel;
        }
        for (auto& [surface, f] : faces_) {
            f.number = surface;
            for (const auto& [other, g] : faces_) {
                if (other == surface) break;
                if ((one == unit::surface && f.object != g.object) || !(distance(f, g) < 0.005))
                    continue;
                f.number = g.number;
                break;
            }
        }
    }

    /// The true surface that a surface of the scene belongs to, or `nothing`.
    [[nodiscard]] std::int32_t of(std::int32_t surface) const {
        return surface == sim::nothing ? surface : faces_.at(surface).number;
    }
    [[nodiscard]] bool is_flat(std::int32_t number) const { return faces_.at(number).flat; }
    [[nodiscard]] bool same_object(std::int32_t a, std::int32_t b) const {
        return faces_.at(a).object == faces_.at(b).object;
    }
    /// The distance between the planes of two surfaces [m]; infinite if they are curved or not
    /// parallel.
    [[nodiscard]] double distance(std::int32_t a, std::int32_t b) const {
        return distance(faces_.at(a), faces_.at(b));
    }

  private:
    static constexpr double parallel = 1.0 - 1e-5;  // the cosine of a quarter of a degree

    struct face {
        std::int32_t object;
        Eigen::Vector3d normal, place;
        bool flat = true;
        std::int32_t number = sim::nothing;
    };

    static double distance(const face& f, const face& g) {
        if (!f.flat || !g.flat || f.normal.dot(g.normal) <= parallel)
            return std::numeric_limits<double>::infinity();
        return std::abs(f.normal.dot(f.place - g.place));
    }

    std::map<std::int32_t, face> faces_;
};

/// Numbers of pairs of initial segments that were merged, or should have been.
struct merge_tally {
    double wanted = 0.0;    ///< interrupted by an occluder
    double right = 0.0;     ///< merged, and wanted
    double wrong = 0.0;     ///< merged, but on two true surfaces
    double coplanar = 0.0;  ///< of the wrong ones: coplanar faces of two objects
    double in_noise = 0.0;  ///< of the other wrong ones: planes less than 15 mm apart

    void add(const merge_tally& t, double weight) {
        wanted += weight * t.wanted;
        right += weight * t.right;
        wrong += weight * t.wrong;
        coplanar += weight * t.coplanar;
        in_noise += weight * t.in_noise;
    }
    [[nodiscard]] double precision() const {
        return right + wrong > 0.0 ? right / (right + wrong) : 1.0;
    }
    [[nodiscard]] double recall() const { return wanted > 0.0 ? right / wanted : 1.0; }
};

/// Tallies where each pair counts as one, and by its points.
struct merge_tallies {
    merge_tally pairs, by_points;
};

/// Whether, for most lines across a gap, rays to most positions on the line hit an occluder.
inline bool is_occluded_between(const std::vector<gnomon::detail::boundary_pair>& lines,
                                const std::vector<Eigen::Vector3d>& places, const auto& viewpoints,
                                const sim::bvh_caster& caster) {
    constexpr int steps = 39;
    const auto is_hidden = [&](const auto& line) {
        const Eigen::Vector3d p = places[line.first], q = places[line.second];
        const Eigen::Vector3d from = 0.5 * (viewpoints[line.first] + viewpoints[line.second]);
        int hidden = 0;
        for (int s = 1; s <= steps; ++s) {
            const Eigen::Vector3d way = p + (q - p) * s / (steps + 1.0) - from;
            const double range = way.norm();
            const auto hit = caster(sim::ray{from, way / range});
            hidden += hit && hit->range < range - 0.03 ? 1 : 0;
        }
        return 2 * hidden > steps;
    };
    return 2 * std::count_if(lines.begin(), lines.end(), is_hidden) >
           static_cast<std::ptrdiff_t>(lines.size());
}

/// For each segment, the set of segments that a chain of occluded gaps connects it with.
/// @param is_coplanar  whether two segments belong to one flat true surface
inline std::vector<gnomon::point_index> chains_of_occluded_gaps(const sim::bvh_caster& caster,
                                                                const sim::true_scan& truth,
                                                                const gnomon::segments& parts,
                                                                auto&& is_coplanar) {
    std::vector<Eigen::Vector3d> places;
    for (std::size_t i = 0; i < truth.scan.size(); ++i) places.push_back(true_place(truth, i));
    std::vector<Eigen::Vector3d> centroids;
    for (std::size_t s = 0; s < parts.size(); ++s) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto i : parts[s]) sum += places[i];
        centroids.push_back(sum / static_cast<double>(parts[s].size()));
    }
    gnomon::detail::union_find together(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = i + 1; j < parts.size(); ++j) {
            if (!is_coplanar(i, j)) continue;
            std::vector<gnomon::detail::boundary_pair> lines;
            gnomon::detail::append_boundary_pairs(lines, places, parts[i], parts[j],
                                                  {centroids[i], centroids[j]});
            if (is_occluded_between(lines, places, truth.scan.viewpoints, caster))
                together.unite(static_cast<gnomon::point_index>(i),
                               static_cast<gnomon::point_index>(j));
        }
    }
    std::vector<gnomon::point_index> chain;
    for (std::size_t i = 0; i < parts.size(); ++i)
        chain.push_back(together.find(static_cast<gnomon::point_index>(i)));
    return chain;
}

/// The segments of a scan before merging, with their true surfaces. Segments with a fifth or more
/// of their points on other surfaces have none, and are not counted.
class initial_segments {
  public:
    /// @param caster  of the scene; needed only here
    /// @param parts   segments of the scan; refers to it
    initial_segments(const sim::bvh_caster& caster, const sim::true_scan& truth,
                     const gnomon::segments& parts, unit one = unit::surface)
        : surfaces_(truth, one), parts_(parts) {
        for (std::size_t s = 0; s < parts.size(); ++s) {
            std::map<std::int32_t, std::size_t> count;
            for (const auto i : parts[s]) ++count[surfaces_.of(truth.surfaces[i])];
            const auto most =
                std::max_element(count.begin(), count.end(),
                                 [](const auto& a, const auto& b) { return a.second < b.second; });
            const bool is_mixed = 5 * most->second <= 4 * parts[s].size();
            surface_.push_back(is_mixed ? sim::nothing : most->first);
        }
        whole_ = chains_of_occluded_gaps(
            caster, truth, parts,
            [this](std::size_t i, std::size_t j) { return is_coplanar(i, j); });
    }

    /// The true surface of a segment, or `nothing`.
    [[nodiscard]] std::int32_t surface(std::size_t segment) const { return surface_[segment]; }

    /// Whether an occluder interrupts one true surface between two segments.
    [[nodiscard]] bool wanted(std::size_t a, std::size_t b) const { return whole_[a] == whole_[b]; }

    /// The tally of a merging. Segments of one true surface without an occluder between them may be
    /// merged or not: neither is counted.
    [[nodiscard]] merge_tallies tally(const gnomon::segments& merged) const {
        merge_tallies t;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            for (std::size_t j = i + 1; j < parts_.size(); ++j) {
                const std::int32_t a = surface_[i], b = surface_[j];
                if (a == sim::nothing || b == sim::nothing) continue;
                const bool is_merged =
                    merged.labels()[parts_[i].front()] == merged.labels()[parts_[j].front()];
                merge_tally pair;
                if (wanted(i, j)) {
                    pair.wanted = 1.0;
                    pair.right = is_merged ? 1.0 : 0.0;
                } else if (is_merged && a != b) {
                    pair.wrong = 1.0;
                    const double apart = surfaces_.distance(a, b);
                    if (apart < 0.005 && !surfaces_.same_object(a, b))
                        pair.coplanar = 1.0;
                    else if (apart < 0.015)
                        pair.in_noise = 1.0;
                }
                t.pairs.add(pair, 1.0);
                t.by_points.add(pair, static_cast<double>(parts_[i].size() + parts_[j].size()));
            }
        }
        return t;
    }

  private:
    [[nodiscard]] bool is_coplanar(std::size_t i, std::size_t j) const {
        return surface_[i] == surface_[j] && surface_[i] != sim::nothing &&
               surfaces_.is_flat(surface_[i]);
    }

    true_surfaces surfaces_;
    const gnomon::segments& parts_;
    // For each segment: its true surface, and the set of segments that a chain of occluded gaps
    // connects it with.
    std::vector<std::int32_t> surface_;
    std::vector<gnomon::point_index> whole_;
};

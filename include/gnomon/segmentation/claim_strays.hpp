// SPDX-License-Identifier: BSL-1.0
/// @file
/// Gives flat segments the points that belong to them but have no segment: near edges, where
/// normals are blended, and where points lie so densely that their neighborhoods are hardly wider
/// than noise, normals say little, and segmentation by normals loses what a plane would keep.
///
/// A point within three standard deviations of a plane may be there by chance, as the rim of a thin
/// board is. (Noise lies along the rays: at a slant, less of it is across the plane.) What tells is
/// the mean of all stray points in that slab about it: of points of the plane, it is off by no more
/// than the noise of a mean. (Not in the thesis, whose Alg. 4.2 leaves such points aside;
/// release_strays is the reverse.)
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/knn_of_some.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/noisy_plane.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `claim_strays`.
struct stray_claiming {
    double sigma = 0.015;        ///< standard deviation of ranges [m]
    std::size_t k = 20;          ///< a segment claims next to its points: among so many neighbors
    double max_distance = 0.30;  ///< and no farther from one of these [m]
};

namespace detail {

/// One run over a cloud. The strays are numbered cube by cube, and judged so: thousands at one
/// place cost hardly more than a few.
template <class Points>
class stray_claimer {
  public:
    /// @param graph   the neighbors of each stray, nearest first
    /// @param planes  those of the segments
    stray_claimer(const Points& points, viewpoint_table viewpoints, const adjacency& graph,
                  const segments& parts, std::vector<noisy_plane> planes,
                  const stray_claiming& options)
        : points_(points),
          viewpoints_(std::move(viewpoints)),
          graph_(graph),
          options_(options),
          labels_(parts.labels()),
          planes_(std::move(planes)) {
        number_strays();
        list_followers();
    }

    /// Segments grow by one layer of strays after the other, until no stray is claimed.
    template <execution X>
    [[nodiscard]] segments operator()(const X& run) {
        const kd_tree cubes(cubes_, &cube::mean);
        std::vector<std::size_t> layer(strays_.size());
        std::iota(layer.begin(), layer.end(), std::size_t{0});
        std::vector<std::int32_t> claims;
        std::vector<std::size_t> begin;  // of what the layer has of a cube
        while (!layer.empty()) {
            begin.clear();
            for (std::size_t l = 0; l < layer.size(); ++l)
                if (l == 0 || strays_[layer[l]].cube != strays_[layer[l - 1]].cube)
                    begin.push_back(l);
            begin.push_back(layer.size());
            claims.resize(layer.size());
            for_each_chunk(run, begin.size() - 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t l = begin[first]; l < begin[last]; ++l)
                    claims[l] = claim_to(strays_[layer[l]], cubes);
            });
            std::vector<std::size_t> next;  // who has got a neighbor in a segment
            for (std::size_t l = 0; l < layer.size(); ++l) {
                if (claims[l] == unlabeled) continue;
                const std::size_t s = layer[l];
                labels_[strays_[s].point] = claims[l];
                for (std::size_t f = first_follower_[s]; f < first_follower_[s + 1]; ++f)
                    next.push_back(followers_[f]);
            }
            std::erase_if(next, [&](auto s) { return labels_[strays_[s].point] != unlabeled; });
            std::sort(next.begin(), next.end());
            next.erase(std::unique(next.begin(), next.end()), next.end());
            layer.swap(next);
        }
        return largest_first(segments(std::move(labels_))).first;
    }

  private:
    struct stray {
        point_index point;
        std::size_t cube;
    };
    /// Whether the strays about a cube are of the plane of a segment.
    struct judgement {
        std::int32_t segment;
        bool is_of_plane;
    };
    struct cube {
        Eigen::Vector3d mean;       ///< of its strays [m]
        Eigen::Vector3d viewpoint;  ///< the mean of theirs [m]; not finite if one is not known
        double count;               ///< of them
        double squared_reach;       ///< of the neighbors of any [m^2]
        std::vector<judgement> judged = {};
    };

    [[nodiscard]] bool is_stray(std::size_t i) const {
        return labels_[i] == unlabeled && is_finite(points_[i]);
    }

    /// Sums up the strays cube by cube: what a plane asks of them, the sum of distances from it,
    /// needs no more than their mean. Cubes begin at the least coordinates of any, wherever the
    /// cloud lies.
    void number_strays() {
        struct placed {
            std::array<double, 3> cube;
            point_index point;
            auto operator<=>(const placed&) const = default;
        };
        // In standard deviations: so narrow that where cubes begin decides next to nothing.
        constexpr double side = 0.75;
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Eigen::Vector3d least(infinity, infinity, infinity);
        for (std::size_t i = 0; i < points_.size(); ++i)
            for (int a = 0; a < 3 && is_stray(i); ++a) least[a] = std::min(least[a], points_[i][a]);
        std::vector<placed> all;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (!is_stray(i)) continue;
            const Eigen::Vector3d p = difference(points_[i], least);
            const auto cell = [&](int a) { return std::floor(p[a] / (side * options_.sigma)); };
            all.push_back({{cell(0), cell(1), cell(2)}, static_cast<point_index>(i)});
        }
        std::sort(all.begin(), all.end());
        for (auto first = all.begin(); first != all.end();) {
            const Eigen::Vector3d origin = points_[first->point];
            moments m, seen_from;
            double squared_reach = 0.0;
            auto last = first;
            for (; last != all.end() && last->cube == first->cube; ++last) {
                const Eigen::Vector3d p = points_[last->point];
                m.add(difference(p, origin));
                seen_from.add(known_viewpoint(viewpoints_, last->point));
                if (const auto ring = graph_[last->point]; !ring.empty())
                    squared_reach =
                        std::max(squared_reach, squared_distance(points_[ring.back()], p));
                strays_.push_back({last->point, cubes_.size()});
            }
            const auto n = static_cast<double>(m.count);
            cubes_.push_back({combined(1.0, origin, 1.0 / n, m.sum), scaled(1.0 / n, seen_from.sum),
                              n, squared_reach});
            first = last;
        }
    }

    /// The followers of a stray are those that it is a neighbor of.
    void list_followers() {
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        std::vector<std::size_t> number(points_.size(), none);
        for (std::size_t s = 0; s < strays_.size(); ++s) number[strays_[s].point] = s;
        const auto for_each_link = [&](auto&& visit) {
            for (std::size_t s = 0; s < strays_.size(); ++s) {
                for (const point_index j : graph_[strays_[s].point])
                    if (number[j] != none) visit(s, number[j]);
            }
        };
        first_follower_.assign(strays_.size() + 1, 0);
        for_each_link([&](std::size_t, std::size_t to) { ++first_follower_[to + 1]; });
        std::partial_sum(first_follower_.begin(), first_follower_.end(), first_follower_.begin());
        followers_.resize(first_follower_.back());
        std::vector<std::size_t> place(first_follower_.begin(), first_follower_.end() - 1);
        for_each_link([&](std::size_t s, std::size_t to) { followers_[place[to]++] = s; });
    }

    /// The segment to which a stray goes in this round: of those about it whose plane is its own,
    /// the one with the nearest plane.
    std::int32_t claim_to(const stray& s, const kd_tree& cubes) {
        const Eigen::Vector3d p = points_[s.point];
        const Eigen::Vector3d viewpoint = known_viewpoint(viewpoints_, s.point);
        std::int32_t best = unlabeled;
        double least = std::numeric_limits<double>::infinity();
        for (const point_index j : graph_[s.point]) {
            if (squared_distance(points_[j], p) > options_.max_distance * options_.max_distance)
                break;
            const std::int32_t segment = labels_[j];
            if (segment == unlabeled || segment == best) continue;
            const noisy_plane& of = planes_[static_cast<std::size_t>(segment)];
            const double distance = std::abs(of.distance(p));
            if (!of.is_flat() || distance >= least || distance > thickness(of, p, viewpoint) ||
                !are_of(segment, cubes_[s.cube], cubes))
                continue;
            best = segment;
            least = distance;
        }
        return best;
    }

    /// Whether the strays in the slab about the plane of a segment, near a cube, are of the plane.
    bool are_of(std::int32_t segment, cube& near, const kd_tree& cubes) {
        const auto known =
            std::find_if(near.judged.begin(), near.judged.end(),
                         [segment](const judgement& j) { return j.segment == segment; });
        if (known != near.judged.end()) return known->is_of_plane;
        const noisy_plane& of = planes_[static_cast<std::size_t>(segment)];
        const double thick = thickness(of, near.mean, near.viewpoint);
        // So wide that noise does not decide who is near.
        const double wide = noisy_plane::at_most * options_.sigma;
        const double width2 = std::max(wide * wide, near.squared_reach);
        double sum = 0.0, n = 0.0;
        cubes.for_each_within(
            of.foot_of(near.mean), std::sqrt(width2 + thick * thick), [&](const neighbor& q) {
                const double off = of.distance(cubes_[q.index].mean);
                if (std::abs(off) > thick || q.squared_distance - off * off > width2) return;
                sum += cubes_[q.index].count * off;
                n += cubes_[q.index].count;
            });
        constexpr double no_noise = 0.1;  // in standard deviations: no surface is quite a plane
        const bool is_of_plane =
            n > 0.0 && std::abs(sum) <= thick * std::sqrt(n) + no_noise * options_.sigma * n;
        near.judged.push_back({segment, is_of_plane});
        return is_of_plane;
    }

    /// Of the slab about a plane, to each side [m].
    static double thickness(const noisy_plane& of, const Eigen::Vector3d& p,
                            const Eigen::Vector3d& viewpoint) {
        return noisy_plane::at_most * of.deviation_at(p, viewpoint);
    }

    const Points& points_;
    viewpoint_table viewpoints_;
    const adjacency& graph_;
    stray_claiming options_;
    std::vector<std::int32_t> labels_;
    std::vector<noisy_plane> planes_;  // of the segments
    std::vector<stray> strays_;        // cube by cube
    std::vector<cube> cubes_;
    std::vector<std::size_t> first_follower_, followers_;  // of the strays
};

}  // namespace detail

/// The segments with the stray points that are of their planes. Segments that are thicker than
/// twice `sigma`, or slimmer than it, claim nothing. No point changes from one segment to another.
///
/// @param points  any point range of n points [m]; where view points are known, noise lies along
///                the rays, else it is the same in all directions
/// @param parts   segments of these points
/// @return the segments, largest first; the same bytes for every execution
/// @throws std::invalid_argument  if points, segments or view points differ in number, or unless
///                                sigma is greater than 0, k at least 1 and max_distance not
///                                negative
/// Complexity: O(n (log n + k^2)) at worst, and a slab of cubes narrower than sigma for each pair
/// of a cube with strays and a segment beside it.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments claim_strays(const R& points, const segments& parts,
                                    const stray_claiming& options = {}, const X& run = {},
                                    Proj projection = {}) {
    const position_view<R, Proj> p(points, projection);
    detail::require(parts.labels().size() == p.size(),
                    "claim_strays: the segments are of other points");
    detail::require(options.sigma > 0.0, "claim_strays: sigma must be greater than 0");
    detail::require(options.k > 0, "claim_strays: k must be at least 1");
    detail::require(options.max_distance >= 0.0,
                    "claim_strays: max_distance must not be negative or NaN");
    std::vector<bool> is_stray(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) is_stray[i] = parts.labels()[i] == unlabeled;
    const adjacency graph =
        detail::graph_of_some(knn{options.k}, is_stray, points, run, projection);
    return detail::stray_claimer(
        p, viewpoints_of(points), graph, parts,
        detail::planes_of_segments(points, parts, options.sigma, run, projection), options)(run);
}

}  // namespace gnomon

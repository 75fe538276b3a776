// SPDX-License-Identifier: BSL-1.0
/// @file
/// Gives flat segments the points that belong to them but have no segment: near edges, where
/// normals are blended, and where points lie so densely that their neighborhoods are hardly wider
/// than noise, normals say little, and segmentation by normals loses what a plane would keep.
///
/// A point within three standard deviations of a plane may be there by chance, as the rim of a thin
/// board is. What tells is the mean of all stray points in that slab about it: of points of the
/// plane, it is off by no more than the noise of a mean. (Not in the thesis, whose Alg. 4.2 leaves
/// such points aside.)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `claim_strays`.
struct stray_claiming {
    double sigma = 0.015;        ///< standard deviation of points across a surface [m]
    std::size_t k = 20;          ///< a segment claims next to its points: among so many neighbors
    double max_distance = 0.30;  ///< and no farther from one of these [m]
};

namespace detail {

/// One run over a cloud.
template <class Points>
class stray_claimer {
  public:
    stray_claimer(const Points& points, const segments& parts, const stray_claiming& options)
        : points_(points), options_(options), labels_(parts.labels()) {}

    /// Makes it known that a segment is flat, and in which plane.
    void add_plane(const plane& of) { planes_.push_back(of); }

    /// Segments grow by one layer of strays after the other, until no stray is claimed. The tree is
    /// of the points.
    template <execution X>
    [[nodiscard]] segments operator()(const kd_tree& tree, const X& run) {
        find_strays(tree, run);
        std::vector<std::size_t> layer(strays_.size());
        std::iota(layer.begin(), layer.end(), std::size_t{0});
        std::vector<std::int32_t> claims;
        while (!layer.empty()) {
            claims.resize(layer.size());
            for_each_chunk(run, layer.size(), [&](std::size_t begin, std::size_t end) {
                for (std::size_t l = begin; l < end; ++l) claims[l] = claim_to(layer[l]);
            });
            std::vector<std::size_t> next;  // who has got a neighbor in a segment
            for (std::size_t l = 0; l < layer.size(); ++l) {
                if (claims[l] == unlabeled) continue;
                labels_[strays_[layer[l]]] = claims[l];
                next.insert(next.end(), listed_by_[layer[l]].begin(), listed_by_[layer[l]].end());
            }
            std::erase_if(next, [&](std::size_t s) { return labels_[strays_[s]] != unlabeled; });
            std::sort(next.begin(), next.end());
            next.erase(std::unique(next.begin(), next.end()), next.end());
            layer.swap(next);
        }
        return largest_first(segments(std::move(labels_))).first;
    }

  private:
    /// A segment that was looked at for a stray, and how far this is from its plane; infinitely far
    /// if it is none of its points [m].
    struct judgement {
        std::int32_t segment;
        double distance;
    };

    template <execution X>
    void find_strays(const kd_tree& tree, const X& run) {
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (labels_[i] == unlabeled && is_finite(points_[i])) {
                strays_.push_back(static_cast<point_index>(i));
                positions_.push_back(points_[i]);
            }
        }
        around_.resize(strays_.size());
        judgements_.resize(strays_.size());
        listed_by_.resize(strays_.size());
        for_each_chunk(run, strays_.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t s = begin; s < end; ++s)
                tree.nearest(positions_[s], options_.k, strays_[s], around_[s]);
        });
        sum_up_cells();
        for (std::size_t s = 0; s < strays_.size(); ++s) {
            for (const neighbor& q : around_[s]) {
                const auto other = std::lower_bound(strays_.begin(), strays_.end(), q.index);
                if (other != strays_.end() && *other == q.index)
                    listed_by_[static_cast<std::size_t>(other - strays_.begin())].push_back(s);
            }
        }
    }

    /// Sums up the strays in cubes of sigma, so that thousands at one place cost no more than a
    /// few: what a plane asks of them, the sum of distances from it, needs no more than their mean.
    void sum_up_cells() {
        std::vector<std::pair<std::array<double, 3>, std::size_t>> by_cell;
        for (std::size_t s = 0; s < positions_.size(); ++s) {
            const auto cell = [&](int a) { return std::floor(positions_[s][a] / options_.sigma); };
            by_cell.push_back({{cell(0), cell(1), cell(2)}, s});
        }
        std::sort(by_cell.begin(), by_cell.end());
        for (auto first = by_cell.begin(); first != by_cell.end();) {
            const Eigen::Vector3d& origin = positions_[first->second];
            moments m;
            auto last = first;
            for (; last != by_cell.end() && last->first == first->first; ++last)
                m.add(difference(positions_[last->second], origin));
            const auto n = static_cast<double>(m.count);
            cell_means_.push_back(combined(1.0, origin, 1.0 / n, m.sum));
            cell_counts_.push_back(n);
            first = last;
        }
        cells_.emplace(cell_means_);
    }

    /// The segment to which a stray goes in this round: of those about it whose plane is its own,
    /// the one with the nearest plane.
    std::int32_t claim_to(std::size_t s) {
        judgement best{unlabeled, std::numeric_limits<double>::infinity()};
        for (const neighbor& q : around_[s]) {
            if (q.squared_distance > options_.max_distance * options_.max_distance) break;
            const std::int32_t segment = labels_[q.index];
            if (segment == unlabeled) continue;
            auto& known = judgements_[s];
            auto j = std::find_if(known.begin(), known.end(),
                                  [segment](const judgement& k) { return k.segment == segment; });
            if (j == known.end())
                j = known.insert(
                    j, {segment, distance_if_of(s, planes_[static_cast<std::size_t>(segment)])});
            if (j->distance < best.distance) best = *j;
        }
        return best.segment;
    }

    /// How far a stray is from a plane [m]; infinity if it, or the strays about it, are too far to
    /// be of the plane.
    double distance_if_of(std::size_t s, const plane& of) const {
        constexpr double no = std::numeric_limits<double>::infinity(), deviations = 3.0;
        const double thickness = deviations * options_.sigma;
        const Eigen::Vector3d& p = positions_[s];
        if (is_missing(of.normal)) return no;
        const double distance = of.signed_distance(p);
        if (!(std::abs(distance) <= thickness)) return no;
        // About it in the slab, and so wide that noise does not decide who is near.
        const double farthest =
            around_[s].empty() ? 0.0 : std::sqrt(around_[s].back().squared_distance);
        const double width = std::max(thickness, farthest);
        double sum = 0.0, n = 0.0;
        cells_->for_each_within(
            combined(1.0, p, -distance, of.normal), std::hypot(width, thickness),
            [&](const neighbor& q) {
                const double off = of.signed_distance(cell_means_[q.index]);
                if (std::abs(off) > thickness || q.squared_distance - off * off > width * width)
                    return;
                sum += cell_counts_[q.index] * off;
                n += cell_counts_[q.index];
            });
        const bool is_of_plane = std::abs(sum) <= deviations * options_.sigma * std::sqrt(n);
        return is_of_plane ? std::abs(distance) : no;
    }

    const Points& points_;
    stray_claiming options_;
    std::vector<std::int32_t> labels_;
    std::vector<plane> planes_;        // of the segments; those that are not flat have no normal
    std::vector<point_index> strays_;  // ascending
    std::vector<Eigen::Vector3d> positions_;           // of the strays [m]
    std::vector<Eigen::Vector3d> cell_means_;          // of the strays in a cube [m]
    std::vector<double> cell_counts_;                  // how many these are
    std::optional<kd_tree> cells_;                     // of the means
    std::vector<std::vector<neighbor>> around_;        // each stray, in the cloud
    std::vector<std::vector<std::size_t>> listed_by_;  // the strays that it is a neighbor of
    std::vector<std::vector<judgement>> judgements_;   // about it, once for all
};

}  // namespace detail

/// The segments with the stray points that are of their planes. Segments that are thicker than
/// twice `sigma` claim nothing. No point changes from one segment to another.
///
/// @param points  any point range of n points [m]
/// @param parts   segments of these points
/// @return the segments, largest first; the same bytes for every execution
/// @throws std::invalid_argument  if the segments are of another number of points, or unless sigma
///                                is greater than 0, k at least 1 and max_distance not negative
/// Complexity: O(n log n), and for s strays O(s (k + cubes of sigma in the slab about each)).
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
    detail::stray_claimer claimer(p, parts, options);
    for (std::size_t s = 0; s < parts.size(); ++s) {
        const auto frame = principal_frame_of(subset_view<R, Proj>(points, parts[s], projection));
        const bool is_flat =
            parts[s].size() >= 3 && frame.spectrum.lambda[2] <= 4.0 * options.sigma * options.sigma;
        const Eigen::Vector3d normal = is_flat ? frame.normal() : Eigen::Vector3d(0.0, 0.0, 0.0);
        claimer.add_plane({normal, detail::dot(normal, frame.centroid)});
    }
    return claimer(kd_tree(points, std::move(projection)), run);
}

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether surfaces that are reported as flat are flat. A surface that is not on one plane has
/// points far from the plane that are next to each other (a blob), as noise hardly ever has: 30 or
/// more connected points, each farther from the plane than five standard deviations of its noise
/// and 1 cm. The test uses no code of the segmentation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

/// The numbers of flat surfaces of a scan.
struct flatness {
    std::size_t flat = 0;       ///< that are reported as flat
    std::size_t with_blob = 0;  ///< of these, those that have a blob
};

/// The numbers of the points that are farther from a plane than noise explains, of those listed.
/// @param is_along_rays  else the noise is the same in all directions
inline std::vector<gnomon::point_index> points_off(const gnomon::scan& scan, const auto& members,
                                                   const gnomon::plane& from,
                                                   const gnomon::noise_curve& noise,
                                                   bool is_along_rays) {
    constexpr double deviations = 5.0, flatness = 0.01;  // [m]
    constexpr double least_cosine = 1.0 / 3.0;           // of the angle of incidence, as in gnomon
    std::vector<gnomon::point_index> off;
    for (const auto i : members) {
        if (!gnomon::is_finite(scan.points[i])) continue;
        const Eigen::Vector3d ray = scan.points[i] - scan.viewpoints[i];
        double sigma = noise.along(Eigen::Vector3d::Zero());
        if (is_along_rays) {
            const double cosine = std::abs(ray.normalized().dot(from.normal));
            sigma = noise.along(ray) * std::max(cosine, least_cosine);
        }
        if (std::abs(from.signed_distance(scan.points[i])) > deviations * sigma + flatness)
            off.push_back(i);
    }
    return off;
}

/// The size of the largest component of the points `some`. Two of them are connected if one is one
/// of the 12 nearest neighbors of the other among all `members`. That is the more demanding test:
/// if both had to be, components would be smaller.
inline std::size_t largest_component(const gnomon::scan& scan, const auto& members,
                                     const std::vector<gnomon::point_index>& some) {
    std::vector<Eigen::Vector3d> points;
    std::vector<gnomon::point_index> number(scan.size(), 0);  // in `points`
    for (const auto i : members) {
        number[i] = static_cast<gnomon::point_index>(points.size());
        points.push_back(scan.points[i]);
    }
    const auto none = static_cast<gnomon::point_index>(some.size());
    std::vector<gnomon::point_index> place(points.size(), none);  // in `some`
    for (gnomon::point_index s = 0; s < none; ++s) place[number[some[s]]] = s;

    const gnomon::spatial_index index(points);
    gnomon::detail::union_find sets(some.size());
    std::vector<gnomon::neighbor> found;
    for (gnomon::point_index s = 0; s < none; ++s) {
        gnomon::knn{.k = 12}.find(index, number[some[s]], found);
        for (const gnomon::neighbor& q : found)
            if (place[q.index] != none) sets.unite(s, place[q.index]);
    }
    std::vector<std::size_t> size(some.size(), 0);
    for (gnomon::point_index s = 0; s < none; ++s) ++size[sets.find(s)];
    return size.empty() ? 0 : std::ranges::max(size);
}

/// Counts the flat surfaces of a scan, and those of them that have a blob.
/// @param seen  what `perception` returned for this scan
template <class Estimate>
[[nodiscard]] flatness flatness_of(const gnomon::scan& scan,
                                   const gnomon::perception_result<Estimate>& seen) {
    constexpr std::size_t fewest = 30;  // points of a blob
    flatness count;
    for (std::size_t s = 0; s < seen.surfaces.size(); ++s) {
        if (!seen.planes[s].is_flat) continue;
        ++count.flat;
        const auto& members = seen.surfaces[s];
        const auto off = points_off(scan, members, seen.planes[s].plane, seen.noise.curve,
                                    !seen.noise.is_across_surface);
        if (off.size() >= fewest && largest_component(scan, members, off) >= fewest)
            ++count.with_blob;
    }
    return count;
}

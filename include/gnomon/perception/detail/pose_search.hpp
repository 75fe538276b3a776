// SPDX-License-Identifier: BSL-1.0
/// @file
/// Places at which an object may stand, without its parts: of all places and headings on a grid,
/// those at which much of the object's surface is where the scan has points, and little of it where
/// the sensor saw through. Finds objects for which no part votes, such as a table one end of which
/// is occluded by a chair.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/observed_space.hpp>
#include <gnomon/recognition/cast_votes.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/vertical_symmetry.hpp>
#include <gnomon/recognition/wall.hpp>

namespace gnomon::recognition::detail {

/// Searches one object in one space.
class pose_search {
  public:
    /// Places of an object in a piece of ground; chosen on touching rooms of seeds 101 to 160 and
    /// 541 to 590, of 10 to 60: with more, hardly more objects are found, in more time.
    static constexpr std::size_t most = 20;

    explicit pose_search(const surface_model& model) : model_(model) {
        constexpr std::size_t samples = 96;  // chosen for speed: results depend on it little
        constexpr double lowest = 0.08;      // [m]; the floor's band, and a part of a voxel
        std::vector<std::size_t> above;
        for (std::size_t i = 0; i < model.points().size(); ++i)
            if (model.points()[i].z() >= lowest) above.push_back(i);
        const std::size_t n = std::min(samples, above.size());
        for (std::size_t k = 0; k < n; ++k) samples_.push_back(above[k * above.size() / n]);
    }

    /// The places of highest score, in the frame of the ground, without votes.
    /// @param object  its number
    [[nodiscard]] std::vector<object_place> operator()(const observed_space& space,
                                                       std::size_t object) const {
        if (samples_.empty()) return {};  // nothing above the band of the floor
        std::vector<scored> good;
        const int order = model_.symmetry().order;
        const int headings = order == vertical_symmetry::any_turn ? 1 : 1 + (full_turn - 1) / order;
        for (int t = 0; t < headings; ++t) score(space, t, good);
        std::ranges::stable_sort(good, std::greater{}, &scored::sum);
        std::vector<scored> best;
        for (const scored& g : good) {
            if (best.size() == most) break;
            if (std::ranges::none_of(best, [&](const scored& b) { return is_same(g, b); }))
                best.push_back(g);
        }
        std::vector<object_place> places;
        for (const scored& b : best)
            places.push_back({object, rigid_motion::on_ground(b.x, b.y, b.heading), 0.0});
        return places;
    }

  private:
    static constexpr int full_turn = 24;  // headings; chosen: 6 cm at 50 cm from the middle

    struct scored {
        double x, y;  ///< [m]
        angle heading;
        int sum;
    };

    /// All places at one heading whose score per sample is `least` or more.
    void score(const observed_space& space, int turn, std::vector<scored>& good) const {
        constexpr std::size_t stride = 2;  // voxels between places
        constexpr double least = 0.25;     // chosen: of 2 at most; objects hide half of themselves
        const angle heading = radians(2.0 * std::numbers::pi * turn / full_turn);
        const rigid_motion turned = rigid_motion::on_ground(0.0, 0.0, heading);
        constexpr double level = 0.7;  // chosen: cosine of 45 degrees
        std::vector<std::ptrdiff_t> steps;
        for (const std::size_t i : samples_)
            steps.push_back(space.step_to(std::abs(model_.normals()[i].normal.z()) > level,
                                          turned.point_out(model_.points()[i])));
        const int needed = static_cast<int>(std::ceil(least * static_cast<double>(steps.size())));
        for (std::size_t i = space.begin(0); i < space.end(0); i += stride) {
            for (std::size_t j = space.begin(1); j < space.end(1); j += stride) {
                const std::int8_t* value = space.column(i, j);
                int sum = 0;
                auto open = static_cast<int>(steps.size());
                for (const std::ptrdiff_t step : steps) {
                    sum += value[step];
                    --open;
                    if (sum + observed_space::occupied * open < needed) break;
                }
                if (open == 0 && sum >= needed)
                    good.push_back({space.middle(0, i), space.middle(1, j), heading, sum});
            }
        }
    }

    [[nodiscard]] bool is_same(const scored& a, const scored& b) const {
        constexpr double apart = 0.25;         // chosen: half the width of a chair [m]
        constexpr angle turn = degrees(22.5);  // chosen: less than two headings
        return std::hypot(a.x - b.x, a.y - b.y) < apart &&
               model_.symmetry().difference(a.heading, b.heading) < turn;
    }

    const surface_model& model_;
    std::vector<std::size_t> samples_;
};

/// Searches all objects around some cells, in the frame of the ground, but those that are larger
/// than 4 m: these are found by votes only.
/// @param frame  of the ground in that of the scan
/// @return places in the frame of the scan
/// Complexity: O(n + p (r + 8 m)^2 (h i + o)) for n cells in p pieces of 8 m, objects of reach r
/// and height h, i view points (times walls, if there are any) and o objects.
[[nodiscard]] inline std::vector<object_place> search_poses(
    std::span<const ground_cell> cells, const rigid_motion& frame, const visibility& seen,
    std::span<const wall> walls, std::span<const surface_model> surfaces, const auto& run) {
    constexpr double piece = 8.0;    // [m]; chosen: one for most rooms
    constexpr double largest = 4.0;  // [m]; chosen: for larger ones memory grows with their cube
    double reach = 0.0, height = 0.0;
    std::vector<std::pair<std::size_t, pose_search>> searches;
    for (std::size_t o = 0; o < surfaces.size(); ++o) {
        const surface_model& s = surfaces[o];
        double own = 0.0;
        for (const double x : {s.low().x(), s.high().x()})
            for (const double y : {s.low().y(), s.high().y()})
                own = std::max(own, std::hypot(x, y));
        if (std::max(own, s.high().z()) > largest) continue;
        reach = std::max(reach, own);
        height = std::max(height, s.high().z());
        searches.emplace_back(o, pose_search(s));
    }
    if (cells.empty() || searches.empty()) return {};
    // Piece by piece, so that memory does not grow with the extent of the scan: a cell is in each
    // piece where an object may stand that has it.
    std::array<double, 2> low{}, extent{};
    for (int a = 0; a < 2; ++a) {
        const auto [least, most] =
            std::ranges::minmax(cells, {}, [a](const ground_cell& c) { return c.at[a]; });
        low[static_cast<std::size_t>(a)] = least.at[a];
        extent[static_cast<std::size_t>(a)] = most.at[a] - least.at[a];
    }
    std::map<std::array<std::int64_t, 2>, std::vector<ground_cell>> pieces;
    for (const ground_cell& c : cells) {
        std::array<std::int64_t, 2> from{}, to{};
        for (std::size_t a = 0; a < 2; ++a) {
            const double x = c.at[static_cast<int>(a)] - low[a];
            from[a] = static_cast<std::int64_t>(std::floor(std::max(0.0, x - reach) / piece));
            to[a] = static_cast<std::int64_t>(std::floor(std::min(extent[a], x + reach) / piece));
        }
        for (std::int64_t i = from[0]; i <= to[0]; ++i)
            for (std::int64_t j = from[1]; j <= to[1]; ++j) pieces[{i, j}].push_back(c);
    }
    std::vector<object_place> places;
    for (const auto& of_piece : pieces) {
        const observed_space space(of_piece.second, frame, seen, walls, reach, height, run);
        std::vector<std::vector<object_place>> found(searches.size());
        run(searches.size(),
            [&](std::size_t i) { found[i] = searches[i].second(space, searches[i].first); });
        for (const auto& of_object : found) {
            for (const object_place& p : of_object)
                places.push_back({p.object, frame * p.pose, p.votes});
        }
    }
    return places;
}

}  // namespace gnomon::recognition::detail

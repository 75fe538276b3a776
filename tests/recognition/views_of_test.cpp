// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "recognition/some_views.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace rec = gnomon::recognition;

namespace {

/// Boards at random places, and single points without a segment.
some_views::cloud scattered_boards(std::size_t boards, double room, std::uint64_t seed,
                                   const Eigen::Vector3d& by = {0.0, 0.0, 0.0}) {
    gnomon::random_stream random(seed);
    some_views::cloud c;
    for (std::size_t i = 0; i < boards; ++i)
        c.add_board(
            {random.uniform(0.0, room), random.uniform(0.0, room), random.uniform(0.2, 1.0)},
            {0.1, 0.0, 0.0}, {0.0, 0.1, 0.05}, 20 + static_cast<int>(random.below(20)), random);
    for (std::size_t i = 0; i < 3 * boards; ++i)
        c.add({random.uniform(0.0, room), random.uniform(0.0, room), random.uniform(0.0, 1.0)},
              {0.0, 0.0, 0.0}, gnomon::unlabeled);
    c.move(Eigen::Matrix3d::Identity(), by);
    return c;
}

std::vector<rec::view> views_in(const some_views::cloud& c, const rec::views_of_options& options) {
    return rec::views_of(c.points, c.surface, gnomon::segments(c.labels), options);
}

/// The segments of each view.
std::set<std::set<std::int32_t>> segments_of_views(const std::vector<rec::view>& views) {
    std::set<std::set<std::int32_t>> groups;
    for (const auto& v : views) {
        std::set<std::int32_t> group;
        for (const auto& p : v.parts) group.insert(p.segment);
        groups.insert(group);
    }
    return groups;
}

/// Oracle: distances of all pairs of points, and components by repeated union.
struct grouping_oracle {
    explicit grouping_oracle(const some_views::cloud& c, double gap) : group(n_of(c)) {
        for (std::size_t s = 0; s < group.size(); ++s) group[s] = static_cast<std::int32_t>(s);
        for (std::size_t i = 0; i < c.points.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (c.labels[i] < 0 || c.labels[j] < 0) continue;
                if (!((c.points[i] - c.points[j]).norm() <= gap)) continue;
                const auto a = group[static_cast<std::size_t>(c.labels[i])],
                           b = group[static_cast<std::size_t>(c.labels[j])];
                std::replace(group.begin(), group.end(), a, b);
            }
        }
    }
    static std::size_t n_of(const some_views::cloud& c) { return static_cast<std::size_t>(c.next); }

    [[nodiscard]] std::set<std::set<std::int32_t>> groups(std::size_t min_parts) const {
        std::set<std::set<std::int32_t>> found;
        for (const auto g : group) {
            std::set<std::int32_t> members;
            for (std::size_t s = 0; s < group.size(); ++s)
                if (group[s] == g) members.insert(static_cast<std::int32_t>(s));
            if (members.size() >= min_parts) found.insert(members);
        }
        return found;
    }
    std::vector<std::int32_t> group;
};

/// Sec. 5.5.1: components of segments whose nearest points are at most the gap apart.
TEST(views_of, are_connected_components_of_segments) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto c = scattered_boards(14, 2.0, seed);
        for (const double gap : {0.03, 0.10, 0.30}) {
            const grouping_oracle oracle(c, gap);
            for (const std::size_t least : {1u, 2u, 3u})
                EXPECT_EQ(segments_of_views(views_in(c, {.gap = gap, .min_parts = least})),
                          oracle.groups(least))
                    << seed << " " << gap;
        }
    }
}

TEST(views_of, are_the_same_at_utm_coordinates) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto near = scattered_boards(14, 2.0, seed);
        const auto far = scattered_boards(14, 2.0, seed, {4e5, 5e6, 500.0});
        EXPECT_EQ(segments_of_views(views_in(near, {})), segments_of_views(views_in(far, {})));
    }
}

/// A segment whose own points are far apart is one part, and joins the segments near either of its
/// ends.
TEST(views_of, keep_segments_with_gaps_whole) {
    some_views::cloud c;
    gnomon::random_stream random(3);
    for (const double x : {0.0, 1.05, 5.0, 6.05}) {
        c.add_board({x, 0.0, 0.5}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}, 20, random);
    }
    for (auto& label : c.labels) label = label == 2 ? 1 : label == 3 ? 2 : label;
    c.points[20] = {0.06, 0.0, 0.5};  // of the second segment, near the first
    c.points[40] = {6.0, 0.0, 0.5};   // near the last
    EXPECT_EQ(segments_of_views(views_in(c, {})), (std::set<std::set<std::int32_t>>{{0, 1, 2}}));
}

TEST(views_of, do_not_depend_on_threads_and_take_an_index) {
    const auto c = scattered_boards(30, 3.0, 7);
    const gnomon::segments parts(c.labels);
    const rec::views_of_options options{.ground = some_views::floor_plane};
    const auto one = rec::views_of(c.points, c.surface, parts, options);
    const gnomon::spatial_index index(c.points);
    const auto equal = [&](const std::vector<rec::view>& many) {
        ASSERT_EQ(one.size(), many.size());
        for (std::size_t k = 0; k < one.size(); ++k) {
            ASSERT_EQ(one[k].parts.size(), many[k].parts.size());
            for (std::size_t i = 0; i < one[k].parts.size(); ++i) {
                const auto &a = one[k].parts[i], &b = many[k].parts[i];
                EXPECT_EQ(a.segment, b.segment);
                EXPECT_EQ(a.shape.frame.centroid, b.shape.frame.centroid);
                EXPECT_EQ(a.shape.normal, b.shape.normal);
                EXPECT_EQ(a.highest, b.highest);
                EXPECT_EQ(a.profile.band(0, 48).uv, b.profile.band(0, 48).uv);
            }
            EXPECT_EQ(one[k].rest.band(0, 48).uv, many[k].rest.band(0, 48).uv);
        }
    };
    for (const unsigned n : {1u, 2u, 4u})
        equal(rec::views_of(c.points, c.surface, parts, options, gnomon::threads{n}));
    equal(rec::views_of(index, c.surface, parts, options));
}

TEST(views_of, have_no_gap_or_an_infinite_one) {
    auto c = scattered_boards(6, 5.0, 8);
    const auto all = views_in(c, {.gap = rec::infinite_gap});
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].parts.size(), 6u);
    EXPECT_TRUE(views_in(c, {.gap = 0.0}).empty());
    EXPECT_EQ(views_in(c, {.gap = 0.0, .min_parts = 1}).size(), 6u);
    c.add(c.points[0], {0.0, 0.0, 1.0}, c.labels[0] == 5 ? 4 : 5);  // one place, two segments
    ASSERT_EQ(views_in(c, {.gap = 0.0}).size(), 1u);
    EXPECT_EQ(views_in(c, {.gap = 0.0})[0].parts.size(), 2u);
}

/// Oracle for all points: those of a part, those near one, and others.
TEST(views_of, have_the_profile_of_all_their_points) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto c = scattered_boards(12, 1.5, seed);
        for (const double gap : {0.1, rec::infinite_gap}) {
            const auto views =
                views_in(c, {.gap = gap, .min_parts = 1, .ground = some_views::floor_plane});
            for (const auto& v : views) {
                std::set<std::int32_t> own;
                for (const auto& p : v.parts) own.insert(p.segment);
                double near = 0.0;
                for (std::size_t i = 0; i < c.points.size(); ++i) {
                    if (c.labels[i] >= 0 || c.points[i].z() < 0.05) continue;
                    double least = rec::infinite_gap;
                    std::int32_t nearest = -1;
                    for (std::size_t j = 0; j < c.points.size(); ++j) {
                        if (c.labels[j] < 0) continue;
                        const double d = (c.points[i] - c.points[j]).norm();
                        if (d < least) {
                            least = d;
                            nearest = c.labels[j];
                        }
                    }
                    near += least <= gap && own.contains(nearest);
                }
                EXPECT_EQ(v.rest.band(0, rec::height_profile::count).points, near);
                for (const auto& p : v.parts) {
                    EXPECT_EQ(p.profile.band(0, rec::height_profile::count).points,
                              static_cast<double>(p.shape.points));
                    double low = 1e9, high = -1e9;
                    for (std::size_t i = 0; i < c.points.size(); ++i) {
                        if (c.labels[i] != p.segment) continue;
                        low = std::min(low, c.points[i].z());
                        high = std::max(high, c.points[i].z());
                    }
                    EXPECT_EQ(p.lowest, low);
                    EXPECT_EQ(p.highest, high);
                }
            }
        }
    }
}

TEST(views_of, have_no_heights_without_ground) {
    for (const auto& v : views_in(scattered_boards(12, 1.5, 2), {.min_parts = 1})) {
        EXPECT_FALSE(v.ground);
        EXPECT_EQ(v.rest.band(0, rec::height_profile::count).points, 0.0);
        for (const auto& p : v.parts) {
            EXPECT_EQ(p.lowest, 0.0);
            EXPECT_EQ(p.highest, 0.0);
            EXPECT_EQ(p.profile.band(0, rec::height_profile::count).points, 0.0);
        }
    }
}

TEST(views_of, ignore_points_that_are_not_finite) {
    auto c = scattered_boards(10, 1.5, 4);
    const rec::views_of_options options{.min_parts = 1, .ground = some_views::floor_plane};
    const auto before = views_in(c, options);
    for (const double bad : {some_views::nan, some_views::infinity, -some_views::infinity}) {
        for (std::int32_t label = -1; label < 3; ++label) {
            c.add({0.5, bad, 0.3}, {0.0, 0.0, 1.0}, label);
            c.add({bad, 0.5, bad}, {bad, 0.0, 0.0}, label);
        }
    }
    const auto after = views_in(c, options);
    ASSERT_EQ(segments_of_views(after), segments_of_views(before));
    for (std::size_t k = 0; k < after.size(); ++k) {
        EXPECT_EQ(after[k].rest.band(0, 48).points, before[k].rest.band(0, 48).points);
        for (std::size_t i = 0; i < after[k].parts.size(); ++i) {
            EXPECT_EQ(after[k].parts[i].shape.points, before[k].parts[i].shape.points);
            EXPECT_EQ(after[k].parts[i].highest, before[k].parts[i].highest);
        }
    }
}

/// Segments without a normal are points without a part; they belong to the rest of a view.
TEST(views_of, take_lines_as_points_without_a_part) {
    some_views::cloud c;
    gnomon::random_stream random(5);
    c.add_board({0.0, 0.0, 0.5}, {0.2, 0.0, 0.0}, {0.0, 0.2, 0.0}, 60, random);
    for (int i = 0; i < 10; ++i) c.add({0.25, 0.0, 0.5 + 0.01 * i}, {1.0, 0.0, 0.0}, 1);
    for (int i = 0; i < 3; ++i) c.add({some_views::nan, 0.0, 0.5}, {1.0, 0.0, 0.0}, 2);
    const auto views = views_in(c, {.gap = 0.5, .min_parts = 1, .ground = some_views::floor_plane});
    ASSERT_EQ(views.size(), 1u);
    EXPECT_EQ(views[0].parts.size(), 1u);
    EXPECT_EQ(views[0].rest.band(0, rec::height_profile::count).points, 10.0);
    EXPECT_TRUE(views_in(c, {}).empty());
}

TEST(views_of, are_none_without_points_or_segments) {
    EXPECT_TRUE(views_in(some_views::cloud{}, {}).empty());
    EXPECT_TRUE(views_in(some_views::cloud{}, {.gap = rec::infinite_gap}).empty());
    some_views::cloud c;
    for (int i = 0; i < 9; ++i) c.add({0.1 * i, 0.0, 0.0}, {0.0, 0.0, 1.0}, gnomon::unlabeled);
    EXPECT_TRUE(views_in(c, {.min_parts = 0, .ground = some_views::floor_plane}).empty());
}

TEST(views_of, keep_numbers_of_segments_with_gaps) {
    auto c = scattered_boards(4, 0.3, 6);
    for (auto& label : c.labels)
        if (label >= 0) label = 3 * label + 2;
    for (const auto& v : views_in(c, {.gap = 0.5}))
        for (const auto& p : v.parts) EXPECT_EQ(p.segment % 3, 2);
    EXPECT_EQ(views_in(c, {.gap = rec::infinite_gap}).front().parts.size(), 4u);
}

TEST(views_of, refuse_what_does_not_fit) {
    auto c = scattered_boards(4, 1.0, 1);
    for (const double gap : {-0.1, some_views::nan})
        EXPECT_THROW((void)views_in(c, {.gap = gap}), std::invalid_argument);
    for (const double length : {0.0, 2.0, some_views::nan})
        EXPECT_THROW((void)views_in(c, {.ground = gnomon::plane{{0.0, 0.0, length}, 0.0}}),
                     std::invalid_argument);
    EXPECT_THROW((void)views_in(c, {.ground = gnomon::plane{{0.0, 0.0, 1.0}, some_views::nan}}),
                 std::invalid_argument);
    auto few_normals = c;
    few_normals.surface.pop_back();
    EXPECT_THROW((void)views_in(few_normals, {}), std::invalid_argument);
    auto few_labels = c;
    few_labels.labels.pop_back();
    EXPECT_THROW((void)views_in(few_labels, {}), std::invalid_argument);
}

/// Also where no segment is left to be measured.
TEST(views_of, refuse_normals_of_other_points_without_segments) {
    auto c = scattered_boards(2, 1.0, 1);
    c.labels.assign(c.labels.size(), gnomon::unlabeled);
    c.surface.pop_back();
    EXPECT_THROW((void)views_in(c, {}), std::invalid_argument);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/segmentation/segments.hpp>

namespace {

using index_list = std::vector<gnomon::point_index>;

index_list members(const gnomon::segments& s, std::size_t label) {
    return {s[label].begin(), s[label].end()};
}

TEST(segments, are_labels_and_groups_at_once) {
    const gnomon::segments s(std::vector<std::int32_t>{1, 0, -1, 1, 0, 1});
    ASSERT_EQ(s.size(), 2u);
    EXPECT_EQ(members(s, 0), (index_list{1, 4}));
    EXPECT_EQ(members(s, 1), (index_list{0, 3, 5}));
    EXPECT_EQ(s.labels()[2], gnomon::unlabeled);
}

TEST(segments, can_be_empty) {
    EXPECT_TRUE(gnomon::segments().empty());
    EXPECT_TRUE(gnomon::segments(std::vector<std::int32_t>{}).empty());
    EXPECT_TRUE(gnomon::segments(std::vector<std::int32_t>{-1, -1}).empty());
}

TEST(segments, refuse_labels_that_mean_nothing) {
    EXPECT_THROW(gnomon::segments(std::vector<std::int32_t>{0, -2}), std::invalid_argument);
}

TEST(segments, come_largest_first_and_by_their_smallest_point) {
    gnomon::detail::union_find sets(8);  // {0} {1,4} {2,5,7} {3,6}
    sets.unite(1, 4);
    sets.unite(7, 5);
    sets.unite(2, 7);
    sets.unite(6, 3);
    const auto everyone = [](std::size_t) { return true; };
    const auto segments_of = [&sets](std::size_t min_points, const auto& counts) {
        return gnomon::detail::segments_of(
            gnomon::detail::labels_of_sets(sets, min_points, counts));
    };
    const auto s = segments_of(2, everyone);
    ASSERT_EQ(s.size(), 3u);
    EXPECT_EQ(members(s, 0), (index_list{2, 5, 7}));
    EXPECT_EQ(members(s, 1), (index_list{1, 4}));
    EXPECT_EQ(members(s, 2), (index_list{3, 6}));
    EXPECT_EQ(s.labels()[0], gnomon::unlabeled);
    EXPECT_EQ(segments_of(1, everyone).size(), 4u);
    EXPECT_EQ(segments_of(0, [](std::size_t i) { return i != 0; }).size(), 3u);
}

/// Law: assign(labels) gives what the constructor gives for these labels, whatever the segments
/// were.
TEST(segments, assigned_are_as_constructed) {
    const std::vector<std::vector<std::int32_t>> labelings{
        {0, 1, -1, 1, 2, 0, 0}, {}, {-1, -1}, {3, -1, 3}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {5}};
    gnomon::segments reused;
    for (const auto& labels : labelings) {
        reused.assign(labels);
        EXPECT_EQ(reused, gnomon::segments(labels));
    }
    const auto before = reused;
    const std::vector<std::int32_t> wrong{0, -2};
    EXPECT_THROW(reused.assign(wrong), std::invalid_argument);
    EXPECT_EQ(reused, before);
}

TEST(segments, assigning_reuses_the_memory) {
    const std::vector<std::int32_t> labels{0, 1, 1, -1, 0};
    gnomon::segments reused(labels);
    const auto* const place = reused.labels().data();
    const auto* const members = reused[0].data();
    const std::vector<std::int32_t> others{1, 1, 0, 0, -1};
    reused.assign(others);
    EXPECT_EQ(reused.labels().data(), place);
    EXPECT_EQ(reused[0].data(), members);
}

/// Numbered by size, equal ones by their smallest point; labels without points are removed, and
/// those of few.
TEST(number_by_size, renumbers) {
    std::vector<std::int32_t> labels{4, 2, -1, 2, 7, 0, 4, 4};
    gnomon::detail::number_by_size(labels);
    EXPECT_EQ(labels, (std::vector<std::int32_t>{0, 1, -1, 1, 2, 3, 0, 0}));
    gnomon::detail::number_by_size(labels, 2);
    EXPECT_EQ(labels, (std::vector<std::int32_t>{0, 1, -1, 1, -1, -1, 0, 0}));
}

}  // namespace

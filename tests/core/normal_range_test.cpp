// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <deque>
#include <limits>
#include <list>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/normal_range_laws.hpp"
#include <gnomon/core/normal_range.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/feature_preserving.hpp>
#include <gnomon/normals/plane_eif.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

struct mine {
    Eigen::Vector3d normal;
};
struct mine_in_float {
    Eigen::Vector3f normal;
};

static_assert(gnomon::normal_range<std::vector<mine>>);
static_assert(gnomon::normal_range<std::deque<mine>> && gnomon::normal_range<std::span<mine>>);
static_assert(!gnomon::normal_range<std::vector<mine_in_float>>);  // say .cast<double>()
static_assert(!gnomon::normal_range<std::vector<Eigen::Vector3d>>);
static_assert(!gnomon::normal_range<std::list<mine>>);  // no access by index
static_assert(!gnomon::normal_range<mine>);
static_assert(!gnomon::surfel_range<std::vector<mine>>);  // no mean distance

const std::vector<mine> some_normals{{{0.0, 0.6, 0.8}}, {{0.0, 0.0, 0.0}}, {{-1.0, 0.0, 0.0}}};

TEST(normal_range, own_structs_obey_the_laws) {
    laws::normal_range_laws(some_normals);
    laws::normal_range_laws(std::span(some_normals));
    laws::normal_range_laws(std::deque<mine>(some_normals.begin(), some_normals.end()));
}

TEST(normal_range, estimated_surfaces_obey_the_laws) {
    const gnomon::knn neighbors{.k = 12};
    auto all = clouds::degenerate();
    all.push_back({"sheet", clouds::sheet(500, 1)});
    for (const auto& [name, points] : all) {
        SCOPED_TRACE(name);
        laws::surfel_range_laws(gnomon::estimate_normals(points, neighbors, gnomon::plane_pca{}));
        laws::surfel_range_laws(gnomon::estimate_normals(points, neighbors, gnomon::plane_eif{}));
    }
    laws::surfel_range_laws(
        gnomon::estimate_normals(clouds::sheet(500, 1), gnomon::feature_preserving{}));
}

TEST(normal_range, missing_is_zero_and_nothing_else) {
    EXPECT_TRUE(gnomon::is_missing({0.0, -0.0, 0.0}));
    EXPECT_FALSE(gnomon::is_missing({0.0, 0.0, std::numeric_limits<double>::denorm_min()}));
    EXPECT_FALSE(gnomon::is_missing({1.0, 0.0, 0.0}));
}

}  // namespace

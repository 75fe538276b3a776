// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/core/detail/pooled_run.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::detail::memory_pool, gnomon::detail::pool_scope, gnomon::detail::scratch;

TEST(scratch, is_from_the_pool_of_the_innermost_scope) {
    const auto owner = memory_pool::make(), another = memory_pool::make();
    memory_pool &pool = *owner, &other = *another;
    scratch<int> outside(10);
    EXPECT_EQ(outside.get_allocator().pool(), nullptr);
    {
        const pool_scope scope(&pool);
        scratch<int> within(10, 3);
        EXPECT_EQ(within.get_allocator().pool(), &pool);
        {
            const pool_scope inner(&other);
            EXPECT_EQ(scratch<double>().get_allocator().pool(), &other);
            const scratch<int> copy = within;
            EXPECT_EQ(copy.get_allocator().pool(), &other) << "copies are where they are made";
            EXPECT_EQ(copy, within);
            const scratch<int> moved = std::move(within);
            EXPECT_EQ(moved.get_allocator().pool(), &pool) << "what is moved stays";
            const pool_scope none(nullptr);
            EXPECT_EQ(scratch<int>(5).get_allocator().pool(), nullptr);
        }
        EXPECT_EQ(scratch<char>().get_allocator().pool(), &pool);
        outside = scratch<int>(20, 4);
        EXPECT_EQ(outside.get_allocator().pool(), &pool) << "the memory is moved with its pool";
        outside = scratch<int>();
        outside.shrink_to_fit();
    }
    EXPECT_EQ(gnomon::detail::current_pool(), nullptr);
}

/// Vectors of one size are in the memory of the last call.
TEST(scratch, takes_the_same_memory_again) {
    const auto owner = memory_pool::make();
    memory_pool& pool = *owner;
    const pool_scope scope(&pool);
    std::set<const double*> places;
    for (int call = 0; call < 20; ++call) {
        const scratch<double> a(1000), b(5000);
        places.insert(a.data());
        places.insert(b.data());
    }
    EXPECT_EQ(places.size(), 2u);
}

TEST(pooled_run, gives_the_pool_to_all_threads) {
    const auto owner = memory_pool::make();
    memory_pool& pool = *owner;
    const gnomon::team team(3);
    const gnomon::detail::pooled_run run(team, pool);
    std::vector<gnomon::detail::memory_source*> seen(100, nullptr);
    run(seen.size(), [&](std::size_t c) { seen[c] = scratch<int>().get_allocator().pool(); });
    for (const auto* const p : seen) EXPECT_EQ(p, &pool);
    EXPECT_EQ(gnomon::detail::current_pool(), nullptr);
}

/// A value that a policy or a callback has made may live longer than the owner of the pool.
TEST(scratch, may_live_longer_than_the_owner_of_its_pool) {
    std::optional<scratch<int>> kept;
    {
        const auto owner = memory_pool::make();
        const pool_scope scope(owner.get());
        kept.emplace(1000, 7);
        const scratch<int> returned(10);
    }
    EXPECT_EQ((*kept)[999], 7);
    *kept = scratch<int>(2000, 8);
    EXPECT_EQ((*kept)[1999], 8);
}

/// A user's policy may keep a subset of the index longer than the call in which it made it.
TEST(scratch, is_not_what_values_of_users_are_made_of) {
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    const std::vector<gnomon::point_index> some{5, 7};
    const gnomon::spatial_index index(points);
    std::optional<gnomon::detail::indexed_subset> kept;
    {
        const auto owner = memory_pool::make();
        memory_pool& pool = *owner;
        const pool_scope scope(&pool);
        kept.emplace(index.subset(some));
    }
    EXPECT_EQ(kept->nearest({1, 2, 3}, 3).size(), 2u);
}

}  // namespace

// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/core/detail/pooled_run.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::detail::memory_pool, gnomon::detail::pool_scope, gnomon::detail::scratch;

/// Law: a block holds the bytes that were asked for, and is aligned.
TEST(memory_pool, gives_blocks_of_any_size) {
    memory_pool pool;
    std::vector<void*> blocks;
    std::vector<std::size_t> sizes;
    for (std::size_t size = 0; size < 3'000'000; size = size * 9 / 8 + 1) {
        void* const block = pool.allocate(size);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % memory_pool::alignment, 0u);
        std::memset(block, static_cast<int>(blocks.size()), size);
        blocks.push_back(block);
        sizes.push_back(size);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const auto* const bytes = static_cast<const unsigned char*>(blocks[b]);
        for (std::size_t i = 0; i < sizes[b]; ++i)
            ASSERT_EQ(bytes[i], static_cast<unsigned char>(b)) << sizes[b];
        pool.deallocate(blocks[b]);
    }
}

TEST(memory_pool, reuses_blocks) {
    memory_pool pool;
    void* const small = pool.allocate(100);
    void* const large = pool.allocate(100'000);
    pool.deallocate(small);
    pool.deallocate(large);
    EXPECT_EQ(pool.allocate(90'000), large) << "of about this size";
    EXPECT_EQ(pool.allocate(128), small);
    pool.deallocate(large);
    void* const medium = pool.allocate(20'000);
    EXPECT_EQ(medium, large) << "a larger one rather than a new one";
    void* const tiny = pool.allocate(8);
    EXPECT_NE(tiny, small) << "in use";
    pool.deallocate(medium);
    void* const other = pool.allocate(8);
    EXPECT_NE(other, large) << "more than 16 times as large";
    for (void* const block : {small, tiny, other}) pool.deallocate(block);
}

TEST(scratch, is_from_the_pool_of_the_innermost_scope) {
    memory_pool pool, other;
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
    memory_pool pool;
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
    memory_pool pool;
    const gnomon::team team(3);
    const gnomon::detail::pooled_run run(team, pool);
    std::vector<memory_pool*> seen(100, nullptr);
    run(seen.size(), [&](std::size_t c) { seen[c] = scratch<int>().get_allocator().pool(); });
    for (memory_pool* const p : seen) EXPECT_EQ(p, &pool);
    EXPECT_EQ(gnomon::detail::current_pool(), nullptr);
}

/// A user's policy may keep a subset of the index longer than the call in which it made it.
TEST(scratch, is_not_what_values_of_users_are_made_of) {
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    const std::vector<gnomon::point_index> some{5, 7};
    const gnomon::spatial_index index(points);
    std::optional<gnomon::detail::indexed_subset> kept;
    {
        memory_pool pool;
        const pool_scope scope(&pool);
        kept.emplace(index.subset(some));
    }
    EXPECT_EQ(kept->nearest({1, 2, 3}, 3).size(), 2u);
}

/// Many threads take blocks, write and return them.
TEST(memory_pool, is_thread_safe) {
    memory_pool pool;
    const gnomon::team team(4);
    const gnomon::detail::pooled_run run(team, pool);
    run(2000, [](std::size_t c) {
        scratch<std::size_t> values;
        for (std::size_t i = 0; i < c % 97; ++i) values.push_back(c);
        for (const std::size_t v : values) EXPECT_EQ(v, c);
    });
}

}  // namespace

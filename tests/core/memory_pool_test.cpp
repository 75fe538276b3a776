// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/core/detail/pooled_run.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>

namespace {

using gnomon::detail::memory_pool, gnomon::detail::pool_scope, gnomon::detail::scratch,
    gnomon::detail::work_scope;

/// Law: a block holds the bytes that were asked for, and is aligned.
TEST(memory_pool, gives_blocks_of_any_size) {
    const auto owner = memory_pool::make();
    memory_pool& pool = *owner;
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
    const auto owner = memory_pool::make();
    memory_pool& pool = *owner;
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

/// Two pieces of work begin and end, so that the pool serves two threads.
void work_twice(memory_pool& pool) {
    const work_scope first(pool);
    const work_scope second(pool);
}

/// After work on two threads, there are blocks for two such pieces of work at a time, and others do
/// not take them: the order in which they ran makes no difference.
TEST(memory_pool, sets_aside_what_work_may_request) {
    const auto owner = memory_pool::make();
    memory_pool& pool = *owner;
    work_twice(pool);
    {
        const work_scope alone(pool);
        const scratch<char> a(1000), b(1000);
    }
    EXPECT_EQ(pool.free_blocks(), 4u);
    {
        const pool_scope caller(&pool);
        const scratch<char> less(900), equal(1000);
        EXPECT_EQ(pool.free_blocks(), 4u) << "blocks set aside are not for others";
        const work_scope first(pool);
        const scratch<char> a(1000), b(1000);
        const work_scope second(pool);
        const scratch<char> c(1000), d(1000);
        EXPECT_EQ(pool.free_blocks(), 0u);
    }
    EXPECT_EQ(pool.free_blocks(), 6u);
}

/// What work leaves to its caller is not missing in the next call.
TEST(memory_pool, replaces_what_work_leaves_to_its_caller) {
    const auto owner = memory_pool::make();
    memory_pool& pool = *owner;
    work_twice(pool);
    for (int call = 0; call < 3; ++call) {
        std::optional<scratch<char>> left;
        {
            const work_scope work(pool);
            left.emplace(1000);
        }
        EXPECT_EQ(pool.free_blocks(), 2u) << "one for each thread";
        left.reset();
        EXPECT_EQ(pool.free_blocks(), 3u);
    }
}

/// Many threads take blocks, write and return them.
TEST(memory_pool, is_thread_safe) {
    const auto owner = memory_pool::make();
    memory_pool& pool = *owner;
    const gnomon::team team(4);
    const gnomon::detail::pooled_run run(team, pool);
    run(2000, [](std::size_t c) {
        scratch<std::size_t> values;
        for (std::size_t i = 0; i < c % 97; ++i) values.push_back(c);
        for (const std::size_t v : values) EXPECT_EQ(v, c);
    });
}

}  // namespace

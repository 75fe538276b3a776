// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/detail/pooled_run.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>

namespace {

using gnomon::detail::memory_pool, gnomon::detail::scratch;

/// Law: a block holds the bytes that were asked for, and is aligned.
TEST(memory_pool, gives_blocks_of_any_size) {
    memory_pool pool;
    std::vector<void*> blocks;
    std::vector<std::size_t> sizes;
    for (std::size_t size = 0; size < 3'000'000; size = size * 9 / 8 + 1) {
        void* const block = pool.allocate(size, nullptr);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % memory_pool::alignment, 0u);
        std::memset(block, static_cast<int>(blocks.size()), size);
        blocks.push_back(block);
        sizes.push_back(size);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const auto* const bytes = static_cast<const unsigned char*>(blocks[b]);
        for (std::size_t i = 0; i < sizes[b]; ++i)
            ASSERT_EQ(bytes[i], static_cast<unsigned char>(b)) << sizes[b];
        pool.deallocate(blocks[b], nullptr);
    }
}

TEST(memory_pool, reuses_blocks) {
    memory_pool pool;
    void* const small = pool.allocate(100, nullptr);
    void* const large = pool.allocate(100'000, nullptr);
    pool.deallocate(small, nullptr);
    pool.deallocate(large, nullptr);
    EXPECT_EQ(pool.allocate(90'000, nullptr), large) << "of about this size";
    EXPECT_EQ(pool.allocate(128, nullptr), small);
    pool.deallocate(large, nullptr);
    void* const medium = pool.allocate(20'000, nullptr);
    EXPECT_EQ(medium, large) << "a larger one rather than a new one";
    void* const tiny = pool.allocate(8, nullptr);
    EXPECT_NE(tiny, small) << "in use";
    pool.deallocate(medium, nullptr);
    void* const other = pool.allocate(8, nullptr);
    EXPECT_NE(other, large) << "more than 16 times as large";
    for (void* const block : {small, tiny, other}) pool.deallocate(block, nullptr);
}

/// After work on two threads, what one piece of work held is there for two at a time, and others do
/// not take it: in which order they ran does not tell.
TEST(memory_pool, sets_aside_what_work_may_ask_for) {
    memory_pool pool;
    memory_pool::holdings a{}, b{};
    pool.begin();
    pool.begin();
    pool.end(a);
    pool.end(b);
    pool.begin();  // alone
    void* const first = pool.allocate(1000, &a);
    void* const second = pool.allocate(1000, &a);
    pool.deallocate(first, &a);
    pool.deallocate(second, &a);
    pool.end(a);
    EXPECT_EQ(pool.free_blocks(), 4u);
    pool.begin();
    pool.begin();
    const std::vector<void*> outer{pool.allocate(900, nullptr), pool.allocate(1000, nullptr)};
    EXPECT_EQ(pool.free_blocks(), 4u) << "blocks set aside are not for others";
    const std::vector<void*> held{pool.allocate(1000, &a), pool.allocate(1000, &b),
                                  pool.allocate(1000, &a), pool.allocate(1000, &b)};
    EXPECT_EQ(pool.free_blocks(), 0u);
    for (std::size_t i = 0; i < held.size(); ++i) pool.deallocate(held[i], i % 2 == 0 ? &a : &b);
    pool.end(a);
    pool.end(b);
    for (void* const block : outer) pool.deallocate(block, nullptr);
    EXPECT_EQ(pool.free_blocks(), held.size() + outer.size());
}

/// What work leaves to its caller does not lack in the next call.
TEST(memory_pool, replaces_what_work_leaves_to_its_caller) {
    memory_pool pool;
    memory_pool::holdings first{}, second{};
    pool.begin();
    pool.begin();
    void* const kept = pool.allocate(1000, &first);
    pool.end(first);
    pool.end(second);
    EXPECT_EQ(pool.free_blocks(), 2u) << "one for each thread";
    for (int call = 0; call < 3; ++call) {
        first = {};
        second = {};
        pool.begin();
        pool.begin();
        void* const a = pool.allocate(1000, &first);
        void* const b = pool.allocate(1000, &second);
        EXPECT_NE(a, b);
        pool.deallocate(a, &first);
        pool.end(first);
        pool.end(second);
        EXPECT_EQ(pool.free_blocks(), 2u) << "b is its caller's now; two may work all the same";
        pool.deallocate(b, nullptr);
    }
    pool.deallocate(kept, nullptr);
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

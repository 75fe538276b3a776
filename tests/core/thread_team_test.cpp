// SPDX-License-Identifier: BSL-1.0
#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>

namespace {

using gnomon::detail::staying, gnomon::detail::thread_team;

static_assert(gnomon::execution<gnomon::team>);

/// Law: whatever the team did before, each call does its own work, all of it and once. The work
/// lies on the stack, so that a helper who came too late would be seen to touch it.
TEST(thread_team, does_each_of_many_works_once) {
    for (const std::size_t size : {0u, 1u, 2u, 4u, 9u}) {
        thread_team team(size);
        for (std::size_t call = 0; call < 3000; ++call) {
            const std::size_t chunks = call % 7 * (call % 3);
            std::vector<int> visits(chunks, 0);
            team(chunks, [&](std::size_t c) { ++visits[c]; });
            ASSERT_EQ(visits, std::vector<int>(chunks, 1)) << size << " threads, call " << call;
        }
    }
}

/// Law: what one step wrote, every thread of the next step sees.
TEST(thread_team, each_step_sees_the_writes_of_the_last) {
    constexpr std::size_t n = 64;
    thread_team team(4);
    std::vector<int> now(n, 0), next(n);
    for (int step = 1; step <= 2000; ++step) {
        team(n, [&](std::size_t c) { next[c] = now[c * 7 % n] + 1; });
        now.swap(next);
        ASSERT_EQ(now, std::vector<int>(n, step));
    }
}

TEST(thread_team, can_be_used_after_an_exception) {
    thread_team team(3);
    for (std::size_t call = 0; call < 100; ++call) {
        std::string what;
        try {
            team(50, [&](std::size_t c) {
                if (c >= call % 50) throw std::runtime_error(std::to_string(c));
            });
        } catch (const std::runtime_error& e) {
            what = e.what();
        }
        ASSERT_EQ(what, std::to_string(call % 50));
        std::atomic<int> done{0};
        team(50, [&](std::size_t) { ++done; });
        ASSERT_EQ(done, 50);
    }
}

/// Each chunk waits for all others, so that none ends unless all threads come.
TEST(thread_team, uses_all_threads_awake_or_asleep) {
    constexpr std::size_t size = 4;
    thread_team team(size);
    for (int call = 0; call < 200; ++call) {
        if (call % 40 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        std::atomic<std::size_t> come{0};
        team(size, [&](std::size_t) {
            ++come;
            while (come < size) std::this_thread::yield();
        });
        ASSERT_EQ(come, size);
    }
}

TEST(thread_team, is_waited_for_however_long_it_takes) {
    thread_team team(4);
    const auto caller = std::this_thread::get_id();
    for (int call = 0; call < 10; ++call) {
        std::atomic<int> come{0}, done{0};
        team(4, [&](std::size_t) {
            ++come;
            while (come < 4) std::this_thread::yield();
            if (std::this_thread::get_id() != caller)
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            ++done;
        });
        ASSERT_EQ(done, 4);
    }
}

TEST(thread_team, can_be_idle_and_nested) {
    { const thread_team idle(4); }
    std::atomic<int> done{0};
    const auto team = staying(gnomon::threads{3});
    team(4, [&](std::size_t) { gnomon::threads{2}(5, [&](std::size_t) { ++done; }); });
    EXPECT_EQ(done, 20);
}

/// As `threads` may, from within its own work and from several threads.
TEST(thread_team, can_be_called_while_it_works) {
    for (const unsigned n : {1u, 2u, 4u}) {
        const auto team = staying(gnomon::threads{n});
        const auto copy = team;
        std::atomic<int> done{0};
        std::vector<std::thread> callers;
        for (int caller = 0; caller < 3; ++caller)
            callers.emplace_back([&] {
                for (int call = 0; call < 100; ++call)
                    team(4, [&](std::size_t) { copy(5, [&](std::size_t) { ++done; }); });
            });
        for (std::thread& caller : callers) caller.join();
        EXPECT_EQ(done, 3 * 100 * 20);
    }
}

TEST(thread_team, is_created_only_for_executions_with_threads) {
    const gnomon::sequential one;
    EXPECT_EQ(&staying(one), &one);
    std::atomic<int> done{0};
    staying(gnomon::threads{1})(7, [&](std::size_t) { ++done; });
    EXPECT_EQ(done, 7);
}

}  // namespace

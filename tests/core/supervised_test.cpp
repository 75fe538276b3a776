// SPDX-License-Identifier: BSL-1.0
#include <atomic>
#include <concepts>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/supervised.hpp>

namespace {

using gnomon::stop_source, gnomon::stop_token, gnomon::supervised;

TEST(stop_token, without_a_source_never_stops) {
    EXPECT_FALSE(stop_token().stop_requested());
    const stop_source source;
    EXPECT_FALSE(source.token().stop_requested());
}

TEST(stop_token, sees_requests_of_its_source_when_copied) {
    stop_source source;
    const stop_token token = source.token(), copy = token;
    source.request_stop();
    EXPECT_TRUE(token.stop_requested() && copy.stop_requested());
    source.reset();
    EXPECT_FALSE(copy.stop_requested());
}

static_assert(gnomon::execution<supervised<gnomon::sequential>>);
static_assert(gnomon::execution<supervised<gnomon::team>>);
/// The threads under any supervision stay from one step to the next.
static_assert(std::same_as<decltype(gnomon::detail::staying(
                               supervised(supervised<gnomon::threads>(gnomon::threads{})))),
                           supervised<gnomon::team>>);

TEST(supervised, runs_each_chunk_once) {
    for (const unsigned t : {1u, 2u, 4u}) {
        std::vector<std::atomic<int>> runs(1000);
        supervised(gnomon::threads{t})(runs.size(), [&](std::size_t c) { ++runs[c]; });
        for (const auto& r : runs) ASSERT_EQ(r, 1);
    }
}

TEST(supervised, stops_between_chunks) {
    for (const unsigned t : {1u, 2u, 4u}) {
        stop_source source;
        std::atomic<int> runs = 0;
        const supervised run(gnomon::threads{t}, source.token());
        EXPECT_THROW(run(100'000,
                         [&](std::size_t) {
                             if (++runs == 10) source.request_stop();
                         }),
                     gnomon::stopped);
        EXPECT_LT(runs, 10 + int(t));
        EXPECT_THROW(run(1, [&](std::size_t) {}), gnomon::stopped);
        source.reset();
        EXPECT_NO_THROW(run(1, [&](std::size_t) {}));
    }
}

TEST(supervised, announces_steps_and_stops_before_them) {
    stop_source source;
    std::vector<std::string> steps;
    const supervised run(
        gnomon::sequential{}, source.token(),
        [&](const char* name, std::size_t step, std::size_t of) {
            steps.push_back(name + std::to_string(step) + "/" + std::to_string(of));
        });
    gnomon::detail::begin_step(gnomon::detail::staying(run), "normals", 1, 2);
    gnomon::detail::begin_step(gnomon::sequential{}, "unheard", 2, 2);
    source.request_stop();
    EXPECT_THROW(gnomon::detail::begin_step(run, "late", 2, 2), gnomon::stopped);
    EXPECT_EQ(steps, std::vector<std::string>{"normals1/2"});
    source.reset();
    gnomon::detail::begin_step(supervised(run), "by another", 1, 1);
    EXPECT_EQ(steps.size(), 2u);
}

}  // namespace

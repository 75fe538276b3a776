// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `execution` concept, for any model: yours, too.
#pragma once

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>

namespace laws {

// [every_chunk_runs_once]
/// run(chunks, work) calls work(c) exactly once for each c < chunks, and all calls have returned
/// when it returns. The same execution can run again.
template <gnomon::execution X>
void every_chunk_runs_once(const X& run) {
    for (const std::size_t chunks : {0u, 1u, 2u, 7u, 100u, 7u}) {
        std::vector<std::atomic<int>> calls(chunks);
        run(chunks, [&](std::size_t c) { ++calls.at(c); });
        for (const auto& count : calls) ASSERT_EQ(count, 1);
    }
}
// [every_chunk_runs_once]

// [points_are_cut_alike]
/// Chunks of points begin at the same points for every execution, so that sums of them are the
/// same bytes.
template <gnomon::execution X>
void points_are_cut_alike(const X& run) {
    for (const std::size_t n : {0u, 1u, 1023u, 1024u, 1025u, 100'000u}) {
        std::vector<std::atomic<int>> visits(n);
        gnomon::detail::for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
            EXPECT_EQ(begin % gnomon::detail::chunk_size, 0u);
            EXPECT_LE(end - begin, gnomon::detail::chunk_size);
            for (std::size_t i = begin; i < end; ++i) ++visits.at(i);
        });
        for (const auto& count : visits) ASSERT_EQ(count, 1);
    }
}
// [points_are_cut_alike]

// [first_exception_is_thrown]
/// If calls throw, the exception of the smallest chunk is thrown on, whatever the order of calls,
/// and the execution can run again.
template <gnomon::execution X>
void first_exception_is_thrown(const X& run) {
    for (const std::size_t first : {0u, 17u, 99u}) {
        std::string what = "nothing";
        try {
            run(std::size_t{100}, [first](std::size_t c) {
                if (c >= first) throw std::runtime_error(std::to_string(c));
            });
        } catch (const std::runtime_error& e) {
            what = e.what();
        }
        ASSERT_EQ(what, std::to_string(first));
    }
    every_chunk_runs_once(run);
}
// [first_exception_is_thrown]

template <gnomon::execution X>
void execution_laws(const X& run) {
    every_chunk_runs_once(run);
    points_are_cut_alike(run);
    first_exception_is_thrown(run);
}

}  // namespace laws

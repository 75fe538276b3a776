// SPDX-License-Identifier: BSL-1.0
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>

namespace {

static_assert(gnomon::execution<gnomon::sequential>);
static_assert(gnomon::execution<gnomon::threads>);
static_assert(!gnomon::execution<int>);

/// Law: every number is visited exactly once, in chunks that do not depend on the policy.
template <gnomon::execution X>
void visits_each_once(const X& run) {
    for (const std::size_t n : {0u, 1u, 1023u, 1024u, 1025u, 100'000u}) {
        std::vector<std::atomic<int>> visits(n);
        gnomon::for_each_chunk(run, n, [&](std::size_t begin, std::size_t end) {
            EXPECT_EQ(begin % gnomon::chunk_size, 0u);
            EXPECT_LE(end - begin, gnomon::chunk_size);
            for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (const auto& v : visits) ASSERT_EQ(v, 1);
    }
}

TEST(execution, visits_each_number_once) {
    visits_each_once(gnomon::sequential{});
    for (const unsigned n : {0u, 1u, 2u, 4u, 9u}) visits_each_once(gnomon::threads{n});
}

TEST(execution, throws_on_the_first_failure_in_order) {
    for (const unsigned n : {1u, 2u, 8u}) {
        std::string what;
        try {
            gnomon::threads{n}(100, [](std::size_t c) {
                if (c >= 17) throw std::runtime_error(std::to_string(c));
            });
        } catch (const std::runtime_error& e) {
            what = e.what();
        }
        EXPECT_EQ(what, "17");
    }
}

TEST(execution, zero_threads_means_all) { EXPECT_GE(gnomon::threads{}.count(), 1u); }

}  // namespace

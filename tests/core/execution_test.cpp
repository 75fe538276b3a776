// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <exception>

#include <gtest/gtest.h>

#include "laws/execution_laws.hpp"
#include <gnomon/core/execution.hpp>

namespace {

/// An execution need not be one of the library's: this one runs the chunks backwards.
struct backwards {
    void operator()(std::size_t chunks, auto&& work) const {
        std::exception_ptr first;
        while (chunks-- > 0) {
            try {
                work(chunks);
            } catch (...) {
                first = std::current_exception();
            }
        }
        if (first) std::rethrow_exception(first);
    }
};

/// Takes the work before the number of chunks.
struct swapped {
    void operator()(auto&& work, int chunks) const {
        for (int c = 0; c < chunks; ++c) work(c);
    }
};

static_assert(gnomon::execution<gnomon::sequential>);
static_assert(gnomon::execution<gnomon::threads>);
static_assert(gnomon::execution<gnomon::team>);
static_assert(gnomon::execution<backwards>);
static_assert(!gnomon::execution<swapped>);
static_assert(!gnomon::execution<int>);  // threads{4}, not 4

TEST(execution, sequential_obeys_the_laws) { laws::execution_laws(gnomon::sequential{}); }

TEST(execution, threads_obey_the_laws) {
    for (const unsigned n : {0u, 1u, 2u, 4u, 9u}) laws::execution_laws(gnomon::threads{n});
}

TEST(execution, teams_obey_the_laws) {
    for (const unsigned n : {0u, 1u, 2u, 4u}) laws::execution_laws(gnomon::team(n));
}

TEST(execution, own_execution_obeys_the_laws) { laws::execution_laws(backwards{}); }

TEST(execution, zero_threads_means_all) { EXPECT_GE(gnomon::threads{}.count(), 1u); }

}  // namespace

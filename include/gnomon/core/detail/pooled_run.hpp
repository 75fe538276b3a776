// SPDX-License-Identifier: BSL-1.0
/// @file
/// An execution whose work takes scratch memory from a pool, on all threads.
#pragma once

#include <concepts>
#include <cstddef>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/core/execution.hpp>

namespace gnomon::detail {

/// Models `execution`. Refers to the execution that does the work, and to the pool.
template <execution X>
class pooled_run {
  public:
    pooled_run(const X& run, memory_pool& pool) : run_(run), pool_(pool) {}

    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        run_(chunks, [&](std::size_t c) {
            const work_scope scope(pool_);
            work(c);
        });
    }

  private:
    const X& run_;
    memory_pool& pool_;
};

}  // namespace gnomon::detail

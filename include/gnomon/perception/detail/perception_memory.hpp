// SPDX-License-Identifier: BSL-1.0
/// @file
/// The memory that a `perception_result` keeps from one call of `perception` to the next.
#pragma once

#include <vector>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Scratch memory and intermediate results. A copy has none of them.
template <class Estimate>
class perception_memory {
  public:
    spatial_index cells;                    ///< the index of the cells
    spatial_index sparse;                   ///< that of some of the points
    segments parts;                         ///< of the cells, or of the kept points
    std::vector<surfel<Estimate>> surface;  ///< of the cells, or of the kept points

    perception_memory() = default;
    perception_memory(const perception_memory&) : perception_memory() {}
    perception_memory(perception_memory&&) = default;
    perception_memory& operator=(const perception_memory&) { return *this; }
    perception_memory& operator=(perception_memory&&) = default;
    ~perception_memory() = default;

    /// For the scratch vectors of all steps: those of the calling thread, which are the same in
    /// each call, and those of the work that it shares with other threads.
    [[nodiscard]] memory_pool& pool() { return existing(of_caller_); }
    [[nodiscard]] memory_pool& pool_of_work() { return existing(of_work_); }

  private:
    [[nodiscard]] static memory_pool& existing(memory_pool::owner& pool) {
        if (!pool) pool = memory_pool::make();
        return *pool;
    }

    memory_pool::owner of_caller_, of_work_;
};

}  // namespace gnomon::detail

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The memory that a `perception_result` keeps from one call of `perception` to the next.
#pragma once

#include <memory>
#include <vector>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Scratch memory and intermediate results. A copy has none of them.
template <class Estimate>
class perception_memory {
  public:
    std::vector<surfel<Estimate>> surface;  ///< of the kept points, where some were removed
    segments parts;                         ///< of these

    perception_memory() = default;
    perception_memory(const perception_memory&) : perception_memory() {}
    perception_memory(perception_memory&&) = default;
    perception_memory& operator=(const perception_memory&) { return *this; }
    perception_memory& operator=(perception_memory&&) = default;
    ~perception_memory() = default;

    /// For the scratch vectors of all steps.
    [[nodiscard]] memory_pool& pool() {
        if (!pool_) pool_ = std::make_unique<memory_pool>();
        return *pool_;
    }

  private:
    std::unique_ptr<memory_pool> pool_;
};

}  // namespace gnomon::detail

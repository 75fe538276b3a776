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

    /// For the scratch vectors of all steps: those of the calling thread, which are the same in each
    /// call, and those of the work that it shares with other threads.
    [[nodiscard]] memory_pool& pool() { return both().of_caller; }
    [[nodiscard]] memory_pool& pool_of_work() { return both().of_work; }

  private:
    struct pools {
        memory_pool of_caller, of_work;
    };

    [[nodiscard]] pools& both() {
        if (!pools_) pools_ = std::make_unique<pools>();
        return *pools_;
    }

    std::unique_ptr<pools> pools_;
};

}  // namespace gnomon::detail

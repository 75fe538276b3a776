// SPDX-License-Identifier: BSL-1.0
/// @file
/// Memory that algorithms reuse from one call to the next. While a `pool_scope` exists, every
/// `scratch` vector that is constructed on its thread takes its memory from the pool of that scope;
/// without a scope, from operator new.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/detail/attributes.hpp>
#include <gnomon/core/detail/thread_team.hpp>

namespace gnomon::detail {

/// Where the memory of scratch vectors comes from; `memory_pool` is one. (An interface, so that
/// algorithms compile without it.)
class memory_source {
  public:
    static constexpr std::size_t alignment = 64;  // [bytes], of all memory: a cache line

    [[nodiscard]] virtual void* allocate(std::size_t bytes) = 0;
    virtual void deallocate(void* bytes) noexcept = 0;

  protected:
    memory_source() = default;
    ~memory_source() = default;
};

/// The source of the innermost `pool_scope` on this thread; null if there is none.
[[nodiscard]] inline memory_source*& current_pool() noexcept {
    return thread_value<memory_source*>();
}

/// While it exists, `scratch` vectors that are constructed on this thread use a pool; operator new
/// if it is null.
class pool_scope {
  public:
    explicit pool_scope(memory_source* pool) : outer_(std::exchange(current_pool(), pool)) {}
    pool_scope(const pool_scope&) = delete;
    pool_scope& operator=(const pool_scope&) = delete;
    ~pool_scope() { current_pool() = outer_; }

  private:
    memory_source* outer_;
};

/// Memory from a pool, or from operator new if there is none, aligned for T of `alignment`. (Not
/// inline, nor is its counterpart: vectors of all types would contain a copy. For compile time
/// only.)
[[nodiscard, GNOMON_NOINLINE]] inline void* allocate_from(memory_source* pool, std::size_t bytes,
                                                          std::size_t alignment) {
    if (pool != nullptr) return pool->allocate(bytes);
    return alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
               ? ::operator new(bytes, std::align_val_t{alignment})
               : ::operator new(bytes);
}
[[GNOMON_NOINLINE]] inline void deallocate_to(memory_source* pool, void* memory,
                                              std::size_t alignment) noexcept {
    if (pool != nullptr)
        pool->deallocate(memory);
    else if (alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__)
        ::operator delete(memory, std::align_val_t{alignment});
    else
        ::operator delete(memory);
}

/// An allocator over the pool that was current on its thread when it was constructed.
template <class T>
class pooled {
  public:
    using value_type = T;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;

    static_assert(alignof(T) <= memory_source::alignment);

    pooled() noexcept : pool_(current_pool()) {}
    template <class U>
    explicit(false) pooled(const pooled<U>& other) noexcept : pool_(other.pool()) {}

    [[nodiscard]] T* allocate(std::size_t n) {
        return static_cast<T*>(allocate_from(pool_, n * sizeof(T), alignof(T)));
    }
    void deallocate(T* values, std::size_t) noexcept { deallocate_to(pool_, values, alignof(T)); }

    /// Copies of a container use the pool that is current when they are made.
    [[nodiscard]] pooled select_on_container_copy_construction() const { return {}; }

    [[nodiscard]] memory_source* pool() const noexcept { return pool_; }
    template <class U>
    friend bool operator==(const pooled& a, const pooled<U>& b) noexcept {
        return a.pool() == b.pool();
    }

  private:
    memory_source* pool_;
};

/// A vector that an algorithm needs only while it runs.
template <class T>
using scratch = std::vector<T, pooled<T>>;

}  // namespace gnomon::detail

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

#include <gnomon/core/detail/memory_pool.hpp>

namespace gnomon::detail {

/// The innermost `pool_scope` on a thread.
struct pool_use {
    memory_pool* pool = nullptr;
    memory_pool::holdings* held = nullptr;
};
[[nodiscard]] inline pool_use& current_use() noexcept {
#if defined(GNOMON_NO_THREADS)
    static pool_use use;
#else
    static thread_local pool_use use;
#endif
    return use;
}

/// While it exists, `scratch` vectors that are constructed on this thread use a pool; operator new
/// if it is null.
class pool_scope {
  public:
    explicit pool_scope(memory_pool* pool, memory_pool::holdings* held = nullptr)
        : outer_(std::exchange(current_use(), pool_use{pool, held})) {}
    pool_scope(const pool_scope&) = delete;
    pool_scope& operator=(const pool_scope&) = delete;
    ~pool_scope() { current_use() = outer_; }

  private:
    pool_use outer_;
};

/// The same for one of several pieces of work that may run at the same time.
class work_scope {
  public:
    explicit work_scope(memory_pool& pool) : pool_(pool), scope_(&pool, &held_) { pool_.begin(); }
    work_scope(const work_scope&) = delete;
    work_scope& operator=(const work_scope&) = delete;
    ~work_scope() { pool_.end(held_); }

  private:
    memory_pool& pool_;
    memory_pool::holdings held_{};
    pool_scope scope_;
};

/// Memory from a pool, or from operator new if there is none, aligned for T of `alignment`. (Not
/// inline, nor is its counterpart: vectors of all types would contain a copy. For compile time
/// only.)
[[nodiscard, gnu::noinline]] inline void* allocate_from(memory_pool* pool, std::size_t bytes,
                                                        std::size_t alignment) {
    const pool_use now = current_use();
    if (pool != nullptr) return pool->allocate(bytes, now.pool == pool ? now.held : nullptr);
    return alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
               ? ::operator new(bytes, std::align_val_t{alignment})
               : ::operator new(bytes);
}
[[gnu::noinline]] inline void deallocate_to(memory_pool* pool, void* memory,
                                            std::size_t alignment) noexcept {
    const pool_use now = current_use();
    if (pool != nullptr)
        pool->deallocate(memory, now.pool == pool ? now.held : nullptr);
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

    static_assert(alignof(T) <= memory_pool::alignment);

    pooled() noexcept : pool_(current_use().pool) {}
    template <class U>
    explicit(false) pooled(const pooled<U>& other) noexcept : pool_(other.pool()) {}

    [[nodiscard]] T* allocate(std::size_t n) {
        return static_cast<T*>(allocate_from(pool_, n * sizeof(T), alignof(T)));
    }
    void deallocate(T* values, std::size_t) noexcept { deallocate_to(pool_, values, alignof(T)); }

    /// Copies of a container use the pool that is current when they are made.
    [[nodiscard]] pooled select_on_container_copy_construction() const { return {}; }

    [[nodiscard]] memory_pool* pool() const noexcept { return pool_; }
    template <class U>
    friend bool operator==(const pooled& a, const pooled<U>& b) noexcept {
        return a.pool() == b.pool();
    }

  private:
    memory_pool* pool_;
};

/// A vector that an algorithm needs only while it runs.
template <class T>
using scratch = std::vector<T, pooled<T>>;

}  // namespace gnomon::detail

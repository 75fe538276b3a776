// SPDX-License-Identifier: BSL-1.0
/// @file
/// Memory that algorithms reuse from one call to the next. A `memory_pool` keeps the blocks that
/// are returned to it. While a `pool_scope` exists, every `scratch` vector that is constructed on
/// its thread takes its memory from the pool of that scope; without a scope, from operator new.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/detail/thread_team.hpp>
#include <gnomon/core/detail/touched_vector.hpp>

namespace gnomon::detail {

/// Blocks of memory in lists by size, for reuse. Allocates from operator new only if no suitable
/// block is free, and returns its blocks when it is destroyed. Thread-safe.
class memory_pool {
  public:
    static constexpr std::size_t alignment = 64;  // [bytes], of all blocks: a cache line

    memory_pool() = default;
    memory_pool(const memory_pool&) = delete;
    memory_pool& operator=(const memory_pool&) = delete;
    /// Precondition: all blocks have been returned.
    ~memory_pool() {
        for (block* first : free_)
            while (first != nullptr)
                ::operator delete(std::exchange(first, first->next), std::align_val_t{alignment});
    }

    /// At least `bytes` bytes. O(1). Throws std::bad_alloc.
    [[nodiscard]] void* allocate(std::size_t bytes) {
        const std::size_t smallest = size_class(bytes);
        block* found = take(smallest);
        if (found == nullptr) {
            const std::size_t size = sizeof(block) + size_of(smallest);
            found = new (::operator new(size, std::align_val_t{alignment})) block{smallest};
            // All pages are mapped now: otherwise the resident memory would grow when a later user
            // of the block writes to more of it.
            auto* const bytes_of_block = reinterpret_cast<std::byte*>(found);
            touch(bytes_of_block + sizeof(block), bytes_of_block + size);
        }
        return found + 1;
    }

    /// Returns a block that allocate() gave. O(1).
    void deallocate(void* bytes) noexcept {
        block* const returned = static_cast<block*>(bytes) - 1;
        const guard_of locked(guard_);
        returned->next = free_[returned->size_class];
        free_[returned->size_class] = returned;
    }

  private:
    /// The header in front of the memory.
    struct alignas(alignment) block {
        std::size_t size_class;
        block* next = nullptr;  // in the list of free blocks
    };

    /// Sizes are (s + 1) 2^e cache lines for s = 4, ..., 7, number 4 e + s; below, each number is a
    /// size. So at most a fifth of a block is unused.
    static constexpr std::size_t classes = 4 * std::numeric_limits<std::size_t>::digits;
    /// A request may get a block of up to 16 times its size rather than a new one: the threads that
    /// take part in a step are not the same in every call.
    static constexpr std::size_t reach = 16;  // [size classes]; performance only

    [[nodiscard]] static std::size_t size_class(std::size_t bytes) {
        const std::size_t last = (std::max<std::size_t>(bytes, 1) - 1) / alignment;
        const std::size_t e = std::max<std::size_t>(std::bit_width(last), 3) - 3;
        return 4 * e + (last >> e);
    }
    [[nodiscard]] static std::size_t size_of(std::size_t number) {
        const std::size_t e = number < 8 ? 0 : number / 4 - 1;
        return ((number - 4 * e + 1) << e) * alignment;
    }

    /// A free block of this size class, or of the next larger ones; null if there is none.
    [[nodiscard]] block* take(std::size_t smallest) noexcept {
        const guard_of locked(guard_);
        const std::size_t end = std::min(smallest + reach + 1, classes);
        for (std::size_t number = smallest; number < end; ++number)
            if (block* const found = free_[number]; found != nullptr) {
                free_[number] = found->next;
                return found;
            }
        return nullptr;
    }

    mutex guard_;
    std::array<block*, classes> free_{};
};

/// The pool of the innermost `pool_scope` on this thread; null if there is none.
[[nodiscard]] inline memory_pool*& current_pool() noexcept {
#if defined(GNOMON_NO_THREADS)
    static memory_pool* pool = nullptr;
#else
    static thread_local memory_pool* pool = nullptr;
#endif
    return pool;
}

/// While it exists, `scratch` vectors that are constructed on this thread use a pool; operator new
/// if it is null.
class pool_scope {
  public:
    explicit pool_scope(memory_pool* pool) : outer_(std::exchange(current_pool(), pool)) {}
    pool_scope(const pool_scope&) = delete;
    pool_scope& operator=(const pool_scope&) = delete;
    ~pool_scope() { current_pool() = outer_; }

  private:
    memory_pool* outer_;
};

/// Memory from a pool, or from operator new if there is none, aligned for T of `alignment`. (Not
/// inline, nor is its counterpart: vectors of all types would contain a copy. For compile time
/// only.)
[[nodiscard, gnu::noinline]] inline void* allocate_from(memory_pool* pool, std::size_t bytes,
                                                        std::size_t alignment) {
    if (pool != nullptr) return pool->allocate(bytes);
    return alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
               ? ::operator new(bytes, std::align_val_t{alignment})
               : ::operator new(bytes);
}
[[gnu::noinline]] inline void deallocate_to(memory_pool* pool, void* memory,
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

    static_assert(alignof(T) <= memory_pool::alignment);

    pooled() noexcept : pool_(current_pool()) {}
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

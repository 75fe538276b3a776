// SPDX-License-Identifier: BSL-1.0
/// @file
/// Blocks of memory that are kept for the next call.
///
/// Which pieces of work run at the same time differs from call to call. So that the blocks of one
/// call suffice for the next, whatever its order, a pool records what one piece of work holds at
/// most, and sets as many blocks aside as all threads hold that do the same.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/thread_team.hpp>
#include <gnomon/core/detail/touched_vector.hpp>

namespace gnomon::detail {

/// Blocks of memory in lists by size, for reuse. Allocates from operator new only if no suitable
/// block is free, and returns its blocks when it is destroyed. A value that a user has made of its
/// memory, in a policy or a callback, may live longer than its owner: the pool does as well, until
/// the last block is returned. Thread-safe.
class memory_pool final : public memory_source {
    /// Sizes are (s + 1) 2^e cache lines for s = 4, ..., 7, number 4 e + s; below, each number is a
    /// size. So at most a fifth of a block is unused.
    static constexpr std::size_t classes = 4 * std::numeric_limits<std::size_t>::digits;

  public:
    /// The number of blocks that a piece of work holds, by the class of the requested size.
    using holdings = std::array<std::uint32_t, classes>;

    /// A piece of work, on the thread where it runs.
    struct work {
        const memory_pool* pool = nullptr;
        holdings* held = nullptr;
    };

    memory_pool(const memory_pool&) = delete;
    memory_pool& operator=(const memory_pool&) = delete;

    /// Its owner gives it up; it ends when all blocks have been returned.
    struct release {
        void operator()(memory_pool* pool) const noexcept {
            if (pool->is_unused_after([pool] { pool->is_owned_ = false; })) delete pool;
        }
    };
    using owner = std::unique_ptr<memory_pool, release>;
    [[nodiscard]] static owner make() { return owner(new memory_pool); }

    /// At least `bytes` bytes. O(1). Throws std::bad_alloc.
    [[nodiscard]] void* allocate(std::size_t bytes) override {
        const std::size_t requested = size_class(bytes);
        block* found = take(requested);
        if (found == nullptr) {
            found =
                made(requested, ::operator new(bytes_of(requested), std::align_val_t{alignment}));
            const guard_of locked(guard_);
            ++in_use_;
        }
        found->requested = requested;
        return found + 1;
    }

    /// Returns a block that allocate() gave, by the same piece of work or another. O(1).
    void deallocate(void* bytes) noexcept override {
        block* const returned = static_cast<block*>(bytes) - 1;
        const bool is_unused = is_unused_after([this, returned] {
            holdings* const held = held_here();
            if (held != nullptr && (*held)[returned->requested] > 0) {
                --(*held)[returned->requested];
                --held_[returned->requested];
            }
            put(returned);
            --in_use_;
        });
        if (is_unused) delete this;
    }

    /// The work of this thread.
    [[nodiscard]] static work& current_work() noexcept { return thread_value<work>(); }

    /// A piece of work begins, on a thread of its own.
    void begin() noexcept {
        const guard_of locked(guard_);
        threads_ = std::max(threads_, ++working_);
    }

    /// It ends; what it still holds belongs to its caller. O(classes), and the mapping of the
    /// blocks that are set aside.
    void end(const holdings& held) noexcept {
        const guard_of locked(guard_);
        --working_;
        for (std::size_t c = 0; c < classes; ++c) held_[c] -= held[c];
        for (std::size_t c = 0; c < classes; ++c)
            while (number_free_[c] < set_aside(c)) {
                void* const memory =
                    ::operator new(bytes_of(c), std::align_val_t{alignment}, std::nothrow);
                if (memory == nullptr) return;  // allocate() will throw
                put(made(c, memory));
            }
    }

    /// The number of its blocks that are not in use. O(classes).
    [[nodiscard]] std::size_t free_blocks() {
        const guard_of locked(guard_);
        std::size_t all = 0;
        for (const std::size_t of_class : number_free_) all += of_class;
        return all;
    }

  private:
    memory_pool() = default;
    ~memory_pool() {
        for (block* first : free_)
            while (first != nullptr)
                ::operator delete(std::exchange(first, first->next), std::align_val_t{alignment});
    }

    /// The header in front of the memory.
    struct alignas(alignment) block {
        std::size_t size_class;
        std::size_t requested = 0;  // the class of the size that its user requested
        block* next = nullptr;      // in the list of free blocks
    };

    /// A request may get a block of up to 16 times its size rather than a new one.
    static constexpr std::size_t reach = 16;  // [size classes]; performance only

    [[nodiscard]] static std::size_t size_class(std::size_t bytes) {
        const std::size_t last = (std::max<std::size_t>(bytes, 1) - 1) / alignment;
        const auto bits =
            static_cast<std::size_t>(std::bit_width(last));  // an int in some libraries
        const std::size_t e = std::max<std::size_t>(bits, 3) - 3;
        return 4 * e + (last >> e);
    }
    /// Of a block and its header.
    [[nodiscard]] static std::size_t bytes_of(std::size_t number) {
        const std::size_t e = number < 8 ? 0 : number / 4 - 1;
        return sizeof(block) + ((number - 4 * e + 1) << e) * alignment;
    }

    /// A block in new memory. All its pages are mapped now: otherwise the resident memory would
    /// grow when a later user of the block writes to more of it.
    [[nodiscard]] static block* made(std::size_t size_class, void* memory) noexcept {
        auto* const bytes = static_cast<std::byte*>(memory);
        touch(bytes + sizeof(block), bytes + bytes_of(size_class));
        return new (memory) block{size_class};
    }

    /// Changes the state; whether it has neither an owner nor blocks in use.
    bool is_unused_after(auto&& change) noexcept {
        const guard_of locked(guard_);
        change();
        return !is_owned_ && in_use_ == 0;
    }

    /// The holdings of this thread's work in this pool; null outside of work.
    [[nodiscard]] holdings* held_here() const noexcept {
        const work here = current_work();
        return here.pool == this ? here.held : nullptr;
    }

    /// A free block of the requested class, or of the next larger ones, null if there is none; work
    /// may have those of its class that are set aside.
    [[nodiscard]] block* take(std::size_t requested) noexcept {
        holdings* const held = held_here();
        const guard_of locked(guard_);
        block* found = nullptr;
        const std::size_t end = std::min(requested + reach + 1, classes);
        for (std::size_t c = requested; c < end && found == nullptr; ++c)
            if (number_free_[c] > (held != nullptr && c == requested ? 0 : set_aside(c))) {
                found = std::exchange(free_[c], free_[c]->next);
                --number_free_[c];
                ++in_use_;
            }
        if (held != nullptr) {
            most_[requested] = std::max(most_[requested], ++(*held)[requested]);
            ++held_[requested];
        }
        return found;
    }

    void put(block* returned) noexcept {
        const std::size_t c = returned->size_class;
        returned->next = std::exchange(free_[c], returned);
        ++number_free_[c];
    }

    /// The number of free blocks of this class that work may still request. (One thread requests
    /// the same ones in each call.)
    [[nodiscard]] std::uint32_t set_aside(std::size_t c) const noexcept {
        const std::uint32_t most = threads_ > 1 ? threads_ * most_[c] : 0;
        return most - std::min(most, held_[c]);
    }

    mutex guard_;
    std::size_t in_use_ = 0;  // blocks
    bool is_owned_ = true;
    std::array<block*, classes> free_{};
    holdings number_free_{};                   // the lengths of these lists
    holdings held_{};                          // by all pieces of work together
    holdings most_{};                          // that one piece of work held at once
    std::uint32_t working_ = 0, threads_ = 0;  // pieces of work now, and at most
};

/// While it exists, this thread does one of several pieces of work that may run at the same time,
/// and its `scratch` vectors use the pool.
class work_scope {
  public:
    explicit work_scope(memory_pool& pool)
        : pool_(pool),
          scope_(&pool),
          outer_(std::exchange(memory_pool::current_work(), {&pool, &held_})) {
        pool_.begin();
    }
    work_scope(const work_scope&) = delete;
    work_scope& operator=(const work_scope&) = delete;
    ~work_scope() {
        pool_.end(held_);
        memory_pool::current_work() = outer_;
    }

  private:
    memory_pool& pool_;
    memory_pool::holdings held_{};
    pool_scope scope_;
    memory_pool::work outer_;
};

}  // namespace gnomon::detail

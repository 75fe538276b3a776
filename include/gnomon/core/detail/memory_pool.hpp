// SPDX-License-Identifier: BSL-1.0
/// @file
/// Blocks of memory that are kept for the next call.
///
/// Which pieces of work run at the same time differs from call to call. So that the blocks of one
/// call suffice for the next, whatever its order, a pool notes what one piece of work holds at
/// most, and sets as many blocks aside as all threads hold that do the same.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <utility>

#include <gnomon/core/detail/thread_team.hpp>
#include <gnomon/core/detail/touched_vector.hpp>

namespace gnomon::detail {

/// Blocks of memory in lists by size, for reuse. Allocates from operator new only if no suitable
/// block is free, and returns its blocks when it is destroyed. Thread-safe.
class memory_pool {
    /// Sizes are (s + 1) 2^e cache lines for s = 4, ..., 7, number 4 e + s; below, each number is a
    /// size. So at most a fifth of a block is unused.
    static constexpr std::size_t classes = 4 * std::numeric_limits<std::size_t>::digits;

  public:
    static constexpr std::size_t alignment = 64;  // [bytes], of all blocks: a cache line

    /// The number of blocks that a piece of work holds, by the class of the size it asked for.
    using holdings = std::array<std::uint32_t, classes>;

    memory_pool() = default;
    memory_pool(const memory_pool&) = delete;
    memory_pool& operator=(const memory_pool&) = delete;
    /// Precondition: all blocks have been returned.
    ~memory_pool() {
        for (block* first : free_)
            while (first != nullptr)
                ::operator delete(std::exchange(first, first->next), std::align_val_t{alignment});
    }

    /// At least `bytes` bytes, for the piece of work whose holdings these are, if it is not null.
    /// O(1). Throws std::bad_alloc.
    [[nodiscard]] void* allocate(std::size_t bytes, holdings* held) {
        const std::size_t asked = size_class(bytes);
        block* found = take(asked, held);
        if (found == nullptr)
            found = made(asked, ::operator new(bytes_of(asked), std::align_val_t{alignment}));
        found->asked = asked;
        return found + 1;
    }

    /// Returns a block that allocate() gave, by the same piece of work or another. O(1).
    void deallocate(void* bytes, holdings* held) noexcept {
        block* const returned = static_cast<block*>(bytes) - 1;
        const guard_of locked(guard_);
        if (held != nullptr && (*held)[returned->asked] > 0) {
            --(*held)[returned->asked];
            --held_[returned->asked];
        }
        put(returned);
    }

    /// A piece of work begins, on a thread of its own.
    void begin() noexcept {
        const guard_of locked(guard_);
        threads_ = std::max(threads_, ++working_);
    }

    /// It ends; what it still holds belongs to its caller. O(classes).
    void end(const holdings& held) noexcept {
        const guard_of locked(guard_);
        --working_;
        for (std::size_t c = 0; c < classes; ++c) held_[c] -= held[c];
        for (std::size_t c = 0; c < classes; ++c)
            while (number_free_[c] < set_aside(c)) {
                void* const memory =
                    ::operator new(bytes_of(c), std::align_val_t{alignment}, std::nothrow);
                if (memory == nullptr) return;  // work that needs it will say so
                put(made(c, memory));
            }
    }

    /// The number of its blocks that are not in use. O(classes).
    [[nodiscard]] std::size_t free_blocks() const {
        return std::accumulate(number_free_.begin(), number_free_.end(), std::size_t{0});
    }

  private:
    /// The header in front of the memory.
    struct alignas(alignment) block {
        std::size_t size_class;
        std::size_t asked = 0;  // the class of the size that its user asked for
        block* next = nullptr;  // in the list of free blocks
    };

    /// A request may get a block of up to 16 times its size rather than a new one.
    static constexpr std::size_t reach = 16;  // [size classes]; performance only

    [[nodiscard]] static std::size_t size_class(std::size_t bytes) {
        const std::size_t last = (std::max<std::size_t>(bytes, 1) - 1) / alignment;
        const std::size_t e = std::max<std::size_t>(std::bit_width(last), 3) - 3;
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

    /// A free block of the class asked for, or of the next larger ones, null if there is none; work
    /// may have those of its class that are set aside.
    [[nodiscard]] block* take(std::size_t asked, holdings* held) noexcept {
        const guard_of locked(guard_);
        block* found = nullptr;
        const std::size_t end = std::min(asked + reach + 1, classes);
        for (std::size_t c = asked; c < end && found == nullptr; ++c)
            if (number_free_[c] > (held != nullptr && c == asked ? 0 : set_aside(c))) {
                found = std::exchange(free_[c], free_[c]->next);
                --number_free_[c];
            }
        if (held != nullptr) {
            most_[asked] = std::max(most_[asked], ++(*held)[asked]);
            ++held_[asked];
        }
        return found;
    }

    void put(block* returned) noexcept {
        const std::size_t c = returned->size_class;
        returned->next = std::exchange(free_[c], returned);
        ++number_free_[c];
    }

    /// As many free blocks of this class as work may still ask for. (One thread asks for the same
    /// ones in each call.)
    [[nodiscard]] std::uint32_t set_aside(std::size_t c) const noexcept {
        const std::uint32_t most = threads_ > 1 ? threads_ * most_[c] : 0;
        return most - std::min(most, held_[c]);
    }

    mutex guard_;
    std::array<block*, classes> free_{};
    holdings number_free_{};                   // the lengths of these lists
    holdings held_{};                          // by all pieces of work together
    holdings most_{};                          // that one piece of work held at once
    std::uint32_t working_ = 0, threads_ = 0;  // pieces of work now, and at most
};

}  // namespace gnomon::detail

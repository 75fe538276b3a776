// SPDX-License-Identifier: BSL-1.0
/// @file
/// Something that follows from a value and is made when it is first asked for.
#pragma once

#include <utility>

#include <gnomon/core/detail/thread_team.hpp>

namespace gnomon::detail {

/// Holds it, whatever its type. It is made again where it is no longer current, in the same memory.
/// A copy holds nothing. Calls of get() are thread-safe.
class made_when_asked {
  public:
    made_when_asked() = default;
    made_when_asked(const made_when_asked&) {}
    made_when_asked(made_when_asked&& other) noexcept { take(other); }
    made_when_asked& operator=(const made_when_asked&) {
        forget();
        return *this;
    }
    made_when_asked& operator=(made_when_asked&& other) noexcept {
        if (this == &other) return *this;
        destroy();
        take(other);
        return *this;
    }
    ~made_when_asked() { destroy(); }

    /// Whatever was made is no longer current.
    void forget() { is_made_ = false; }

    /// @param is_current  is_current(what): whether what was made before still is
    /// @param make        make(what): makes it, in the memory that it has. Throws what this throws.
    template <class What>
    [[nodiscard]] const What& get(auto&& is_current, auto&& make) const {
        const guard_of locked(guard_);
        if (what_ == nullptr) {
            what_ = new What();
            destroy_ = [](void* what) { delete static_cast<What*>(what); };
        }
        auto& what = *static_cast<What*>(what_);
        if (!is_made_ || !is_current(std::as_const(what))) {
            is_made_ = false;
            make(what);
            is_made_ = true;
        }
        return what;
    }

  private:
    void destroy() {
        if (what_ != nullptr) destroy_(what_);
    }
    void take(made_when_asked& other) {
        what_ = other.what_;
        destroy_ = other.destroy_;
        is_made_ = other.is_made_;
        other.what_ = nullptr;
        other.is_made_ = false;
    }

    mutable mutex guard_;
    mutable void* what_ = nullptr;  // always of one type
    mutable void (*destroy_)(void*) = nullptr;
    mutable bool is_made_ = false;
};

}  // namespace gnomon::detail

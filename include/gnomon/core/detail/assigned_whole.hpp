// SPDX-License-Identifier: BSL-1.0
/// @file
/// Copy assignment that leaves the old value where it throws.
#pragma once

#include <utility>

namespace gnomon::detail {

/// A T that is assigned as a whole or not at all. (A template, so that only programs that assign
/// one compile its copy.)
template <class T>
class assigned_whole : public T {
  public:
    assigned_whole() = default;
    assigned_whole(const assigned_whole&) = default;
    assigned_whole(assigned_whole&&) = default;
    assigned_whole& operator=(const assigned_whole& other) {
        assigned_whole copy(other);
        return *this = std::move(copy);
    }
    assigned_whole& operator=(assigned_whole&&) = default;
    ~assigned_whole() = default;
};

}  // namespace gnomon::detail

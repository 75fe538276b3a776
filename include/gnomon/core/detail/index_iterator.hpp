// SPDX-License-Identifier: BSL-1.0
/// @file
/// A random-access iterator over a view with `operator[]`. The views compute their elements, so
/// dereferencing gives a value and not a reference.
#pragma once

#include <compare>
#include <cstddef>
#include <iterator>
#include <utility>

namespace gnomon::detail {

/// The iterator to element i of `*view`. Valid as long as the view. Models
/// std::random_access_iterator.
template <class View>
class index_iterator {
  public:
    using value_type = decltype(std::declval<const View&>()[std::size_t{}]);
    using reference = value_type;
    using pointer = void;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::input_iterator_tag;  // in C++17, since *it is no reference
    using iterator_concept = std::random_access_iterator_tag;

    index_iterator() = default;
    index_iterator(const View* view, difference_type i) : view_(view), i_(i) {}

    reference operator*() const { return (*this)[0]; }
    reference operator[](difference_type n) const {
        return (*view_)[static_cast<std::size_t>(i_ + n)];
    }

    index_iterator& operator+=(difference_type n) { return i_ += n, *this; }
    index_iterator& operator-=(difference_type n) { return i_ -= n, *this; }
    index_iterator& operator++() { return *this += 1; }
    index_iterator& operator--() { return *this -= 1; }
    index_iterator operator++(int) { return std::exchange(*this, *this + 1); }
    index_iterator operator--(int) { return std::exchange(*this, *this - 1); }

    friend index_iterator operator+(index_iterator a, difference_type n) { return a += n; }
    friend index_iterator operator+(difference_type n, index_iterator a) { return a += n; }
    friend index_iterator operator-(index_iterator a, difference_type n) { return a -= n; }
    friend difference_type operator-(index_iterator a, index_iterator b) { return a.i_ - b.i_; }
    friend bool operator==(index_iterator a, index_iterator b) { return a.i_ == b.i_; }
    friend auto operator<=>(index_iterator a, index_iterator b) { return a.i_ <=> b.i_; }

  private:
    const View* view_ = nullptr;
    difference_type i_ = 0;
};

}  // namespace gnomon::detail

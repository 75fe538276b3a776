// SPDX-License-Identifier: BSL-1.0
/// @file
/// What one writes around a library that answers one question at a time: a loop over all points, by
/// OpenMP where that is on; the lists of neighbors that such a loop stores; and the growing of
/// segments over such lists.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace peers {

#ifdef _OPENMP
inline constexpr bool loops_have_one_thread = false;
#else
inline constexpr bool loops_have_one_thread = true;
#endif

/// Calls make_work() on each of `threads` threads, and its result for each i in 0, ..., n - 1.
void for_each_index(std::size_t n, [[maybe_unused]] unsigned threads, auto&& make_work) {
#ifdef _OPENMP
#pragma omp parallel num_threads(static_cast<int>(threads))
#endif
    {
        auto work = make_work();
#ifdef _OPENMP
#pragma omp for schedule(dynamic, 1024)
#endif
        for (std::size_t i = 0; i < n; ++i) work(i);
    }
}

/// The k neighbors of each of n points, nearest first.
class neighbor_lists {
  public:
    neighbor_lists(std::size_t n, std::size_t k) : k_(k), lists_(n * k) {}

    /// Stores what was found about point i, itself among it, or not if others are at its place.
    void set(std::size_t i, const auto& found) {
        std::uint32_t* out = lists_.data() + i * k_;
        std::uint32_t* const end = out + k_;
        for (const auto j : found) {
            if (static_cast<std::size_t>(j) == i) continue;
            if (out == end) break;
            *out++ = static_cast<std::uint32_t>(j);
        }
        std::fill(out, end, static_cast<std::uint32_t>(i));  // there are no more
    }

    [[nodiscard]] const std::uint32_t* begin(std::size_t i) const { return &lists_[i * k_]; }
    [[nodiscard]] std::size_t k() const { return k_; }
    [[nodiscard]] std::size_t bytes() const { return lists_.size() * sizeof(std::uint32_t); }

  private:
    std::size_t k_;
    std::vector<std::uint32_t> lists_;
};

/// The task "search" as such lists.
struct search_job {
    static constexpr const char* task = "search";

    static std::size_t last_neighbor(const neighbor_lists& lists, std::size_t i) {
        return lists.begin(i)[lists.k() - 1];
    }
    static std::size_t bytes(const neighbor_lists& lists) { return lists.bytes(); }
};

/// The size of each segment that growing finds, breadth first: for_each_next(i, visit) calls
/// visit(j) for the points that belong where i belongs.
std::vector<std::size_t> grow(std::size_t n, auto&& for_each_next) {
    std::vector<std::size_t> sizes;
    std::vector<std::int32_t> labels(n, -1);
    std::vector<std::size_t> queue;
    for (std::size_t seed = 0; seed < n; ++seed) {
        if (labels[seed] != -1) continue;
        const auto label = static_cast<std::int32_t>(sizes.size());
        queue.assign(1, seed);
        labels[seed] = label;
        for (std::size_t next = 0; next < queue.size(); ++next) {
            for_each_next(queue[next], [&](std::size_t j) {
                if (labels[j] != -1) return;
                labels[j] = label;
                queue.push_back(j);
            });
        }
        sizes.push_back(queue.size());
    }
    return sizes;
}

/// The number of segments with at least `min_points` points.
inline std::size_t count_of(const auto& sizes, std::size_t min_points) {
    return static_cast<std::size_t>(std::count_if(sizes.begin(), sizes.end(), [&](const auto& s) {
        if constexpr (requires { s.size(); }) {
            return s.size() >= min_points;
        } else {
            return s >= min_points;
        }
    }));
}

}  // namespace peers

// SPDX-License-Identifier: BSL-1.0
/// @file
/// The stored graph of what a sweep finds, in whatever order it does.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {

/// The rings that the visitors of a sweep have seen.
struct seen_rings {
    struct part {
        std::vector<point_index> points, indices;  // the rings of these, one after the other
    };

    std::vector<std::uint64_t> size_before;  // at i + 1 is the size of the ring of point i
    std::vector<part> parts = {};
    std::mutex guard = {};
};

/// Remembers what it is shown, and hands it over in the end.
class ring_recorder {
  public:
    explicit ring_recorder(seen_rings& all) : all_(all) {}

    void operator()(std::size_t i, const auto& found) {
        found.sort_into(ring_);
        all_.size_before[i + 1] = ring_.size();
        seen_.points.push_back(static_cast<point_index>(i));
        for (const neighbor& q : ring_) seen_.indices.push_back(q.index);
    }

    void finish() {
        const std::lock_guard lock(all_.guard);
        all_.parts.push_back(std::move(seen_));
    }

  private:
    seen_rings& all_;
    std::vector<neighbor> ring_;
    seen_rings::part seen_;
};

/// The stored graph of a `sweeping_neighborhood`. While building, the indices exist twice.
template <class Policy, class R, execution X, class Proj>
[[nodiscard]] adjacency swept_graph(const Policy& policy, const R& points, const X& run,
                                    Proj projection) {
    const std::size_t n = position_view<R, Proj>(points, projection).size();
    const auto& team = detail::staying(run);
    seen_rings all{.size_before = std::vector<std::uint64_t>(n + 1, 0)};
    if (!policy.sweep(points, team, projection, [&] { return ring_recorder(all); }))
        return adjacency(policy.search(points, std::move(projection)), team);

    std::vector<std::uint64_t>& begin = all.size_before;
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<point_index> indices(begin.back());
    team(all.parts.size(), [&](std::size_t c) {
        auto from = all.parts[c].indices.begin();
        for (const point_index i : all.parts[c].points) {
            const auto size = static_cast<std::ptrdiff_t>(begin[i + 1] - begin[i]);
            std::copy(from, from + size, indices.begin() + static_cast<std::ptrdiff_t>(begin[i]));
            from += size;
        }
    });
    return adjacency(std::move(begin), std::move(indices));
}

}  // namespace gnomon::detail

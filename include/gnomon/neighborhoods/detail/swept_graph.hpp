// SPDX-License-Identifier: BSL-1.0
/// @file
/// The stored graph of the neighborhoods that a sweep finds, in any order of the points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/detail/begins_from_sizes.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/thread_team.hpp>
#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// Writes the indices of the neighbors that a sweep found, in their order. Sweeps of this library
/// can do so at once; the minimal definition of a sweep makes neighbors of them first.
void write_indices(const auto& found, point_index* to, scratch<neighbor>& buffer) {
    if constexpr (requires { found.sort_into(to, buffer); }) {
        found.sort_into(to, buffer);
    } else {
        found.sort_into(buffer);
        for (const neighbor& q : buffer) *to++ = q.index;
    }
}

/// Writes the neighbors of each point to their place in the graph, which is known beforehand.
class neighborhood_writer {
  public:
    /// The neighbors of point i begin at indices[begin[i]].
    neighborhood_writer(const std::uint64_t* begin, point_index* indices)
        : begin_(begin), indices_(indices) {}

    void operator()(std::size_t i, const auto& found) {
        require(found.size() == begin_[i + 1] - begin_[i],
                "the neighborhood finds another number of neighbors than neighbors_of_each()");
        write_indices(found, indices_ + begin_[i], buffer_);
    }

  private:
    const std::uint64_t* begin_;
    point_index* indices_;
    scratch<neighbor> buffer_;
};

/// The arrays of the graph of neighborhoods that are k points for every finite point.
/// @param graph  arrays of an `adjacency` or a `scratch_graph`
/// @param sweep  sweep(make_visitor), as a policy's `sweep`
template <execution X>
void sweep_equal_sizes(std::size_t k, const spatial_index& index, const X& run, auto& graph,
                       auto&& sweep) {
    auto& begin = graph.begin;
    auto& indices = graph.indices;
    begin.assign(index.size() + 1, 0);
    for (std::size_t i = 0; i < index.size(); ++i)
        begin[i + 1] = begin[i] + (index.tree().place_of(i) != leaf_tree::no_place ? k : 0);
    resize_touched(indices, static_cast<std::size_t>(begin.back()), run);
    if constexpr (requires { graph.notes; }) graph.notes.clear();
    sweep([&] { return neighborhood_writer(begin.data(), indices.data()); });
}

/// The neighbors of all points that the visitors of a sweep have seen.
/// @tparam Sizes  a vector of numbers
template <class Sizes>
struct recorded_neighborhoods {
    /// Those that one visitor has seen.
    struct part {
        scratch<point_index> points;
        scratch<point_index> indices;  // the neighbors of these, one point after the other
    };

    Sizes& sizes;  // at i + 1 is the number of neighbors of point i
    scratch<part> parts = {};
    mutex guard = {};
};

/// A visitor that records the neighbors of each point.
template <class Sizes>
class neighborhood_recorder {
  public:
    explicit neighborhood_recorder(recorded_neighborhoods<Sizes>& all) : all_(all) {}

    void operator()(std::size_t i, const auto& found) {
        const std::size_t before = seen_.indices.size();
        seen_.indices.resize(before + found.size());
        write_indices(found, seen_.indices.data() + before, buffer_);
        all_.sizes[i + 1] = found.size();
        seen_.points.push_back(static_cast<point_index>(i));
    }

    void finish() {
        const guard_of locked(all_.guard);
        all_.parts.push_back(std::move(seen_));
    }

  private:
    recorded_neighborhoods<Sizes>& all_;
    scratch<neighbor> buffer_;
    typename recorded_neighborhoods<Sizes>::part seen_;
};

/// The arrays of the graph of n neighborhoods that differ in size. While building, the indices
/// exist twice.
/// @param graph  arrays of an `adjacency` or a `scratch_graph`
/// @param sweep  sweep(make_visitor), as a policy's `sweep`
template <execution X>
void sweep_any_sizes(std::size_t n, const X& run, auto& graph, auto&& sweep) {
    auto& begin = graph.begin;
    begin.assign(n + 1, 0);
    recorded_neighborhoods<std::remove_reference_t<decltype(begin)>> all{begin};
    sweep([&] { return neighborhood_recorder(all); });

    begins_from_sizes(begin);
    auto& indices = graph.indices;
    resize_touched(indices, static_cast<std::size_t>(begin.back()), run);
    run(all.parts.size(), [&](std::size_t c) {
        auto from = all.parts[c].indices.begin();
        for (const point_index i : all.parts[c].points) {
            const auto size = static_cast<std::ptrdiff_t>(begin[i + 1] - begin[i]);
            std::copy(from, from + size, indices.begin() + static_cast<std::ptrdiff_t>(begin[i]));
            from += size;
        }
    });
    if constexpr (requires { graph.notes; }) graph.notes.clear();
}

/// The arrays of the graph of a `sweeping_neighborhood`. A policy that finds the same number of
/// neighbors of every finite point returns it from neighbors_of_each(number of finite points), or
/// nothing if the numbers may differ.
template <class Policy, execution X>
void sweep_graph(const Policy& policy, const spatial_index& index, const X& run,
                 adjacency::arrays& graph) {
    const auto sweep = [&](auto&& make_visitor) { policy.sweep(index, run, make_visitor); };
    if constexpr (requires { policy.neighbors_of_each(std::size_t{}); }) {
        if (const std::optional<std::size_t> k = policy.neighbors_of_each(index.tree().size()))
            return sweep_equal_sizes(*k, index, run, graph, sweep);
    }
    sweep_any_sizes(index.size(), run, graph, sweep);
}

}  // namespace gnomon::detail

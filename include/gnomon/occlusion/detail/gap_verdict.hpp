// SPDX-License-Identifier: BSL-1.0
/// @file
/// The evidence of a line across a gap, from the observations along it (Klasing 2010, Sec. 4.3.5;
/// docs/thesis-notes.md, A19).
#pragma once

#include <cstddef>

#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>

namespace gnomon::detail {

/// Whether a policy accepts a line: more of its observations are in favor of merging than against
/// it. Observations on the surface are never against it; a line without observations counts as
/// unobserved.
template <merge_policy M>
[[nodiscard]] bool accepts(const M& policy, const observation_count& seen) {
    if (seen.total() == 0) return policy(observation::unobserved);
    std::size_t against = 0;
    std::size_t in_favor = policy(observation::on_surface) ? seen[observation::on_surface] : 0;
    for (const observation s :
         {observation::unobserved, observation::occluded, observation::free_space})
        (policy(s) ? in_favor : against) += seen[s];
    return in_favor > against;
}

/// Whether a line alone keeps a gap open: free space was observed on it, whatever else was
/// observed.
template <merge_policy M>
[[nodiscard]] bool keeps_open(const M& policy, const observation_count& seen) {
    return seen[observation::free_space] > 0 && !policy(observation::free_space);
}

}  // namespace gnomon::detail

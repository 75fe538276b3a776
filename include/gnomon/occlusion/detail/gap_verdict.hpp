// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a line across a gap says of it, by what was seen at its places (Klasing 2010, Sec. 4.3.5;
/// specification of it, A19).
#pragma once

#include <cstddef>

#include <gnomon/occlusion/lines_of_sight.hpp>
#include <gnomon/occlusion/merge_policy.hpp>

namespace gnomon::detail {

/// Whether a policy accepts a line: more of its places speak for merging than against. Where the
/// surface itself is seen, nothing speaks against it; a line without a place says what nothing
/// says.
template <merge_policy M>
[[nodiscard]] bool accepts(const M& policy, const sighting_count& seen) {
    if (seen.total() == 0) return policy(sighting::unseen);
    std::size_t in_favor = 0, against = 0;
    for (const sighting s :
         {sighting::unseen, sighting::closer, sighting::level, sighting::farther}) {
        if (policy(s))
            in_favor += seen[s];
        else if (s != sighting::level)
            against += seen[s];
    }
    return in_favor > against;
}

/// Whether a line alone keeps a gap open: at one place of it something farther was seen, be there
/// ever so much in front of the others.
template <merge_policy M>
[[nodiscard]] bool keeps_open(const M& policy, const sighting_count& seen) {
    return seen[sighting::farther] > 0 && !policy(sighting::farther);
}

}  // namespace gnomon::detail

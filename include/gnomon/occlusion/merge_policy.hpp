// SPDX-License-Identifier: BSL-1.0
/// @file
/// Policies of merging: whether the observations in the gap between two coplanar segments are
/// evidence for one occluded surface. A sensor may have seen something nearer there, which occludes
/// what is behind it; something farther, which shows free space; or nothing at all.
///
/// Klasing 2010, Sec. 4.3.2, Fig. 4.4. Models: `conservative`, `liberal`, and any function of an
/// `observation`.
#pragma once

#include <concepts>

namespace gnomon {

/// What was seen towards a place at which a surface is supposed.
enum class observation : char {
    unobserved,  ///< no return: black, transparent or distant things, or no ray
    occluded,    ///< something in front of it
    on_surface,  ///< something at its distance
    free_space   ///< something behind it: the place is empty
};

/// Whether an observation is evidence for merging. Most observations along most of the lines across
/// a gap must be; narrow gaps are closed without evidence (merge_occluded_options::max_gap), and
/// one observation of free space keeps any gap open, unless the policy merges even there.
template <class M>
concept merge_policy = requires(const M& policy, observation seen) {
    { policy(seen) } -> std::convertible_to<bool>;
};

/// Merges where something closer was seen in the gap (Sec. 4.3.2).
struct conservative {
    [[nodiscard]] bool operator()(observation seen) const { return seen == observation::occluded; }
};

/// Merges unless something farther was seen in the gap.
struct liberal {
    [[nodiscard]] bool operator()(observation seen) const {
        return seen != observation::free_space;
    }
};

}  // namespace gnomon

// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a gap between two coplanar surfaces tells: whether they are one surface behind something,
/// or two. A sensor may have seen something nearer there, which hides what is behind; something
/// farther, which shows that nothing is there; or nothing at all. What to make of that is a policy.
///
/// Klasing 2010, Sec. 4.3.2, Fig. 4.4. Models: `conservative`, `liberal`, and any function of a
/// `sighting`.
#pragma once

#include <concepts>

namespace gnomon {

/// What was seen towards a place at which a surface is supposed.
enum class sighting : char {
    unseen,  ///< no return: black, transparent or far things, or no ray
    closer,  ///< something in front of it
    level,   ///< something just there
    farther  ///< something behind it: the place is empty
};

/// Whether a sighting speaks for merging. Most of what is seen along most of the lines across a gap
/// must; narrow gaps need nobody's word (occlusion_merging::max_gap), and one place that is seen to
/// be empty keeps any gap open, unless the policy merges even there.
template <class M>
concept merge_policy = requires(const M& policy, sighting seen) {
    { policy(seen) } -> std::convertible_to<bool>;
};

/// Merges where something closer was seen in the gap (Sec. 4.3.2).
struct conservative {
    [[nodiscard]] bool operator()(sighting seen) const { return seen == sighting::closer; }
};

/// Merges unless something farther was seen in the gap.
struct liberal {
    [[nodiscard]] bool operator()(sighting seen) const { return seen != sighting::farther; }
};

}  // namespace gnomon

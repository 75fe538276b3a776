// SPDX-License-Identifier: BSL-1.0
/// @file
/// Policies of merging: whether the observations in the gap between two coplanar segments are
/// evidence for one occluded surface. A sensor may have seen something nearer there, which occludes
/// what is behind it; something farther, which shows free space; or nothing at all. Or the place
/// may be where it cannot see, as the road below a spinning lidar.
///
/// Klasing 2010, Sec. 4.3.2, Fig. 4.4. Models: `conservative`, `liberal`, and any function of an
/// `observation`.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

namespace gnomon {

/// What was seen towards a place at which a surface is supposed.
enum class observation : char {
    unobserved,  ///< no return: black, transparent or distant things, or no ray
    occluded,    ///< something in front of it
    on_surface,  ///< something at its distance
    free_space,  ///< something behind it: the place is empty
    out_of_view  ///< nothing, as the place is above or below all that was seen
};

/// How often something was seen, by kind of observation.
struct observation_count {
    std::array<std::size_t, 5> of{};  ///< one count for each kind

    /// The count of one kind.
    [[nodiscard]] std::size_t operator[](observation s) const {
        return of[static_cast<std::size_t>(s)];
    }
    void add(observation s) { ++of[static_cast<std::size_t>(s)]; }  ///< counts one
    /// Adds the counts of another.
    observation_count& operator+=(const observation_count& other) {
        for (std::size_t s = 0; s < of.size(); ++s) of[s] += other.of[s];
        return *this;
    }
    /// The count of all kinds.
    [[nodiscard]] std::size_t total() const { return of[0] + of[1] + of[2] + of[3] + of[4]; }
};

/// Whether an observation is evidence for merging. Most observations along most of the lines across
/// a gap must be, but for lines on which mostly the surface itself was seen; narrow gaps are closed
/// without evidence (merge_occluded_options::max_gap), and one line on which free space was
/// observed, by more than a few of its rays, keeps any gap open, unless the policy merges even
/// there.
template <class M>
concept merge_policy = requires(const M& policy, observation seen) {
    { policy(seen) } -> std::convertible_to<bool>;
};

/// Merges where something closer was seen in the gap (Sec. 4.3.2), or the sensor cannot see it.
struct conservative {
    [[nodiscard]] bool operator()(observation seen) const {
        return seen == observation::occluded || seen == observation::out_of_view;
    }
};

/// Merges unless something farther was seen in the gap.
struct liberal {
    [[nodiscard]] bool operator()(observation seen) const {
        return seen != observation::free_space;
    }
};

namespace detail {

/// What the observations along a line are evidence for.
enum class verdict : char { against, none, in_favor };

/// The verdict of a line: in favor of merging, if more of its observations are than against it.
/// Observations on the surface are never against it; a line with mostly these is no evidence. A
/// line without observations counts as unobserved.
template <merge_policy M>
[[nodiscard]] verdict verdict_of(const M& policy, const observation_count& seen) {
    if (seen.total() == 0)
        return policy(observation::unobserved) ? verdict::in_favor : verdict::against;
    const std::size_t on_surface = seen[observation::on_surface];
    std::size_t against = 0, in_favor = policy(observation::on_surface) ? on_surface : 0;
    for (const observation s : {observation::unobserved, observation::occluded,
                                observation::free_space, observation::out_of_view})
        (policy(s) ? in_favor : against) += seen[s];
    if (in_favor > against) return verdict::in_favor;
    return 2 * on_surface > seen.total() ? verdict::none : verdict::against;
}

/// Whether a line alone keeps a gap open: free space was observed on it, and the surface itself not
/// twice as often, or more. There, as on a road, rays that graze the surface seem to see beyond it.
/// So do a few of hundreds at the rim of an occluder, if the view point is not exact.
template <merge_policy M>
[[nodiscard]] bool keeps_open(const M& policy, const observation_count& seen) {
    constexpr std::size_t most = 50;  // to one that is free; chosen on streets 20,001 to 21,700
    const std::size_t free = seen[observation::free_space];
    return most * free > seen.total() && 2 * free > seen[observation::on_surface] &&
           !policy(observation::free_space);
}

}  // namespace detail
}  // namespace gnomon

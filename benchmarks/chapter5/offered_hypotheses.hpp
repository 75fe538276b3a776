// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether a finder distinguishes right hypotheses from wrong ones: where each piece of furniture
/// stands, every model is offered.
#pragma once

#include <cstdint>
#include <vector>

#include "outcomes.hpp"
#include "rooms.hpp"
#include <gnomon/perception/find_objects.hpp>

/// How probable the finder calls what it was offered, at pieces of 200 points and more.
struct offered_hypotheses {
    std::vector<double> right;  ///< of each piece: that of its model
    std::vector<double> wrong;  ///< of each piece: those of all others

    /// Offers all models at all pieces of a room, some centimeters and degrees off, in four
    /// headings, since the heading of another model means nothing; the most probable one counts.
    /// @param seed  of the distances
    void offer(const seen_room& room, const rec::object_finder& finder, std::uint64_t seed);

    /// The share of wrong ones that are rejected where a share of the right ones is.
    [[nodiscard]] double rejected_at_loss(double share) const;
};

/// A table of the shares that are rejected.
[[nodiscard]] json offers_table(const std::vector<offered_hypotheses>& of_seeds);

// SPDX-License-Identifier: BSL-1.0
#include "offered_hypotheses.hpp"

#include <algorithm>
#include <cstddef>

#include "room_methods.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/rigid_motion.hpp>

namespace {

constexpr int headings = 4;

/// The share of those that are less probable.
double share_below(const std::vector<double>& probabilities, double least) {
    const auto below = std::ranges::count_if(probabilities, [&](double p) { return p < least; });
    return static_cast<double>(below) /
           static_cast<double>(std::max<std::size_t>(1, probabilities.size()));
}

}  // namespace

void offered_hypotheses::offer(const seen_room& room, const rec::object_finder& finder,
                               std::uint64_t seed) {
    gnomon::random_stream random(seed);
    std::vector<rec::object_place> places;
    std::vector<bool> is_right;
    for (const true_piece& piece : room.pieces) {
        if (piece.points.size() < enough_for_pose) continue;
        constexpr double shift = 0.05, turn = 10.0;  // at most [m, degrees]; as votes are off
        const gnomon::rigid_motion start =
            piece.pose * gnomon::rigid_motion::on_ground(
                             random.uniform(-shift, shift), random.uniform(-shift, shift),
                             gnomon::degrees(random.uniform(-turn, turn)));
        for (std::size_t object = 0; object < finder.names().size(); ++object) {
            is_right.push_back(finder.names()[object] == piece.name);
            for (int h = 0; h < headings; ++h)
                places.push_back({object,
                                  start * gnomon::rigid_motion::on_ground(
                                              0.0, 0.0, gnomon::degrees(360.0 * h / headings)),
                                  0.0});
        }
    }
    const auto verified =
        finder.verify(room.truth.scan, places, how_rooms_are_seen, gnomon::threads{});
    for (std::size_t k = 0; k < is_right.size(); ++k) {
        const auto first = verified.begin() + static_cast<std::ptrdiff_t>(k * headings);
        const auto best = std::max_element(
            first, first + headings,
            [](const auto& a, const auto& b) { return a.probability < b.probability; });
        (is_right[k] ? right : wrong).push_back(best->probability);
    }
}

double offered_hypotheses::rejected_at_loss(double share) const {
    if (right.empty()) return 0.0;
    std::vector<double> sorted = right;
    std::ranges::sort(sorted);
    return share_below(
        wrong, sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size()))]);
}

json offers_table(const std::vector<offered_hypotheses>& of_seeds) {
    constexpr double loss = 0.05;
    const double decided = rec::find_objects_options{}.min_probability;
    std::vector<double> rejected, at_decision, lost;
    std::size_t right = 0, wrong = 0;
    for (const offered_hypotheses& o : of_seeds) {
        right += o.right.size();
        wrong += o.wrong.size();
        rejected.push_back(o.rejected_at_loss(loss));
        at_decision.push_back(share_below(o.wrong, decided));
        lost.push_back(share_below(o.right, decided));
    }
    return {{{"right ones", right},
             {"wrong ones", wrong},
             {"rejected where 5 % of right ones are", rounded(median_of(rejected), 3)},
             {"worst", rounded(std::ranges::min(rejected), 3)},
             {"rejected at 0.5", rounded(median_of(at_decision), 3)},
             {"right ones lost at 0.5", rounded(median_of(lost), 3)}}};
}

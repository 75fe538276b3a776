// SPDX-License-Identifier: BSL-1.0
/// @file
/// How well a segmentation agrees with the truth, by the counts of Hoover et al., "An experimental
/// comparison of range image segmentation algorithms", PAMI 18(7), 1996, Sec. 4.1: regions that are
/// found correctly, cut into several, run together with others, missed, and segments that are no
/// region at all; for a tolerance T, the part of a region that must overlap.
///
/// Points of no true region (background) belong to segments like others, so that running into the
/// background spoils a segment; but segments that lie mostly there are not counted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace hoover {

/// Numbers of regions and segments by class. `correct + over + under + missed` may fall short of
/// `regions`, as an instance of `under` stands for several regions; and likewise of `segments`.
struct counts {
    std::size_t regions = 0;   ///< true ones
    std::size_t segments = 0;  ///< that are judged
    std::size_t correct = 0;
    std::size_t over = 0;    ///< regions that are two segments or more
    std::size_t under = 0;   ///< segments that are two regions or more
    std::size_t missed = 0;  ///< regions that are nothing of this
    std::size_t noise = 0;   ///< segments that are nothing of this

    /// The part of the regions that is correct, the recall.
    [[nodiscard]] double correct_fraction() const { return ratio(correct, regions); }
    [[nodiscard]] double precision() const { return ratio(correct, segments); }
    /// 2 P R / (P + R).
    [[nodiscard]] double f() const { return ratio(2 * correct, regions + segments); }

    friend bool operator==(const counts&, const counts&) = default;

  private:
    static double ratio(std::size_t a, std::size_t b) {
        return b == 0 ? 0.0 : static_cast<double>(a) / static_cast<double>(b);
    }
};

/// Which region shares how many points with which segment. Labels are at least 0, negative ones
/// stand for no region and no segment.
class overlaps {
  public:
    /// @throws std::invalid_argument  if the labels are of different points
    overlaps(std::span<const std::int32_t> truth, std::span<const std::int32_t> found) {
        if (truth.size() != found.size())
            throw std::invalid_argument("hoover: truth and segmentation are of different points");
        const std::size_t regions = count_of(truth), segments = count_of(found);
        region_size_.assign(regions, 0);
        segment_size_.assign(segments, 0);
        common_.assign(regions, std::vector<std::size_t>(segments, 0));
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i] >= 0) ++region_size_[static_cast<std::size_t>(truth[i])];
            if (found[i] >= 0) ++segment_size_[static_cast<std::size_t>(found[i])];
            if (truth[i] >= 0 && found[i] >= 0)
                ++common_[static_cast<std::size_t>(truth[i])][static_cast<std::size_t>(found[i])];
        }
    }

    /// @param tolerance  T, above 0.5 and at most 1
    /// @throws std::invalid_argument  for another tolerance
    [[nodiscard]] counts at(double tolerance) const {
        if (!(tolerance > 0.5 && tolerance <= 1.0))
            throw std::invalid_argument("hoover: the tolerance must be above 0.5, up to 1");
        const std::vector<bool> judged = judged_segments();
        std::vector<instance> instances;
        find_correct(tolerance, instances);
        find_over(tolerance, instances);
        find_under(tolerance, instances);
        // A region or segment that is several things is what fits best.
        std::stable_sort(instances.begin(), instances.end(),
                         [](const instance& a, const instance& b) { return a.fit > b.fit; });
        counts c;
        std::vector<bool> region_done(region_size_.size(), false);
        std::vector<bool> segment_done(segment_size_.size(), false);
        for (const instance& one : instances) {
            const auto taken = [](const std::vector<bool>& done) {
                return [&done](std::size_t i) { return done[i]; };
            };
            if (std::any_of(one.regions.begin(), one.regions.end(), taken(region_done)) ||
                std::any_of(one.segments.begin(), one.segments.end(), taken(segment_done)))
                continue;
            for (const std::size_t r : one.regions) region_done[r] = true;
            for (const std::size_t s : one.segments) segment_done[s] = true;
            if (one.regions.size() > 1)
                ++c.under;
            else if (one.segments.size() > 1)
                ++c.over;
            else
                ++c.correct;
        }
        for (std::size_t r = 0; r < region_size_.size(); ++r) {
            if (region_size_[r] == 0) continue;
            ++c.regions;
            if (!region_done[r]) ++c.missed;
        }
        for (std::size_t s = 0; s < segment_size_.size(); ++s) {
            if (!judged[s]) continue;
            ++c.segments;
            if (!segment_done[s]) ++c.noise;
        }
        return c;
    }

    /// The number of regions that have this part in common with a segment, of it and of the
    /// segment, even if together with another region they fit the segment better. O(regions *
    /// segments).
    [[nodiscard]] std::size_t matched(double tolerance) const {
        std::vector<instance> found;
        find_correct(tolerance, found);
        return found.size();
    }

  private:
    /// Regions and segments that are the same thing, and how well: the mean of the parts of both
    /// that overlap.
    struct instance {
        std::vector<std::size_t> regions, segments;
        double fit;
    };

    static std::size_t count_of(std::span<const std::int32_t> labels) {
        std::int32_t last = -1;
        for (const std::int32_t l : labels) last = std::max(last, l);
        return static_cast<std::size_t>(last + 1);
    }

    static double part(std::size_t a, std::size_t b) {
        return static_cast<double>(a) / static_cast<double>(b);
    }

    /// Those of which at least half lies on true regions.
    [[nodiscard]] std::vector<bool> judged_segments() const {
        std::vector<bool> judged(segment_size_.size(), false);
        for (std::size_t s = 0; s < segment_size_.size(); ++s) {
            std::size_t on_truth = 0;
            for (const auto& row : common_) on_truth += row[s];
            judged[s] = segment_size_[s] > 0 && 2 * on_truth >= segment_size_[s];
        }
        return judged;
    }

    void find_correct(double t, std::vector<instance>& found) const {
        for (std::size_t r = 0; r < region_size_.size(); ++r) {
            for (std::size_t s = 0; s < segment_size_.size(); ++s) {
                const std::size_t o = common_[r][s];
                if (o == 0) continue;
                const double of_region = part(o, region_size_[r]);
                const double of_segment = part(o, segment_size_[s]);
                if (of_region >= t && of_segment >= t)
                    found.push_back({{r}, {s}, 0.5 * (of_region + of_segment)});
            }
        }
    }

    void find_over(double t, std::vector<instance>& found) const {
        for (std::size_t r = 0; r < region_size_.size(); ++r) {
            instance one{{r}, {}, 0.0};
            std::size_t common = 0, size = 0;
            for (std::size_t s = 0; s < segment_size_.size(); ++s) {
                if (segment_size_[s] == 0 || part(common_[r][s], segment_size_[s]) < t) continue;
                one.segments.push_back(s);
                common += common_[r][s];
                size += segment_size_[s];
            }
            if (one.segments.size() < 2 || part(common, region_size_[r]) < t) continue;
            one.fit = 0.5 * (part(common, region_size_[r]) + part(common, size));
            found.push_back(std::move(one));
        }
    }

    void find_under(double t, std::vector<instance>& found) const {
        for (std::size_t s = 0; s < segment_size_.size(); ++s) {
            instance one{{}, {s}, 0.0};
            std::size_t common = 0, size = 0;
            for (std::size_t r = 0; r < region_size_.size(); ++r) {
                if (region_size_[r] == 0 || part(common_[r][s], region_size_[r]) < t) continue;
                one.regions.push_back(r);
                common += common_[r][s];
                size += region_size_[r];
            }
            if (one.regions.size() < 2 || part(common, segment_size_[s]) < t) continue;
            one.fit = 0.5 * (part(common, segment_size_[s]) + part(common, size));
            found.push_back(std::move(one));
        }
    }

    std::vector<std::size_t> region_size_, segment_size_;
    std::vector<std::vector<std::size_t>> common_;  // by region, then segment
};

}  // namespace hoover

// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <gnomon/recognition/labeled_samples.hpp>

namespace rec = gnomon::recognition;

namespace {

rec::labeled_samples three_samples() {
    rec::labeled_samples samples;
    for (const std::uint32_t c : {0u, 1u, 0u}) {
        const double sample[] = {1.0 * c, 5.0};
        samples.add(sample, c);
    }
    return samples;
}

TEST(labeled_samples, are_rows_with_classes) {
    const auto samples = three_samples();
    EXPECT_EQ(samples.rows(), 3u);
    EXPECT_EQ(samples.columns, 2u);
    EXPECT_EQ(samples.row(1)[0], 1.0);
    EXPECT_EQ(samples.row(2)[1], 5.0);
    EXPECT_NO_THROW(samples.require_valid(2));
}

TEST(labeled_samples, refuse_what_does_not_fit) {
    EXPECT_THROW(three_samples().require_valid(1), std::invalid_argument);
    auto shorter = three_samples();
    shorter.values.pop_back();
    EXPECT_THROW(shorter.require_valid(2), std::invalid_argument);
    auto nan = three_samples();
    nan.values[2] = std::nan("");
    EXPECT_THROW(nan.require_valid(2), std::invalid_argument);
}

}  // namespace

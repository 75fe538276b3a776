// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/descriptor_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/features/spin_image.hpp>

namespace {

using gnomon::angular_spin_image, gnomon::spin_image, gnomon::trust;

static_assert(gnomon::descriptor<spin_image> && gnomon::descriptor<angular_spin_image>);

/// Neighbors of a point, spread evenly in a ball about it, with normals.
struct spun_sample {
    Eigen::Vector3d p, normal;
    clouds::cloud neighbors, normals;

    spun_sample(std::size_t n, double radius, std::uint64_t seed) {
        gnomon::random_stream random(seed, 21);
        p = clouds::gaussian_vector(random);
        normal = clouds::gaussian_vector(random).normalized();
        while (neighbors.size() < n) {
            const Eigen::Vector3d d(2 * random.uniform() - 1, 2 * random.uniform() - 1,
                                    2 * random.uniform() - 1);
            if (d.norm() > 1.0) continue;
            neighbors.push_back(p + radius * d);
            normals.push_back(clouds::gaussian_vector(random).normalized());
        }
    }
};

std::vector<double> image_of(const spin_image& describe, const Eigen::Vector3d& p,
                             const Eigen::Vector3d& normal, const clouds::cloud& neighbors) {
    std::vector<double> row(describe.dimension(), 0.0);
    (void)describe(p, normal, neighbors, row);
    return row;
}

/// Bins by their limits, one after the other.
std::vector<double> counted_one_by_one(const spin_image& s, const spun_sample& sample) {
    std::vector<double> image(s.radial_bins * s.axial_bins, 0.0);
    for (std::size_t i = 0; i < s.radial_bins; ++i) {
        for (std::size_t j = 0; j < s.axial_bins; ++j) {
            const double dr = s.radius / static_cast<double>(s.radial_bins);
            const double dh = s.height / static_cast<double>(s.axial_bins);
            const double low = dr * static_cast<double>(i);
            const double bottom = dh * static_cast<double>(j) - s.height / 2;
            for (const Eigen::Vector3d& q : sample.neighbors) {
                const double beta = sample.normal.dot(q - sample.p);
                const double alpha = (q - sample.p - beta * sample.normal).norm();
                if (alpha >= low && alpha < low + dr && beta >= bottom && beta < bottom + dh)
                    image[i * s.axial_bins + j] += 1.0;
            }
        }
    }
    return image;
}

TEST(spin_image, counts_the_neighbors_of_each_bin) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const spin_image s{
            .radius = 0.3, .height = 0.5, .radial_bins = 1 + seed % 6, .axial_bins = 1 + seed % 7};
        const spun_sample sample(400, s.support_radius(), seed);
        const auto image = image_of(s, sample.p, sample.normal, sample.neighbors);
        ASSERT_EQ(image, counted_one_by_one(s, sample));
    }
}

/// As PCL 1.13 defines them: image_width W, bins of edge radius / W, (W + 1) x (2 W + 1) entries to
/// which each neighbor is distributed by bilinear interpolation, divided by their sum.
std::vector<double> as_in_pcl(int width, double radius, const spun_sample& sample) {
    const double bin = radius / width;
    std::vector<double> image(static_cast<std::size_t>((width + 1) * (2 * width + 1)), 0.0);
    double sum = 0.0;
    for (const Eigen::Vector3d& q : sample.neighbors) {
        const Eigen::Vector3d d = q - sample.p;
        const double cosine = sample.normal.dot(d) / d.norm();
        const double beta = d.norm() * cosine;
        const double alpha = d.norm() * std::sqrt(1.0 - cosine * cosine);
        if (std::abs(beta) >= radius || alpha >= radius) continue;
        const int i = static_cast<int>(std::floor(alpha / bin));
        const int j = static_cast<int>(std::floor(beta / bin)) + width;
        const double a = alpha / bin - i, b = beta / bin - (j - width);
        const auto at = [&](int row, int column) -> double& {
            return image[static_cast<std::size_t>(row * (2 * width + 1) + column)];
        };
        at(i, j) += (1 - a) * (1 - b);
        at(i + 1, j) += a * (1 - b);
        at(i, j + 1) += (1 - a) * b;
        at(i + 1, j + 1) += a * b;
        sum += 1.0;
    }
    for (double& entry : image) entry /= sum;
    return image;
}

TEST(spin_image, is_that_of_pcl_if_interpolated) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const double radius = 0.05 + 0.01 * static_cast<double>(seed);
        const spun_sample sample(300, std::sqrt(2.0) * radius, seed);
        const spin_image s{.radius = radius,
                           .height = 2 * radius,
                           .radial_bins = 8,
                           .axial_bins = 16,
                           .interpolate = true,
                           .normalize = true};
        const auto image = image_of(s, sample.p, sample.normal, sample.neighbors);
        const auto expected = as_in_pcl(8, radius, sample);
        ASSERT_EQ(image.size(), expected.size());
        for (std::size_t b = 0; b < image.size(); ++b) ASSERT_NEAR(image[b], expected[b], 1e-9);
    }
}

TEST(spin_image, sums_up_to_the_neighbors_in_the_cylinder) {
    for (const bool interpolate : {false, true}) {
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            spin_image s{.radius = 0.2, .height = 0.1, .interpolate = interpolate};
            const spun_sample sample(200, s.support_radius(), seed);
            std::size_t inside = 0;
            for (const Eigen::Vector3d& q : sample.neighbors) {
                const double beta = sample.normal.dot(q - sample.p);
                inside +=
                    std::abs(beta) <= 0.05 && (q - sample.p - beta * sample.normal).norm() <= 0.2;
            }
            auto image = image_of(s, sample.p, sample.normal, sample.neighbors);
            const double sum = std::accumulate(image.begin(), image.end(), 0.0);
            ASSERT_NEAR(sum, static_cast<double>(inside), interpolate ? 1e-11 : 0.0);
            for (const double entry : image) ASSERT_GE(entry, 0.0);
            s.normalize = true;
            image = image_of(s, sample.p, sample.normal, sample.neighbors);
            ASSERT_NEAR(std::accumulate(image.begin(), image.end(), 0.0), 1.0, 1e-12);
        }
    }
}

/// Rotations about the normal, and of everything: at most 1 % of the mass changes its bin.
TEST(spin_image, does_not_change_with_rotations) {
    for (const bool interpolate : {false, true}) {
        const spin_image s{.radius = 0.2, .height = 0.4, .interpolate = interpolate};
        double about_normal = 0.0, rigid = 0.0;
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            const spun_sample sample(300, s.support_radius(), seed);
            const auto image = image_of(s, sample.p, sample.normal, sample.neighbors);
            const Eigen::Matrix3d turn =
                Eigen::AngleAxisd(0.1 + static_cast<double>(seed), sample.normal)
                    .toRotationMatrix();
            const auto turned = clouds::moved(sample.neighbors, turn, sample.p - turn * sample.p);
            about_normal = std::max(
                about_normal,
                laws::share_that_differs(image, image_of(s, sample.p, sample.normal, turned)));
            const Eigen::Matrix3d r = clouds::random_rotation(seed);
            const Eigen::Vector3d t(4e5, 5e6, 100);
            rigid +=
                laws::share_that_differs(image, image_of(s, r * sample.p + t, r * sample.normal,
                                                         clouds::moved(sample.neighbors, r, t)));
        }
        EXPECT_LT(about_normal, interpolate ? 1e-12 : 0.01);
        EXPECT_LT(rigid / 100, interpolate ? 1e-6 : 0.01);
    }
}

/// Corners of the closed cylinder, and the position of the point itself.
TEST(spin_image, has_closed_bins_at_its_ends) {
    spin_image s{.radius = 1.0, .height = 2.0, .radial_bins = 2, .axial_bins = 3};
    const clouds::cloud neighbors{{1, 0, 1}, {0, 1, -1}, {0, 0, 0}, {1.001, 0, 0}, {0, 0, 1.001}};
    EXPECT_EQ(image_of(s, {0, 0, 0}, {0, 0, 1}, neighbors),
              (std::vector<double>{0, 1, 0, 1, 0, 1}));
    s.interpolate = true;
    EXPECT_EQ(image_of(s, {0, 0, 0}, {0, 0, 1}, neighbors),
              (std::vector<double>{0, 0.5, 0.5, 0, 0, 0, 0, 0, 1, 0, 0, 1}));
}

TEST(spin_image, has_a_trust) {
    std::vector<double> row(120, 0.0);
    const clouds::cloud three{{0.01, 0, 0}, {0, 0.01, 0}, {5, 0, 0}};
    EXPECT_EQ(spin_image{}({0, 0, 0}, {0, 0, 1}, three, row), trust::good);
    EXPECT_EQ((spin_image{.min_neighbors = 3}({0, 0, 0}, {0, 0, 1}, three, row)),
              trust::too_few_neighbors);
    EXPECT_EQ(spin_image{}({9, 9, 9}, {0, 0, 1}, three, row), trust::too_few_neighbors);
}

TEST(spin_image, is_compared_by_correlation) {
    const spin_image s{};
    const std::vector<float> a{1, 2, 3, 4}, b{10, 20, 30, 40}, c{4, 3, 2, 1}, one{1, 1, 1, 1};
    EXPECT_NEAR(s.distance(a, b), 0.0, 1e-15);
    EXPECT_NEAR(s.distance(a, c), 2.0, 1e-15);
    EXPECT_EQ(s.distance(one, a), 1.0);
    EXPECT_EQ(s.distance(one, one), 0.0);
}

TEST(spin_image, refuses_numbers_out_of_range) {
    const auto refused = [](const spin_image& s) {
        EXPECT_THROW(s.require_valid(), std::invalid_argument);
        EXPECT_THROW(angular_spin_image{s}.require_valid(), std::invalid_argument);
    };
    for (const double bad : {0.0, -1.0, clouds::nan, clouds::infinity}) {
        refused({.radius = bad});
        refused({.height = bad});
    }
    refused({.radial_bins = 0});
    refused({.axial_bins = 0});
    refused({.min_neighbors = 0});
    constexpr std::size_t huge = std::size_t{1} << 32, most = std::size_t{1} << 20;
    refused({.radial_bins = huge, .axial_bins = huge});  // the product wraps to 0
    refused({.radial_bins = most, .axial_bins = 2});
    refused({.radial_bins = ~std::size_t{0}, .interpolate = true});
    EXPECT_NO_THROW((spin_image{.radial_bins = most / 2, .axial_bins = 2}.require_valid()));
    const std::vector<float> three(3), four(4);
    EXPECT_THROW((void)spin_image{}.distance(three, four), std::invalid_argument);
    EXPECT_THROW((void)spin_image{}.distance(four, three), std::invalid_argument);
    EXPECT_THROW((void)angular_spin_image{}.distance(four, three), std::invalid_argument);
    EXPECT_NO_THROW(spin_image{}.require_valid());
    EXPECT_NO_THROW((spin_image{.radius = 1e150, .height = 1e150}.require_valid()));
}

/// The mean angle of each bin, by bilinear weights or alone; one without a normal is left out.
TEST(angular_spin_image, is_the_mean_angle_between_normals) {
    for (const bool interpolate : {false, true}) {
        const spin_image bins{.radius = 0.2, .height = 0.4, .interpolate = interpolate};
        const angular_spin_image s{bins};
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            spun_sample sample(200, bins.support_radius(), seed);
            sample.normals[3].setZero();
            std::vector<double> row(s.dimension(), 0.0);
            ASSERT_EQ(s(sample.p, sample.normal, sample.neighbors, row, sample.normals),
                      trust::good);
            std::vector<double> weights(row.size(), 0.0), angles(row.size(), 0.0);
            for (std::size_t k = 0; k < sample.neighbors.size(); ++k) {
                if (k == 3) continue;
                const auto alone = image_of(bins, sample.p, sample.normal, {sample.neighbors[k]});
                const double angle = std::acos(std::abs(sample.normal.dot(sample.normals[k])));
                for (std::size_t b = 0; b < alone.size(); ++b) {
                    weights[b] += alone[b];
                    angles[b] += alone[b] * angle;
                }
            }
            for (std::size_t b = 0; b < row.size(); ++b)
                ASSERT_NEAR(row[b], weights[b] > 0 ? angles[b] / weights[b] : 0.0, 1e-12);
        }
    }
}

TEST(angular_spin_image, needs_neighbors_with_normals) {
    const clouds::cloud two{{0.01, 0, 0}, {0, 0.01, 0}};
    const clouds::cloud none(2, {0, 0, 0}), upright(2, {0, 0, 1});
    std::vector<double> row(120, 0.0);
    const angular_spin_image s{};
    EXPECT_EQ(s({0, 0, 0}, {0, 0, 1}, two, row, none), trust::too_few_neighbors);
    EXPECT_EQ(s({0, 0, 0}, {0, 0, -1}, two, row, upright), trust::good);
    EXPECT_EQ(row, std::vector<double>(120, 0.0));  // opposite normals are the same axis
}

TEST(spin_image, obeys_the_laws) {
    for (const bool interpolate : {false, true}) {
        const spin_image s{.radius = 0.1, .height = 0.1, .interpolate = interpolate};
        laws::descriptor_laws(s);
        laws::descriptor_laws(angular_spin_image{s});
    }
}

}  // namespace

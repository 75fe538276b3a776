// SPDX-License-Identifier: BSL-1.0
/// @file
/// Samples with classes, to train a classifier on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::recognition {

/// Samples in rows of equal length, with their classes.
struct labeled_samples {
    std::size_t columns = 0;             ///< numbers per sample
    std::vector<double> values;          ///< rows * columns, finite
    std::vector<std::uint32_t> classes;  ///< of each row

    [[nodiscard]] std::size_t rows() const { return classes.size(); }  ///< the number of samples
    /// The numbers of sample i.
    [[nodiscard]] std::span<const double> row(std::size_t i) const {
        return {values.data() + i * columns, columns};
    }
    /// Adds a sample. Precondition: it has `columns` values, or is the first one.
    void add(std::span<const double> sample, std::uint32_t its_class) {
        columns = sample.size();
        values.insert(values.end(), sample.begin(), sample.end());
        classes.push_back(its_class);
    }

    /// @throws std::invalid_argument  if values and classes differ in number, a value is not
    /// finite,
    ///                                or a class is not below `number_of_classes`
    void require_valid(std::size_t number_of_classes) const {
        using gnomon::detail::require;
        require(values.size() == rows() * columns,
                "labeled_samples: values and classes differ in number");
        for (const double x : values)
            require(std::isfinite(x), "labeled_samples: a value is not finite");
        for (const std::uint32_t c : classes)
            require(c < number_of_classes, "labeled_samples: a class is too large");
    }
};

}  // namespace gnomon::recognition

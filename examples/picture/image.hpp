// SPDX-License-Identifier: BSL-1.0
/// @file
/// A picture in memory: pixels, text on them, and PNG bytes of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#include "palette.hpp"
#include "typeface.hpp"

namespace picture {

/// Heights of lines of text [pixels].
inline constexpr double text_size = 22.0;
inline constexpr double small_text_size = 17.0;

/// Pixels row by row from the upper left.
class image {
  public:
    image(int width, int height, const color& background = white)
        : width_(width),
          height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    [[nodiscard]] color& at(int x, int y) { return pixels_[index(x, y)]; }
    [[nodiscard]] const color& at(int x, int y) const { return pixels_[index(x, y)]; }

    /// Fills the pixels of [x0, x1) x [y0, y1) that there are.
    void fill(int x0, int y0, int x1, int y1, const color& c) {
        for (int y = std::max(y0, 0); y < std::min(y1, height_); ++y) {
            for (int x = std::max(x0, 0); x < std::min(x1, width_); ++x) at(x, y) = c;
        }
    }

    /// Copies `other` so that its upper left pixel comes to (x0, y0).
    void paste(const image& other, int x0, int y0) {
        for (int y = 0; y < std::min(other.height_, height_ - y0); ++y) {
            for (int x = 0; x < std::min(other.width_, width_ - x0); ++x) {
                at(x0 + x, y0 + y) = other.at(x, y);
            }
        }
    }

    /// Writes a text in UTF-8, whose first capital letter has its upper left corner at (x, y).
    void write(int x, int y, std::string_view text, const color& c = ink, double size = text_size) {
        const typeface& face = typeface::of_labels();
        const int line = y + static_cast<int>(std::lround(face.capital_height(size)));
        face.draw(text, size, [&](int right, int down, double share) {
            const int column = x + right, row = line + down;
            if (column < 0 || column >= width_ || row < 0 || row >= height_) return;
            at(column, row) = mixed(at(column, row), c, share);
        });
    }

    /// How wide write() makes the text [pixels].
    [[nodiscard]] static int width_of(std::string_view text, double size = text_size) {
        return static_cast<int>(std::ceil(typeface::of_labels().width_of(text, size)));
    }

    /// The bytes of a PNG file; colors are rounded to 32 levels, so that it stays small.
    [[nodiscard]] std::string png() const {
        std::vector<color> rounded = pixels_;
        for (color& c : rounded) {
            for (std::uint8_t& level : c) {
                level = static_cast<std::uint8_t>(((level + 4) / 8) * 255 / 32);
            }
        }
        // Rows as they are: of the filters of PNG, none makes flat colors smaller.
        stbi_write_force_png_filter = 0;
        std::string bytes;
        const auto append = [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                                  static_cast<std::size_t>(size));
        };
        if (stbi_write_png_to_func(append, &bytes, width_, height_, 3, rounded.data(),
                                   3 * width_) == 0) {
            throw std::runtime_error("the picture could not be encoded");
        }
        return bytes;
    }

  private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_;
    int height_;
    std::vector<color> pixels_;
};

}  // namespace picture

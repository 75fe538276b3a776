// SPDX-License-Identifier: BSL-1.0
/// @file
/// A picture in memory: pixels, text on them, and PNG bytes of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_easy_font.h>
#include <stb_image_write.h>

#include "palette.hpp"

namespace picture {

/// A name with '?' for what the picture has no letter for.
[[nodiscard]] inline std::string in_ascii(std::string name) {
    for (char& c : name) {
        if (c < ' ' || c > '~') c = '?';
    }
    return name;
}

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

    /// Writes ASCII text whose upper left corner is (x, y), in letters of 12 `size` pixels.
    void write(int x, int y, std::string text, const color& c = ink, int size = 2) {
        struct corner {
            float x, y, z;
            unsigned char rgba[4];
        };
        std::vector<corner> corners(text.size() * 64);  // a letter has at most 16 rectangles
        const int quads = stb_easy_font_print(0.0f, 0.0f, text.data(), nullptr, corners.data(),
                                              static_cast<int>(corners.size() * sizeof(corner)));
        for (std::size_t q = 0; q < static_cast<std::size_t>(quads); ++q) {
            const corner& from = corners[4 * q];
            const corner& to = corners[4 * q + 2];
            fill(x + size * static_cast<int>(from.x), y + size * static_cast<int>(from.y),
                 x + size * static_cast<int>(to.x), y + size * static_cast<int>(to.y), c);
        }
    }

    /// How wide write() will make the text.
    [[nodiscard]] static int width_of(std::string text, int size = 2) {
        return size * stb_easy_font_width(text.data());
    }

    /// The bytes of a PNG file; colors are rounded to 32 levels, so that it stays small.
    [[nodiscard]] std::string png() const {
        std::vector<color> rounded = pixels_;
        for (color& c : rounded) {
            for (std::uint8_t& level : c) {
                level = static_cast<std::uint8_t>(((level + 4) / 8) * 255 / 32);
            }
        }
        stbi_write_png_compression_level = 12;
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

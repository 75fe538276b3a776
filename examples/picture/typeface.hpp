// SPDX-License-Identifier: BSL-1.0
/// @file
/// Text in a picture: the outlines of a TrueType font of the system, antialiased. A program whose
/// font is missing leaves its labels out, and prints so.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>

#ifndef PICTURE_FONT  // no build that looked for one
#define PICTURE_FONT "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
#endif

namespace picture {

/// Takes the first character off a text in UTF-8.
/// @param text  not empty
/// @return its code point; U+FFFD, the replacement character, for a byte that begins none
[[nodiscard]] inline char32_t take_character(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    constexpr char32_t replacement = 0xFFFD;
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    char32_t c = length == 1 ? first : first & (0x7Fu >> length);
    std::size_t taken = 1;
    while (taken < length && taken < text.size() && (byte(taken) & 0xC0u) == 0x80u)
        c = c << 6u | (byte(taken++) & 0x3Fu);
    text.remove_prefix(taken);
    return taken == length && c >= ' ' ? c : replacement;
}

/// A font, scaled to any size. A size is the height of a line of text [pixels].
class typeface {
  public:
    /// That of all labels: the file which the environment variable GNOMON_FONT names, else the one
    /// which the build found. Its first use prints on stderr if the file is no font.
    [[nodiscard]] static const typeface& of_labels() {
        static const typeface labels = [] {
            const char* const chosen = std::getenv("GNOMON_FONT");
            const std::string path = chosen != nullptr ? chosen : PICTURE_FONT;
            typeface face(path);
            if (!face.is_there()) {
                std::fprintf(stderr,
                             "labels are left out of the picture: '%s' is no TrueType font; "
                             "install fonts-dejavu-core, or set GNOMON_FONT to the path of one\n",
                             path.c_str());
            }
            return face;
        }();
        return labels;
    }

    /// Reads a font, whose tables are trusted.
    explicit typeface(const std::string& path) {
        std::error_code unknown;  // so is a path that cannot be read
        if (!std::filesystem::is_regular_file(path, unknown)) return;
        std::ifstream file(path, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(file), {});
        if (bytes_.size() < 12) return;  // the head of a font
        const auto* const data = reinterpret_cast<const unsigned char*>(bytes_.data());
        const int start = stbtt_GetFontOffsetForIndex(data, 0);
        is_there_ = start >= 0 && stbtt_InitFont(&font_, data, start) != 0;
    }
    typeface(typeface&& other) = default;  // the bytes stay where they are
    typeface& operator=(typeface&&) = delete;

    [[nodiscard]] bool is_there() const { return is_there_; }

    /// How far to the right a text in UTF-8 reaches [pixels]; 0 without a font.
    [[nodiscard]] double width_of(std::string_view text, double size) const {
        return walk(text, size, [](int, double) {});
    }

    /// The height of a capital letter [pixels]; 0 without a font.
    [[nodiscard]] double capital_height(double size) const {
        int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
        if (is_there_) stbtt_GetCodepointBox(&font_, 'H', &x0, &y0, &x1, &y1);
        return scale_of(size) * y1;
    }

    /// Calls `cover(x, y, share)` for the pixels that a text in UTF-8 covers, with the share of the
    /// pixel, 0 to 1. The text begins at x = 0 on the line y = 0; y counts downwards.
    void draw(std::string_view text, double size, auto&& cover) const {
        const auto scale = static_cast<float>(scale_of(size));
        std::vector<unsigned char> shares;
        walk(text, size, [&](int glyph, double x) {
            const double left = std::floor(x);
            const auto shift = static_cast<float>(x - left);
            int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
            stbtt_GetGlyphBitmapBoxSubpixel(&font_, glyph, scale, scale, shift, 0.0f, &x0, &y0, &x1,
                                            &y1);
            const int width = x1 - x0, height = y1 - y0;
            if (width <= 0 || height <= 0) return;  // a space
            shares.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
            stbtt_MakeGlyphBitmapSubpixel(&font_, shares.data(), width, height, width, scale, scale,
                                          shift, 0.0f, glyph);
            auto share = shares.begin();
            for (int row = 0; row < height; ++row)
                for (int column = 0; column < width; ++column, ++share)
                    if (*share != 0)
                        cover(static_cast<int>(left) + x0 + column, y0 + row, *share / 255.0);
        });
    }

  private:
    [[nodiscard]] double scale_of(double size) const {
        return is_there_ ? stbtt_ScaleForPixelHeight(&font_, static_cast<float>(size)) : 0.0;
    }

    /// Calls `place(glyph, x)` for each character, with the place of its origin [pixels].
    /// @return the place of the next one
    double walk(std::string_view text, double size, auto&& place) const {
        if (!is_there_) return 0.0;
        const double scale = scale_of(size);
        double x = 0.0;
        int before = 0;
        while (!text.empty()) {
            const int glyph = stbtt_FindGlyphIndex(&font_, static_cast<int>(take_character(text)));
            if (before != 0) x += scale * stbtt_GetGlyphKernAdvance(&font_, before, glyph);
            place(glyph, x);
            int advance = 0, bearing = 0;
            stbtt_GetGlyphHMetrics(&font_, glyph, &advance, &bearing);
            x += scale * advance;
            before = glyph;
        }
        return x;
    }

    std::vector<char> bytes_;
    stbtt_fontinfo font_{};
    bool is_there_ = false;
};

}  // namespace picture

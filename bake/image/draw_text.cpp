// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/draw_text.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <tetralight/bake/image/detail/font.h>

namespace tetralight {
namespace {

using detail::Glyph;

/// Pixels of the image for one pixel of the font.
constexpr float kScale = 2.0f;

/// Pixels of the font from one line to the next.
constexpr float kLineHeight = 12.0f;

struct Rectangle {
    float min_x, min_y, max_x, max_y;
};

void fill(Image8& image, const Rectangle& r, const std::array<uint8_t, 4>& color) {
    const auto pixel = [](float coordinate, uint32_t size) {
        return static_cast<uint32_t>(
            std::clamp(std::round(coordinate), 0.0f, static_cast<float>(size)));
    };
    for (uint32_t y = pixel(r.min_y, image.height); y < pixel(r.max_y, image.height); ++y) {
        for (uint32_t x = pixel(r.min_x, image.width); x < pixel(r.max_x, image.width); ++x) {
            image.pixels[size_t{y} * image.width + x] = color;
        }
    }
}

/// Fills a rectangle for each pixel of a glyph, larger by `grow` on each side. `x` and `y` are the
/// glyph's upper left corner.
void draw_glyph(Image8& image, float x, float y, const Glyph& glyph, float grow,
                const std::array<uint8_t, 4>& color) {
    for (uint32_t row = 0; row < Glyph::kHeight; ++row) {
        for (uint32_t column = 0; column < Glyph::kMaxWidth; ++column) {
            if ((glyph.rows[row] >> column & 1u) == 0) continue;
            const float left = x + kScale * static_cast<float>(column);
            const float top = y + kScale * static_cast<float>(row);
            fill(image, {left - grow, top - grow, left + kScale + grow, top + kScale + grow},
                 color);
        }
    }
}

}  // namespace

void draw_text(Image8& image, float x, float y, std::string_view text) {
    for (const bool is_outline : {true, false}) {
        float column = 0.0f, line = 0.0f;  // in pixels of the font
        for (const char character : text) {
            if (character == '\n') {
                column = 0.0f;
                line += kLineHeight;
                continue;
            }
            const Glyph& glyph = detail::glyph_of(character);
            draw_glyph(image, x + kScale * column, y + kScale * line, glyph,
                       is_outline ? 1.0f : 0.0f,
                       is_outline ? std::array<uint8_t, 4>{20, 20, 20, 255}
                                  : std::array<uint8_t, 4>{255, 255, 255, 255});
            column += static_cast<float>(glyph.advance);
        }
    }
}

}  // namespace tetralight

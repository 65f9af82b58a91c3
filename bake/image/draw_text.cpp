// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/draw_text.h>

#include <stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace tetralight {
namespace {

/// A corner of a rectangle as stb_easy_font writes it.
struct FontVertex {
    float x, y, z;
    std::array<uint8_t, 4> color;
};

static_assert(sizeof(FontVertex) == 16);

/// Pixels of the image for one pixel of the font.
constexpr float kScale = 2.0f;

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

}  // namespace

void draw_text(Image8& image, float x, float y, std::string_view text) {
    std::string copy(text);
    std::vector<FontVertex> vertices(80 * copy.size() + 4);
    const int count = stb_easy_font_print(0.0f, 0.0f, copy.data(), nullptr, vertices.data(),
                                          static_cast<int>(vertices.size() * sizeof(FontVertex)));
    for (const bool is_outline : {true, false}) {
        const float grow = is_outline ? 1.0f : 0.0f;
        for (int i = 0; i < count; ++i) {
            const FontVertex& min = vertices[static_cast<size_t>(4 * i)];
            const FontVertex& max = vertices[static_cast<size_t>(4 * i + 2)];
            fill(image,
                 {x + kScale * min.x - grow, y + kScale * min.y - grow, x + kScale * max.x + grow,
                  y + kScale * max.y + grow},
                 is_outline ? std::array<uint8_t, 4>{20, 20, 20, 255}
                            : std::array<uint8_t, 4>{255, 255, 255, 255});
        }
    }
}

}  // namespace tetralight

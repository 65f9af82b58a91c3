// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/page_preview.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <string_view>

#include <tetralight/pipeline/lightmap_images.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/render/image_renderer.h>

namespace tetralight {
namespace {

using Pixel = std::array<uint8_t, 4>;

constexpr Pixel kEmpty{40, 40, 40, 255};
constexpr Pixel kOther{70, 130, 220, 255};
constexpr Pixel kMarked{255, 140, 0, 255};

/// Draws the border of a rectangle, so many pixels inwards.
void draw_border(Image8& image, const LightmapRectangle& r, uint32_t width, const Pixel& color) {
    for (uint32_t y = 0; y < r.height; ++y) {
        for (uint32_t x = 0; x < r.width; ++x) {
            const uint32_t from_border = std::min({x, y, r.width - 1 - x, r.height - 1 - y});
            if (from_border < width) image.pixels[size_t{r.y + y} * image.width + r.x + x] = color;
        }
    }
}

void dim(Image8& image, const LightmapRectangle& r) {
    for (uint32_t y = r.y; y < r.y + r.height; ++y) {
        for (uint32_t x = r.x; x < r.x + r.width; ++x) {
            Pixel& pixel = image.pixels[size_t{y} * image.width + x];
            for (size_t i = 0; i < 3; ++i) pixel[i] = static_cast<uint8_t>(pixel[i] / 3);
        }
    }
}

}  // namespace

std::vector<bool> instances_named(const LightmapsView& lightmaps,
                                  const std::vector<std::string>& names) {
    std::vector<bool> result(lightmaps.rectangles.size(), false);
    const std::vector<std::string_view> all = split_names(lightmaps.instance_names);
    for (size_t i = 0; i < std::min(all.size(), result.size()); ++i) {
        const bool has_page = lightmaps.rectangles[i].page != kNoIndex;
        result[i] = has_page && std::ranges::find(names, all[i]) != names.end();
    }
    return result;
}

Image8 page_preview(const LightmapsView& lightmaps, const ExportedTexels& values, uint32_t page,
                    const std::vector<bool>& is_marked) {
    const ImageF colors = page_colors(values, page);
    Image8 image = values.is_fraction ? quantized(colors) : develop(colors, 0.0f);
    const size_t first = image.pixels.size() * page;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        if (lightmaps.irradiance[first + i].coverage == 0) image.pixels[i] = kEmpty;
    }
    const bool marks_some = std::ranges::find(is_marked, true) != is_marked.end();
    for (size_t i = 0; i < lightmaps.rectangles.size(); ++i) {
        const LightmapRectangle& rectangle = lightmaps.rectangles[i];
        if (rectangle.page != page) continue;
        if (marks_some && !is_marked[i]) dim(image, rectangle);
        if (is_marked[i]) {
            draw_border(image, rectangle, 3, kMarked);
        } else {
            draw_border(image, rectangle, 1, kOther);
        }
    }
    return image;
}

}  // namespace tetralight
